"""tools/attack: see there. Here are its options, the order of the tries, and the table at the end."""

import argparse
import concurrent.futures
import os
import shlex
import signal
import sys
import threading
import time
import traceback

import browsers
import disks
import folders
import foreign
import forks
import kills
import limits
import moves
import mutations
import pairs
import program
import reads
import sieges
from ground import ROOT, Ground, Try

KINDS = {kind.NAME: kind for kind in (kills, mutations, reads, disks, moves, pairs, foreign, limits, forks, browsers,
                                      sieges)}


def options_of(words):
    parser = argparse.ArgumentParser(prog="tools/attack", description="Attacks vkdose; prints what it tried and found.")
    add = parser.add_argument
    add("--seconds", type=float, default=7200, help="no try begins later than this (default: %(default)s)")
    add("--seed", type=int, default=1, help="of the dice; all but timing follows from it (default: %(default)s)")
    add("--only", choices=KINDS, action="append", metavar="KIND", help=f"one of {', '.join(KINDS)}; may be repeated")
    add("--try", type=int, action="append", dest="numbers", metavar="N", help="this try of the kind; keeps its files")
    for name, kind in KINDS.items():
        add(f"--{name}", type=int, default=kind.TRIES, metavar="N", help="tries (default: %(default)s)")
    add("--jobs", type=int, default=2, help="tries at once (default: %(default)s)")
    add("--program", default=os.path.join(ROOT, "build", "release", "vkdose"), help="default: build/release/vkdose")
    add("--patience", type=float, default=60, help="processor seconds a command may take (default: %(default)s)")
    add("--memory", type=int, default=3072, help="MiB a command may take (default: %(default)s)")
    return parser.parse_args(words)


def order(options):
    """All tries. The kinds are evenly mixed, so that a time limit cuts each kind by the same part."""
    chosen = []
    for name in options.only or KINDS:
        numbers = options.numbers or range(getattr(options, name))
        chosen += [((i + 0.5) / len(numbers), name, number) for i, number in enumerate(numbers)]
    return [(name, number) for _, name, number in sorted(chosen)]


class Tally:
    """Tries and finds of each kind, from several threads."""

    def __init__(self, options):
        self._options, self._guard = options, threading.Lock()
        self.tries, self.found = {}, {}

    def add(self, t):
        with self._guard:
            self.tries[t.kind] = self.tries.get(t.kind, 0) + 1
            if not t.finds:
                return
            self.found.setdefault(t.kind, []).append(t.number)
            print(f"FOUND by {t.kind} {t.number}")
            for text in t.finds:
                print("   ", text)
            print("    again:", again(self._options, t.kind, t.number))
            print("    files:", os.path.relpath(t.folder, ROOT), flush=True)

    def close(self, kinds, seconds):
        print(f"\n{'kind':<10} {'tries':>6} {'of':>6} {'found':>6}")
        for name in kinds:
            wanted = len(self._options.numbers or range(getattr(self._options, name)))
            print(f"{name:<10} {self.tries.get(name, 0):>6} {wanted:>6} {len(self.found.get(name, [])):>6}")
        tries, found = sum(self.tries.values()), sum(map(len, self.found.values()))
        each = ", ".join(f"{self.tries.get(name, 0)} {name}" for name in kinds)
        print(f"tools/attack --seed {self._options.seed}: {each}: {found} of {tries} found something, "
              f"in {seconds / 60:.0f} minutes")
        return 1 if found else 0


def again(options, kind, number):
    words = ["tools/attack", "--seed", str(options.seed), "--only", kind, "--try", str(number)]
    default = os.path.join(ROOT, "build", "release", "vkdose")
    return shlex.join(words + (["--program", options.program] if options.program != default else []))


def attempt(ground, tally, keep, name, number, last):
    if ground.over.is_set() or time.monotonic() > last:
        return
    t = Try(ground, name, number)
    try:
        KINDS[name].attempt(t)
    except Exception:  # a fault of the attack itself does not stop it, but is reported
        if ground.over.is_set():
            return
        t.found("the attack itself failed: " + traceback.format_exc())
    if ground.over.is_set():
        return  # we ended its programs ourselves
    tally.add(t)
    t.close(keep)


def on_signal(*_):
    raise KeyboardInterrupt


def main():
    options = options_of(sys.argv[1:])
    if options.numbers and len(options.only or []) != 1:
        sys.exit("tools/attack: --try needs one --only")
    if not os.access(options.program, os.X_OK):
        sys.exit(f"tools/attack: there is no program {options.program}")
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, on_signal)  # also so that children are born with their defaults
    began = time.monotonic()
    ground, tally = Ground(options), Tally(options)
    pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
    interrupted = False
    try:
        work = [pool.submit(attempt, ground, tally, bool(options.numbers), name, number, began + options.seconds)
                for name, number in order(options)]
        for one in concurrent.futures.as_completed(work):
            one.result()
    except KeyboardInterrupt:
        interrupted = True
        print("tools/attack: interrupted", file=sys.stderr)
    finally:
        ground.over.set()
        program.end_all()
        pool.shutdown(cancel_futures=True)
        disks.unmount_all()
    folders.remove(ground.foundation)
    found = tally.close(options.only or list(KINDS), time.monotonic() - began)
    sys.exit(130 if interrupted else found)


if __name__ == "__main__":
    main()
