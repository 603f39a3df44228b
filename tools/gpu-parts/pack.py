"""What is carried to a card, and files that come back from it."""

import os
import re
import shutil
import subprocess
import tarfile
import tempfile
import zlib

import place as places

MOST_FILES, MOST_BYTES = 8, 16 << 20
MOST_CARRIED = 64 << 20
FOLDER = "vkdose-card"  # of what is carried, when it is unpacked
OF_SYSTEM = re.compile(r"lib(c|m|dl|rt|pthread|resolv|util|nsl)\.so|ld-linux|linux-vdso")
CARRIED = ["cases", "tests/oracle", "tools/gpu-minutes", "tools/gpu-parts", "tools/queue", "tools/bench-data", "LICENSE"]


def order_of(path):
    """What comes back first: tables, then the small files of runs, then the states to go on from, then the rest."""
    name = os.path.basename(path)
    tables = ("members.csv", "doses.csv", "calibration.json", "powder-draws.csv", "prediction.json", "scale.json", "verify.json", "verify.md")
    if path.count(os.sep) == 0 or name in tables:
        return 0
    if name.endswith((".txt", ".md", ".toml")) or name in ("summary.json", "bench.csv", "bench.json"):
        return 1
    if name.endswith((".csv", ".json")):
        return 2
    return 3 if name.endswith(".h5") else 4


def back(out, stem="gpu-minutes", most_files=MOST_FILES, most_bytes=MOST_BYTES):
    """Packs the folder into at most so many files, `stem`-1.tar.gz and so on in it, each of which can be unpacked alone.
    Returns their paths, and what found no room."""
    for old in os.listdir(out):
        if re.fullmatch(re.escape(stem) + r"-\d+\.tar\.gz", old):
            os.remove(os.path.join(out, old))
    files = []
    for folder, _, names in os.walk(out):
        files += [os.path.relpath(os.path.join(folder, n), out) for n in names if not n.endswith(".new")]
    files.sort(key=lambda f: (order_of(f), f))
    packs, left, used, archive = [], [], 0, None
    try:
        for file in files:
            path = os.path.join(out, file)
            try:
                with open(path, "rb") as f:
                    # Packed alone a file takes no less room than among others.
                    size = len(zlib.compress(f.read(), 6)) + 2048
            except OSError:
                left.append(file)
                continue
            if size > most_bytes:
                left.append(file)
                continue
            if archive is None or used + size > most_bytes:
                if len(packs) == most_files:
                    left.append(file)
                    continue
                if archive is not None:
                    archive.close()
                packs.append(os.path.join(out, f"{stem}-{len(packs) + 1}.tar.gz"))
                archive, used = tarfile.open(packs[-1], "w:gz", compresslevel=6), 0
            archive.add(path, file, recursive=False)
            used += size
    finally:
        if archive is not None:
            archive.close()
    return packs, left


def libraries_of(program):
    """The shared libraries that a program needs, by the loader's names, without those of the system (libc)."""
    found = {}
    said = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    for line in said.splitlines():
        match = re.match(r"\s*(\S+) => (\S+)", line)
        if match and match[2] == "not":
            raise RuntimeError(f"{program} needs {match[1]}, which is not here")
        if match and not OF_SYSTEM.match(match[1]):
            found[match[1]] = match[2]
    return found


def carried(place, to, tests=True):
    """Makes the packed folder `to` (.tar.gz) that is carried to a card. Returns its size [bytes] and what stays out."""
    out = ["the validation layer (vulkan-validationlayers): the tests run without it and say so",
           "the driver of the card, and libc, which come with the machine"]
    programs = [place.program]
    for room in places.ROOMS if tests else []:
        if os.path.isfile(place.test(room)):
            programs.append(place.test(room))
        else:
            out.append(f"the tests of {room}, which are not built")
    libraries = {}
    for program in programs:
        libraries.update(libraries_of(program))
    for name, package in places.DRIVER_NEEDS.items():
        path = places.library(name)
        if path:
            libraries[name] = path
        else:
            out.append(f"{name}, which is not here (Debian's package {package})")
    os.makedirs(os.path.dirname(os.path.abspath(to)), exist_ok=True)
    with tempfile.TemporaryDirectory() as work, tarfile.open(to, "w:gz", compresslevel=6) as archive:
        for program in programs:
            name = os.path.basename(program)
            stripped = shutil.copy2(program, work)
            if shutil.which("strip"):
                subprocess.run(["strip", stripped], check=True)
            archive.add(stripped, os.path.join(FOLDER, "bin", name))
        for name, path in libraries.items():
            archive.add(os.path.realpath(path), os.path.join(FOLDER, "lib", name))
        for item in CARRIED:
            source = os.path.join(place.root, item)
            if os.path.exists(source):
                archive.add(source, os.path.join(FOLDER, item), filter=without_pictures)
    return os.path.getsize(to), out


def without_pictures(member):
    name = os.path.basename(member.name)
    return None if name in ("__pycache__", "pictures") or name.endswith(".png") else member
