#!/usr/bin/env python3
"""Writes bucket.stl, the bucket of tipping-bucket.toml: a box open above, in millimetres.

Its hinge is the z axis, at the height of the floor's upper face."""

import struct
import sys

LOW, HIGH, WALL = (-4.0, 0.0, -10.0), (16.0, 24.0, 10.0), 1.0     # the room


def quad(p, q, r, s):
    return [(p, q, r), (p, r, s)]


def rim(low, high, y):
    """Corners of a rectangle at the height y, to the right about -y."""
    return [(low[0], y, low[2]), (high[0], y, low[2]), (high[0], y, high[2]), (low[0], y, high[2])]


def triangles():
    out_low = [LOW[0] - WALL, LOW[1] - WALL, LOW[2] - WALL]
    out_high = [HIGH[0] + WALL, HIGH[1], HIGH[2] + WALL]
    inner = [rim(LOW, HIGH, y) for y in (LOW[1], HIGH[1])]
    outer = [rim(out_low, out_high, y) for y in (out_low[1], HIGH[1])]
    mesh = quad(*outer[0]) + quad(*reversed(inner[0]))
    for i in range(4):
        j = (i + 1) % 4
        mesh += quad(outer[0][i], outer[1][i], outer[1][j], outer[0][j])
        mesh += quad(inner[0][j], inner[1][j], inner[1][i], inner[0][i])
        mesh += quad(outer[1][i], inner[1][i], inner[1][j], outer[1][j])
    return mesh


def main():
    mesh = triangles()
    with open(sys.argv[1] if len(sys.argv) > 1 else "bucket.stl", "wb") as out:
        out.write(b"bucket in mm".ljust(80) + struct.pack("<I", len(mesh)))
        for triangle in mesh:
            out.write(struct.pack("<12fH", 0, 0, 0, *(x for p in triangle for x in p), 0))


main()
