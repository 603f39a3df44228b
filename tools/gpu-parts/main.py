"""The command line of tools/gpu-minutes."""

import argparse
import os
import sys

import memory as memories
import pack
import parts
import place as places
import report
import studies
from run import Deadline

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Shares of the time. What a part leaves is there for the next ones, and the last part has all that is left.
SHARES = {"verify": 0.2, "tests": 0.2, "members": 0.1, "bench": 0.15, "queue": 0.35}


def parts_in(text):
    names = text.split(",")
    unknown = [n for n in names if n not in SHARES]
    if unknown:
        raise argparse.ArgumentTypeError(f"{unknown[0]}: give parts of {','.join(SHARES)}")
    return [n for n in SHARES if n in names]


def options():
    p = argparse.ArgumentParser(
        prog="tools/gpu-minutes",
        description="Makes the most of a card for a quarter of an hour: known answers, tests, speed, then studies of the "
        "queue. A second call goes on where the first one ended.")
    p.add_argument("minutes", nargs="?", type=float, default=15.0, help="that there are (default: 15)")
    p.add_argument("--early", type=float, default=120.0, metavar="SECONDS",
                   help="before the end, when all is packed (default: 120)")
    p.add_argument("--only", metavar="PARTS", type=parts_in, default=list(SHARES),
                   help="of " + ",".join(SHARES) + " (default: all)")
    p.add_argument("--queue", metavar="FILE", help="of studies (default: cases/queue.toml)")
    p.add_argument("--out", metavar="DIR", default="out/gpu-minutes", help="folder of the results (default: %(default)s)")
    p.add_argument("--device", metavar="NAME", help="index or part of the name (default: as vkdose takes it)")
    p.add_argument("--program", metavar="FILE", help="vkdose (default: of this folder)")
    p.add_argument("--tiny", action="store_true", help="the smallest of everything: does it work at all")
    p.add_argument("--pack", metavar="FILE", help="only make the .tar.gz that is carried to a card")
    given = p.parse_args()
    if given.minutes * 60 <= given.early and not given.pack:
        p.error(f"{given.minutes:g} minutes are not more than the {given.early:g} s that are kept at the end (--early)")
    return given


def make_pack(given):
    if os.path.exists(given.pack):
        print(f"tools/gpu-minutes: {given.pack} is there already; choose another name", file=sys.stderr)
        return 2
    place = places.Place(ROOT, given.program)
    if not os.path.isfile(place.program):
        print("tools/gpu-minutes: " + "\n".join(places.tools_missing(place)), file=sys.stderr)
        return 2
    size, out = pack.carried(place, given.pack)
    print(f"{given.pack}: {size / (1 << 20):.1f} MiB; on the machine with the card: "
          f"tar xzf {os.path.basename(given.pack)} && {pack.FOLDER}/tools/gpu-minutes")
    for line in out:
        print("left out: " + line)
    if size > pack.MOST_CARRIED:
        print(f"tools/gpu-minutes: more than {pack.MOST_CARRIED >> 20} MiB", file=sys.stderr)
        return 1
    return 0


def play(given):
    out = os.path.abspath(given.out)
    os.makedirs(out, exist_ok=True)
    deadline = Deadline(given.minutes * 60 - given.early)
    place = places.Place(ROOT, given.program)
    memory = memories.Memory(out)
    missing = places.tools_missing(place)
    for m in missing:
        memory.note("missing: " + m)
    if not os.path.isfile(place.program):
        return 2
    s = parts.Session(place, out, memory, deadline, given.device, given.tiny)
    device = parts.devices(s)
    if device is None:
        memory.save()
        return 4
    memory.open_card(device, memories.hash_of(place.program))
    queue = given.queue or os.path.join(ROOT, "cases", "queue.toml")
    spare = deadline.left()
    for name in given.only:
        seconds = deadline.left() if name == given.only[-1] else SHARES[name] * spare
        try:
            if name == "queue":
                studies.queue(s, queue, seconds, memory.rate() or 1e8)
            else:
                getattr(parts, name)(s, seconds)
        except Exception as error:  # a fault of one part leaves the others alone
            memory.note(f"{name}: {type(error).__name__}: {error}")
        memory.save()
        report.write(memory, out, device, missing)
    packs, left = pack.back(out)
    for path in packs:
        print(f"send back {path} ({os.path.getsize(path) / (1 << 20):.1f} MiB)")
    if left:
        print(f"no room for {len(left)} files, first {left[0]}")
    print(f"the table: {os.path.join(out, 'gpu-minutes.md')}")
    return 0


def main():
    given = options()
    return make_pack(given) if given.pack else play(given)


if __name__ == "__main__":
    sys.exit(main())
