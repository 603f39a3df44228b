"""Pairs: two commands at once in one folder. One wins and the other is refused, or they go one after the other; the
folder then holds what one of them alone would have made, never a mixture, and nothing of an unfinished run is lost."""

import os
import time

import folders
from ground import CHECKPOINT

NAME, TRIES = "pairs", 80


def both(t, first, second, seconds):
    """Starts two commands a moment apart and waits for both."""
    one = t.start(*first)
    after = t.rng.choice((0, 0, t.rng.uniform(0, 0.05), t.rng.uniform(0, 0.3), t.rng.uniform(0, seconds)))
    time.sleep(after)
    t.note(f"and {after:.3f} s later")
    two = t.start(*second)
    return t.ended(one), t.ended(two)


def refused(t, end, folder):
    """Whether it was refused; the refusal says why and where."""
    if end.code != 2:
        return False
    if os.path.basename(folder) not in end.err:
        t.found(f"the refusal does not name the folder: {end.said()}")
    return True


def outcome(t, ends, goods, folder):
    """Two commands each would make one of `goods`. The one with exit code 0 made the folder."""
    won = [good for end, good in zip(ends, goods) if end.code == 0]
    for end in ends:
        if end.code not in (None, 0) and not refused(t, end, folder):
            t.found(f"one of two ends with {end.how()}: {end.said()}")
    if not won:
        return False
    if not any(not folders.differences(good, folder) for good in won):
        different = min((folders.differences(good, folder) for good in won), key=len)
        t.found(f"{len(won)} of two say exit 0, but the folder is no one's: {folders.brief(different)}")
    return True


def runs(t, force):
    """Two runs that differ in their seeds, so that a mixture shows."""
    folder = t.path("run")
    goods = [t.ground.good("short", "reference", seed) for seed in (1, 2)]
    former = force and t.rng.random() < 0.5
    if former:
        folders.copy(goods[0][0], folder)
    first, second = (t.ground.run_words("short", "reference", folder, seed) for seed in (1, 2))
    if force:
        first, second = first + ["--force"], second + ["--force"]
    ends = both(t, first, second, goods[0][1])
    if not outcome(t, ends, [good for good, _ in goods], folder) and all(end.code == 2 for end in ends):
        t.found("both of two runs are refused")


def resume_and(t, second):
    """A run is resumed, and at the same time something else begins in its folder."""
    good, seconds = t.ground.good("short", "reference")
    folder = t.path("run")
    folders.copy(t.ground.broken("short", "reference"), folder)
    other = {"resume": ["resume", folder, "--quiet"], "run": t.ground.run_words("short", "reference", folder),
             "force": t.ground.run_words("short", "reference", folder, 2) + ["--force"]}[second]
    goods = [good, t.ground.good("short", "reference", 2)[0] if second == "force" else good]
    words, swapped = [["resume", folder, "--quiet"], other], t.rng.random() < 0.5
    if swapped:
        words.reverse()
        goods.reverse()
    ends = both(t, *words, seconds)
    if outcome(t, ends, goods, folder):
        return
    if not os.path.exists(os.path.join(folder, CHECKPOINT)):
        t.found("neither of two went on, and the checkpoint is lost")
    elif t.vkdose("resume", folder, "--quiet").code == 0:
        t.expect_same(good, folder, "neither of two went on; resumed, exit 0, but")
    else:
        t.found("neither of two went on, and the run cannot be resumed")


def sweeps(t):
    good, seconds = t.ground.good_sweep("reference")
    t.ground.study(t.folder)
    folder = t.path("sweep")
    words = t.ground.sweep_words(folder, "reference")
    if not outcome(t, both(t, words, words, seconds), [good, good], folder):
        if t.vkdose(*words).code == 0:
            t.expect_same(good, folder, "both of two sweeps are refused; swept again, exit 0, but")
        else:
            t.found("after two sweeps at once the sweep cannot be gone on with")


def report_during(t):
    good, seconds = t.ground.good("long", "reference")
    folder = t.path("run")
    running = t.start(*t.ground.run_words("long", "reference", folder))
    for _ in range(3):
        time.sleep(t.rng.uniform(0, seconds / 2))
        end = t.vkdose("report", folder)
        page = os.path.join(folder, "report.html")
        if end.code == 0 and not folders.bytes_of(page).rstrip().endswith(b"</html>"):
            t.found("a report during a run is half a page")
        if end.code not in (None, 0, 2):
            t.found(f"a report during a run ends with {end.how()}: {end.said()}")
    if t.ended(running).code == 0:
        t.expect_same(good, folder, "exit 0 after reports during the run, but", ["report.html"])
    else:
        t.found("reports during a run make it fail")


def attempt(t):
    kind = t.number % 8
    if kind < 3:
        runs(t, force=True)
    elif kind == 3:
        runs(t, force=False)
    elif kind < 6:
        resume_and(t, t.rng.choice(("resume", "run", "force")))
    elif kind == 6:
        sweeps(t)
    else:
        report_during(t)
