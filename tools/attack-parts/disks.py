"""Full disks: the output lies on a file system of some hundred KiB that fills up at any point. The command says so with
exit code 5 and leaves a good checkpoint. When there is room again, the run goes on to the same bits. Where no file
system can be mounted, a limit on the size of files takes its place."""

import os
import shutil
import subprocess
import threading
import time

import folders
from ground import CHECKPOINT

NAME, TRIES = "disks", 60
ROOM = 64 << 10  # KiB: enough for everything

_mounted = []
_guard = threading.Lock()


def mount(folder, kib):
    """Mounts a file system of this size at a folder; False if that is not permitted."""
    os.makedirs(folder)
    words = ["mount", "-t", "tmpfs", "-o", f"size={kib}k,nosuid,nodev", "vkdose-attack", folder]
    if os.geteuid() != 0 or subprocess.run(words, stderr=subprocess.DEVNULL, check=False).returncode != 0:
        return False
    with _guard:
        _mounted.append(folder)
    return True


def resize(folder, kib):
    subprocess.run(["mount", "-o", f"remount,size={kib}k", folder], check=True)


def unmount(folder):
    with _guard:
        if folder not in _mounted:
            return
        _mounted.remove(folder)
    for _ in range(20):
        if subprocess.run(["umount", folder], stderr=subprocess.DEVNULL, check=False).returncode == 0:
            return
        time.sleep(0.05)
    subprocess.run(["umount", "--lazy", folder], check=False)


def unmount_all():
    for folder in list(_mounted):
        unmount(folder)


def room_taken(folder):
    """The size of a folder on such a file system, in KiB."""
    return sum(4 * (1 + os.path.getsize(os.path.join(folder, name)) // 4096) for name in folders.files_in(folder)) + 12


def judge_full(t, end, what):
    if end.code in (None, 0):
        return
    if end.code != 5:
        t.found(f"{what} on a full disk ends with {end.how()}, not 5: {end.said()}")
    elif not any(word in end.err for word in ("No space left", "File too large", "full")):
        t.found(f"{what} on a full disk does not say so: {end.said()}")


def limited(t, disk, kib, words):
    """Runs a command with this much room: in total, or without a mount for each file."""
    if disk.mounted:
        resize(disk.folder, kib)
        return t.vkdose(*words)
    return t.vkdose(*words, file_size=max(1, kib // 8) << 10)


class Disk:
    """A folder of a try with room that can be set."""

    def __init__(self, t):
        self.folder = t.path("disk")
        self.mounted = mount(self.folder, ROOM)

    def more(self):
        if self.mounted:
            resize(self.folder, ROOM)


def after_room(t, good, folder, again):
    """Once there is room again, the run goes on or begins anew. Its result is that of an undisturbed run."""
    resumable = os.path.exists(os.path.join(folder, CHECKPOINT))
    words = ["resume", folder, "--quiet"] if resumable else again + ["--force"]
    end = t.vkdose(*words)
    if end.code == 0:
        t.expect_same(good, folder, f"after a full disk `{words[0]}` says exit 0, but")
    else:
        t.found(f"`{words[0]}` after room was made says {end.how()}: {end.said()}")


def run(t, disk):
    backend = t.rng.choice(("reference", "reference", "vulkan"))
    good, _ = t.ground.good("short", backend)
    folder = os.path.join(disk.folder, "run")
    words = t.ground.run_words("short", backend, folder)
    kib = t.rng.randint(4, room_taken(good) + 60)
    t.note(f"room for {kib} KiB")
    end = limited(t, disk, kib, words)
    judge_full(t, end, "`run`")
    disk.more()
    if end.code == 0:
        t.expect_same(good, folder, "exit 0, but")
    else:
        after_room(t, good, folder, words)


def resume(t, disk):
    backend = t.rng.choice(("reference", "reference", "vulkan"))
    good, _ = t.ground.good("short", backend)
    folder = os.path.join(disk.folder, "run")
    folders.copy(t.ground.broken("short", backend), folder)
    kib = room_taken(folder) + t.rng.randint(0, 200)
    t.note(f"room for {kib} KiB")
    end = limited(t, disk, kib, ["resume", folder, "--quiet"])
    judge_full(t, end, "`resume`")
    disk.more()
    if end.code == 0:
        t.expect_same(good, folder, "exit 0, but")
    elif not os.path.exists(os.path.join(folder, CHECKPOINT)):
        t.found("a full disk took the checkpoint")
    else:
        after_room(t, good, folder, [])


def ballast(t, disk):
    """Something else takes all the room while the run goes on."""
    good, seconds = t.ground.good("short", "reference")
    folder = os.path.join(disk.folder, "run")
    words = t.ground.run_words("short", "reference", folder)
    if not disk.mounted:
        return
    resize(disk.folder, 4096)
    running = t.start(*words)
    time.sleep(t.rng.uniform(0, seconds))
    other = os.path.join(disk.folder, "ballast")
    t.note("the disk is filled by somebody else")
    try:
        folders.write(other, bytes(8 << 20))
    except OSError:
        pass
    end = t.ended(running)
    judge_full(t, end, "`run`")
    os.unlink(other)
    disk.more()
    if end.code == 0:
        t.expect_same(good, folder, "exit 0, but")
    else:
        after_room(t, good, folder, words)


def report(t, disk):
    folder = os.path.join(disk.folder, "run")
    folders.copy(t.ground.good("short", "reference")[0], folder)
    page = os.path.join(folder, "report.html")
    former = t.rng.random() < 0.5
    if former:
        folders.write(page, "a former page")
    before = {name: folders.state(os.path.join(folder, name)) for name in folders.files_in(folder)}
    end = limited(t, disk, room_taken(folder) + t.rng.randint(0, 900), ["report", folder])
    judge_full(t, end, "`report`")
    if end.code == 0:
        return
    after = {name: folders.state(os.path.join(folder, name)) for name in folders.files_in(folder)}
    if after != before:
        names = sorted(set(after) ^ set(before)) or ["report.html"]
        t.found("a report that found no room changed the folder: " + ", ".join(names))


def sweep(t, disk):
    good, _ = t.ground.good_sweep("reference")
    t.ground.study(t.folder)
    folder = os.path.join(disk.folder, "sweep")
    words = t.ground.sweep_words(folder, "reference")
    end = limited(t, disk, t.rng.randint(4, room_taken(good) + 100), words)
    if end.code != 1:  # a member found no room
        judge_full(t, end, "`sweep`")
    disk.more()
    if end.code != 0:
        end = t.vkdose(*words, "--retry-failed")
    if end.code == 0:
        t.expect_same(good, folder, "after a full disk the sweep says exit 0, but")
    else:
        t.found(f"`sweep` after room was made says {end.how()}: {end.said()}")


WAYS = (run, run, run, resume, resume, ballast, report, sweep)


def attempt(t):
    disk = Disk(t)
    try:
        WAYS[t.number % len(WAYS)](t, disk)
    finally:
        if t.finds and disk.mounted:
            shutil.copytree(disk.folder, t.path("kept"), symlinks=True, ignore_dangling_symlinks=True)
        unmount(disk.folder)
