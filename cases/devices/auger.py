#!/usr/bin/env python3
"""Writes auger.stl, the screw of auger-milk.toml: a right-handed blade on a shaft along z, in millimetres.

Two closed surfaces, blade and shaft. The blade begins a little inside the shaft, so that no gap is left between them."""

import math
import struct
import sys

RADIUS, SHAFT, THICKNESS, PITCH, LENGTH, PER_TURN = 6.0, 2.5, 1.0, 8.0, 48.0, 32
INNER = 0.9 * SHAFT


def point(radius, angle, z):
    return radius * math.cos(angle), radius * math.sin(angle), z


def tube(rings):
    """Joins sections that go round the tube to the right, seen along it; the ends are fans."""
    for a, b in zip(rings, rings[1:]):
        for i in range(len(a)):
            j = (i + 1) % len(a)
            yield a[i], a[j], b[j]
            yield a[i], b[j], b[i]
    for i in range(1, len(rings[0]) - 1):
        yield rings[0][0], rings[0][i + 1], rings[0][i]
        yield rings[-1][0], rings[-1][i], rings[-1][i + 1]


def blade():
    turns = (LENGTH - THICKNESS) / PITCH
    steps = round(turns * PER_TURN)
    rings = []
    for i in range(steps + 1):
        angle = 2 * math.pi * turns * i / steps
        z = THICKNESS / 2 + PITCH * turns * i / steps
        corners = ((INNER, -1), (INNER, 1), (RADIUS, 1), (RADIUS, -1))
        rings.append([point(radius, angle, z + side * THICKNESS / 2) for radius, side in corners])
    return tube(rings)


def shaft():
    return tube([[point(SHAFT, 2 * math.pi * i / PER_TURN, z) for i in range(PER_TURN)] for z in (0.0, LENGTH)])


def main():
    mesh = [*blade(), *shaft()]
    with open(sys.argv[1] if len(sys.argv) > 1 else "auger.stl", "wb") as out:
        out.write(b"auger in mm".ljust(80) + struct.pack("<I", len(mesh)))
        for triangle in mesh:
            out.write(struct.pack("<12fH", 0, 0, 0, *(x for p in triangle for x in p), 0))


main()
