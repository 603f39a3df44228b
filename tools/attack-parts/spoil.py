"""Ways to spoil a file, chosen at random."""

import os
import re

import folders

NUMBERS = (b"1e308", b"-1e308", b"1e-320", b"99999999999999999999", b"-1", b"0", b"nan", b"inf", b"-nan", b"1e400",
           b"0x7f", b"4294967296", b"9223372036854775808", b"1e15", b"''", b"")
NUMBER = re.compile(rb"[-+]?\d+(\.\d*)?([eE][-+]?\d+)?")


def bit_flips(rng, data):
    data = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 8, 64))):
        data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    return bytes(data)


def truncation(rng, data):
    return data[:rng.randrange(len(data))]


def doubled_line(rng, data):
    lines = data.splitlines(keepends=True)
    i = rng.randrange(len(lines))
    return b"".join(lines[:i] + [lines[i]] * rng.choice((2, 2, 1000)) + lines[i + 1:])


def deleted_line(rng, data):
    lines = data.splitlines(keepends=True)
    i = rng.randrange(len(lines))
    return b"".join(lines[:i] + lines[i + rng.choice((1, 1, 7)):])


def other_number(rng, data):
    found = list(NUMBER.finditer(data))
    if not found:
        return bit_flips(rng, data)
    at = rng.choice(found)
    return data[:at.start()] + rng.choice(NUMBERS) + data[at.end():]


def long_line(rng, data):
    at = rng.randrange(len(data))
    letter = rng.choice((b"x", b"9", b",", b"[", b'"', b" ", b"."))
    return data[:at] + letter * rng.choice((10_000, 2_000_000)) + data[at:]


def inserted(rng, data):
    at = rng.randrange(len(data))
    extra = rng.choice((b"\0", b"\xff\xfe", b"\xc3", b"\xed\xa0\x80", b"\r", b"\n", b"\n\n\n", b"junk", b"1,2,3\n",
                        rng.randbytes(100)))
    return data[:at] + extra + data[at:]


def garbage(rng, data):
    at, length = rng.randrange(len(data)), rng.choice((16, 512, 65536))
    return data[:at] + rng.randbytes(min(length, len(data) - at)) + data[at + length:]


def swapped(rng, data):
    a, b = sorted(rng.randrange(len(data)) for _ in range(2))
    length = min(rng.randint(1, 64), max(1, b - a))
    return data[:a] + data[b:b + length] + data[a + length:b] + data[a:a + length] + data[b + length:]


def empty(_, __):
    return b""


def zeros(_, data):
    return b"\0" * len(data)


CONTENTS = (bit_flips, bit_flips, bit_flips, truncation, doubled_line, deleted_line, other_number, other_number,
            other_number, other_number, long_line, inserted, inserted, garbage, swapped, empty, zeros)


def folder(path):
    os.mkdir(path)


def fifo(path):
    os.mkfifo(path)


def loop(path):
    os.symlink(os.path.basename(path), path)


def dangling(path):
    os.symlink("nowhere", path)


def endless(path):
    os.symlink("/dev/zero", path)


def huge(path):
    with open(path, "wb") as file:
        file.truncate(4 << 30)  # takes no room: it is one hole


# What cannot be read as a file at all.
THINGS = (folder, fifo, fifo, loop, dangling, endless, huge)


def spoil(rng, path):
    """Spoils a file. Returns a text of what was done, and whether the result can be read."""
    data = folders.bytes_of(path)
    if rng.random() < 0.25:
        way = rng.choice(THINGS)
        os.unlink(path)
        way(path)
        return way.__name__, False
    way = rng.choice(CONTENTS)
    spoilt = way(rng, data) if data else rng.randbytes(100)
    folders.write(path, spoilt)
    return way.__name__ + (" (no change)" if spoilt == data else ""), True
