#!/usr/bin/env python3
"""Writes shaker.stl, the cup of shaker.toml: closed above, with four holes in its lid below, in millimetres.

Its axis is y, and the lid's inner face lies at y = 0. The cup is made of cells in radius, angle and height, so that the surface is closed."""

import math
import struct
import sys

RADII = [0.0, 4.2, 9.4, 12.0, 13.0]          # a hole lies between the second and the third
HEIGHTS = [-1.0, 0.0, 50.0, 51.0]            # lid, room, roof
AROUND, HOLES, HOLE_CELLS = 64, 4, 8         # a hole spans 8 of 64 cells: 45 degrees, 5.3 mm at its middle


def solid(i, j, k):
    if not (0 <= i < len(RADII) - 1 and 0 <= k < len(HEIGHTS) - 1):
        return False
    if k == 0:
        return not (i == 1 and j % (AROUND // HOLES) < HOLE_CELLS)
    return k == 2 or i == 3


def corner(i, j, k):
    angle = 2 * math.pi * (j % AROUND) / AROUND
    return (RADII[i] * math.cos(angle), HEIGHTS[k], RADII[i] * math.sin(angle)) if i else (0.0, HEIGHTS[k], 0.0)


def faces(i, j, k):
    """The cell's faces and the cells beyond them; corners run to the right about the way out."""
    c = lambda a, b, d: corner(i + a, j + b, k + d)
    yield (i - 1, j, k), (c(0, 0, 0), c(0, 0, 1), c(0, 1, 1), c(0, 1, 0))[::-1]
    yield (i + 1, j, k), (c(1, 0, 0), c(1, 0, 1), c(1, 1, 1), c(1, 1, 0))
    yield (i, j - 1, k), (c(0, 0, 0), c(1, 0, 0), c(1, 0, 1), c(0, 0, 1))[::-1]
    yield (i, j + 1, k), (c(0, 1, 0), c(1, 1, 0), c(1, 1, 1), c(0, 1, 1))
    yield (i, j, k - 1), (c(0, 0, 0), c(1, 0, 0), c(1, 1, 0), c(0, 1, 0))
    yield (i, j, k + 1), (c(0, 0, 1), c(1, 0, 1), c(1, 1, 1), c(0, 1, 1))[::-1]


def triangles():
    for i in range(len(RADII) - 1):
        for j in range(AROUND):
            for k in range(len(HEIGHTS) - 1):
                if not solid(i, j, k):
                    continue
                for beyond, (p, q, r, s) in faces(i, j, k):
                    if not solid(beyond[0], beyond[1] % AROUND, beyond[2]):
                        for t in ((p, q, r), (p, r, s)):
                            if len(set(t)) == 3:
                                yield t


def main():
    mesh = list(triangles())
    with open(sys.argv[1] if len(sys.argv) > 1 else "shaker.stl", "wb") as out:
        out.write(b"cup with holes in mm".ljust(80) + struct.pack("<I", len(mesh)))
        for triangle in mesh:
            out.write(struct.pack("<12fH", 0, 0, 0, *(x for p in triangle for x in p), 0))


main()
