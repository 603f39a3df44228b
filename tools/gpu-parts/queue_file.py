"""The queue of studies (cases/queue.toml): what is to be computed next, and what it costs."""

import json
import os
import re

KEYS = {"study": str, "command": str, "priority": int, "cost_G": (int, float), "state": str, "what": str}
UNKNOWN = float("inf")  # cost of a study that nobody has told
STATES = ["open", "done"]
COMMANDS = ["sweep", "calibrate", "design"]


class QueueError(Exception):
    """A fault in the file, told with its line."""


def read(path):
    """The studies of the file in its order. Of TOML it takes tables [[study]] with a key and a value in each line,
    which stand in JSON alike. Raises QueueError."""
    with open(path, encoding="utf-8") as f:
        lines = f.read().split("\n")
    studies = []
    for number, line in enumerate(lines, 1):
        def fault(text):
            return QueueError(f"{path}:{number}: {text}")

        line = line.strip()
        if not line or line.startswith("#"):
            continue
        if line == "[[study]]":
            studies.append({"line": number})
            continue
        match = re.fullmatch(r"([A-Za-z_]+)\s*=\s*(.*?)", line)
        if not match or not studies:
            raise fault(f"{line!r} is neither [[study]] nor a key of one with its value")
        key, text = match.groups()
        if key not in KEYS:
            raise fault(f"{key}: there is no such key; give one of {', '.join(KEYS)}")
        if key in studies[-1]:
            raise fault(f"{key} stands twice in this study")
        try:
            value = json.JSONDecoder().raw_decode(text)
        except ValueError:
            raise fault(f"{key} = {text}: is no string in quotes and no number") from None
        rest = text[value[1]:].strip()
        if not isinstance(value[0], KEYS[key]) or isinstance(value[0], bool) or (rest and not rest.startswith("#")):
            raise fault(f"{key} = {text}: is not a {'string' if KEYS[key] is str else 'number'}")
        studies[-1][key] = value[0]
    for s in studies:
        where = f"{path}:{s['line']}: "
        for key in ("study", "priority", "state"):
            if key not in s:
                raise QueueError(where + f"{key} is missing")
        if s["state"] not in STATES:
            raise QueueError(where + f"state = \"{s['state']}\": give {' or '.join(STATES)}")
        if s.setdefault("command", "sweep") not in COMMANDS:
            raise QueueError(where + f"command = \"{s['command']}\": give {' or '.join(COMMANDS)}")
        if not s.setdefault("cost_G", UNKNOWN) > 0:
            raise QueueError(where + "cost_G must be more than 0")
        s["file"] = os.path.join(os.path.dirname(path), s["study"])
        s["name"] = re.sub(r"\.toml$", "", s["study"]).replace("/", "-")
        if not os.path.isfile(s["file"]):
            raise QueueError(where + f"study = \"{s['study']}\": there is no file {s['file']}")
    names = [s["name"] for s in studies]
    for s in studies:
        if names.count(s["name"]) > 1:
            raise QueueError(f"{path}:{s['line']}: {s['study']} stands twice in the queue")
    return studies


def chosen(studies, left_G, rate, seconds):
    """The study to take now, and whether it fits. From the top, by priority and then by the order of the file, it is
    the first that fits whole. If none does, the top one takes the time that there is; it goes on another time.
    `left_G`: what is left of a study by name [G particle-steps]; 0: nothing. `rate`: particle-steps/s."""
    waiting = [s for s in sorted(studies, key=lambda s: s["priority"])
               if s["state"] == "open" and left_G.get(s["name"], s["cost_G"]) > 0]
    for s in waiting:
        if left_G.get(s["name"], s["cost_G"]) * 1e9 / rate <= seconds:
            return s, True
    return (waiting[0], False) if waiting else (None, False)


def members_left(text):
    """What a sweep says of what is left [G particle-steps], if its time was up."""
    match = re.search(r"left, ([0-9.]+(?:e[+-]?[0-9]+)?) ([kMGTP]?) ?particle-steps", text)
    if not match:
        return None
    return float(match[1]) * {"": 1e-9, "k": 1e-6, "M": 1e-3, "G": 1.0, "T": 1e3, "P": 1e6}[match[2]]


def cost_told(text):
    """The cost that a dry run tells [G particle-steps]."""
    match = re.search(r": [0-9]+ members?, ([0-9.]+(?:e[+-]?[0-9]+)?) ([kMGTP]?) ?particle-steps by the closed forms", text)
    if not match:
        return None
    return float(match[1]) * {"": 1e-9, "k": 1e-6, "M": 1e-3, "G": 1.0, "T": 1e3, "P": 1e6}[match[2]]
