#!/usr/bin/env python3
"""Writes spring.stl, the machined spring of mesh-lactose.toml: a wire of square section on a helix, in millimetres.

Its axis is x, as a lathe draws it. The surface is closed; its corners lie on the exact surface."""

import math
import struct
import sys

OUTER_RADIUS, SIDE, PITCH, TURNS, PER_TURN = 5.7, 1.0, 5.0, 6.8, 24


def corners(turn):
    """The square across the wire at that turn: four corners, in order round it."""
    angle, middle = 2 * math.pi * turn, SIDE / 2 + PITCH * turn
    return [(middle + along * SIDE / 2, radius * math.cos(angle), radius * math.sin(angle))
            for radius, along in ((OUTER_RADIUS - SIDE, -1), (OUTER_RADIUS, -1), (OUTER_RADIUS, 1), (OUTER_RADIUS - SIDE, 1))]


def triangles():
    steps = round(TURNS * PER_TURN)
    rings = [corners(TURNS * i / steps) for i in range(steps + 1)]
    for a, b in zip(rings, rings[1:]):
        for i in range(4):
            j = (i + 1) % 4
            yield a[i], b[j], a[j]
            yield a[i], b[i], b[j]
    for ring, order in ((rings[0], (0, 1, 2, 0, 2, 3)), (rings[-1], (0, 2, 1, 0, 3, 2))):
        p = [ring[i] for i in order]
        yield p[0], p[1], p[2]
        yield p[3], p[4], p[5]


def main():
    mesh = list(triangles())
    with open(sys.argv[1] if len(sys.argv) > 1 else "spring.stl", "wb") as out:
        out.write(b"spring in mm".ljust(80) + struct.pack("<I", len(mesh)))
        for triangle in mesh:
            out.write(struct.pack("<12fH", 0, 0, 0, *(x for p in triangle for x in p), 0))


main()
