"""Folders: copying, removing, remembering and comparing them."""

import csv
import io
import json
import os
import shutil
import stat

CLOCK = ("particle_steps_per_second", "stepping_wall_time_s")  # of a summary: what depends on the time of the clock


def bytes_of(path):
    with open(path, "rb") as file:
        return file.read()


def write(path, content):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())


def copy(source, target):
    shutil.copytree(source, target, symlinks=True)


def remove(path):
    """Removes a folder; links in it are removed, not followed."""
    shutil.rmtree(path, ignore_errors=True)


def files_in(folder):
    """The paths, relative to the folder, of everything in it that is not a folder itself."""
    found = []
    for place, _, names in os.walk(folder):
        found += [os.path.relpath(os.path.join(place, name), folder) for name in names]
    return sorted(found)


def timeless(path):
    """The content of a file, without the parts that depend on the clock."""
    content = bytes_of(path)
    name = os.path.basename(path)
    if name in ("settled.h5", "end.h5"):
        return None  # they count how often neighbours were looked for, which a resumed run does once more
    try:
        if name == "summary.json":
            summary = json.loads(content)
            return {key: value for key, value in summary.items() if key not in CLOCK}
        if name == "members.csv":
            rows = list(csv.reader(io.StringIO(content.decode())))
            at = rows[0].index("wall_time_s")
            return [row[:at] + row[at + 1:] for row in rows]
    except (ValueError, IndexError, AttributeError):
        pass  # not what it should be: compared as it is
    return content


def differences(good, other, but=()):
    """How a finished run or sweep differs from an undisturbed one; a list of texts. `but`: paths not looked at."""
    if not os.path.isdir(other):
        return [f"there is no folder {os.path.basename(other)}"]
    expected, got = set(files_in(good)) - set(but), set(files_in(other)) - set(but)
    found = [f"{name} is missing" for name in sorted(expected - got)]
    found += [f"{name} is one too many" for name in sorted(got - expected)]
    for name in sorted(expected & got):
        path = os.path.join(other, name)
        if not os.path.isfile(path) or timeless(os.path.join(good, name)) != timeless(path):
            found.append(f"{name} differs")
    return found


def brief(texts):
    return "; ".join(texts[:4]) + (f"; and {len(texts) - 4} more" if len(texts) > 4 else "")


def state(path):
    """Kind and content of the file at a path, to tell whether anybody changed it. A link is not followed."""
    try:
        info = os.lstat(path)
    except OSError:
        return "gone"
    if stat.S_ISREG(info.st_mode):
        return ("file", bytes_of(path))
    if stat.S_ISLNK(info.st_mode):
        return ("link", os.readlink(path))
    return (stat.filemode(info.st_mode)[0], info.st_rdev)


def complete(folder):
    """Whether a run's folder says of itself that the run is over."""
    if os.path.exists(os.path.join(folder, "checkpoint.h5")):
        return False
    try:
        summary = json.loads(bytes_of(os.path.join(folder, "summary.json")))
    except (OSError, ValueError):
        return False
    return not summary.get("interrupted", True) and summary.get("error") is None
