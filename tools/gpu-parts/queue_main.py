"""The command line of tools/queue."""

import argparse
import os
import re
import sys

import memory as memories
import parts
import place as places
import queue_file
import studies
from run import Deadline

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
UNITS = {"s": 1, "min": 60, "h": 3600}


def seconds_in(text):
    match = re.fullmatch(r"([0-9.]+) ?(s|min|h)", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text}: write 480s, 8min or 2h")
    return float(match[1]) * UNITS[match[2]]


def options():
    p = argparse.ArgumentParser(prog="tools/queue", description="Lists the studies of the queue, or runs them at the lowest priority.")
    p.add_argument("--for", dest="time", type=seconds_in, metavar="TIME", help="run studies for so long: 480s, 8min, 2h")
    p.add_argument("--rate", type=float, metavar="M", help="million particle-steps/s of this machine (default: 6 for each core)")
    p.add_argument("--queue", metavar="FILE", default=os.path.join(ROOT, "cases", "queue.toml"))
    p.add_argument("--out", metavar="DIR", default="out/queue", help="folder of the results (default: %(default)s)")
    p.add_argument("--device", metavar="NAME", help="index or part of the name (default: as vkdose takes it)")
    p.add_argument("--program", metavar="FILE", help="vkdose (default: of this folder)")
    p.add_argument("--costs", action="store_true", help="tell what a dry run says of each cost")
    return p.parse_args()


def listed(entries, known):
    for s in sorted(entries, key=lambda s: s["priority"]):
        k = known.get(s["name"], {})
        state = k.get("state", "open") if s["state"] == "open" else s["state"]
        print(f"{s['priority']:3d}  {state:6s} {k.get('left_G', s['cost_G']):9.4g} G  {s['study']:44s} {s.get('what', '')}")


def costs(entries, session):
    stale = 0
    for s in entries:
        ended = session.vkdose("cost " + s["name"], [s["command"], s["file"], "--dry-run", "--assume"], 3600)
        told = queue_file.cost_told(ended.text)
        right = told is not None and abs(told - s["cost_G"]) <= 0.01 * told
        stale += not right
        print(f"{s['study']:44s} {s['cost_G']:9.4g} G  " + ("as a dry run says" if right else
              f"a dry run says {told:.4g} G" if told is not None else f"no dry run: {ended.words()}"))
    return 1 if stale else 0


def main():
    given = options()
    try:
        entries = queue_file.read(given.queue)
    except (OSError, queue_file.QueueError) as error:
        print(f"tools/queue: {error}", file=sys.stderr)
        return 2
    out = os.path.abspath(given.out)
    if given.time is None and not given.costs:
        listed(entries, memories.Memory(out).all["queue"] if os.path.isdir(out) else {})
        return 0
    os.makedirs(out, exist_ok=True)
    memory = memories.Memory(out)
    place = places.Place(ROOT, given.program)
    if not os.path.isfile(place.program):
        print("tools/queue: " + places.tools_missing(place)[0], file=sys.stderr)
        return 2
    os.nice(19)
    session = parts.Session(place, out, memory, Deadline(given.time or 1e9), given.device, False)
    if given.costs:
        return costs(entries, session)
    studies.queue(session, given.queue, session.deadline.left(), (given.rate or 6 * (os.cpu_count() or 1)) * 1e6)
    listed(entries, memory.all["queue"])
    return 0


if __name__ == "__main__":
    sys.exit(main())
