"""The workbench besieged: two pages of its own work in it while others send 500 requests that no page would, and clients
that are slow keep connections open. A run goes on to the bits of an undisturbed one, of two pages that save at once one
is told, and on a full disk no file is lost."""

import json
import os
import random
import signal
import socket
import threading
import time

import folders
from browsers import SECRET, Bench, escape, nonsense, stranger, torn
from disks import Disk, resize, room_taken, unmount

NAME, TRIES = "sieges", 6
REQUESTS, BESIEGERS, SLOW = 500, 4, 6


class Besieger(threading.Thread):
    """Sends its part of the requests, with dice of its own. It stands for the try in what it calls."""

    def __init__(self, t, bench, number):
        super().__init__()
        self.t, self.bench, self.found = t, bench, t.found
        self.rng = random.Random(f"{t.ground.seed}/{NAME}/{t.number}/{number}")

    def run(self):
        for _ in range(REQUESTS // BESIEGERS):
            self.rng.choice((stranger, escape, nonsense, torn))(self, self.bench)


class Slow(threading.Thread):
    """A client that sends a request byte by byte, until it is told to end or is thrown out."""

    def __init__(self, bench):
        super().__init__()
        self.port, self.over = bench.port, threading.Event()

    def run(self):
        try:
            with socket.create_connection(("127.0.0.1", self.port), timeout=60) as connection:
                for byte in b"GET /api/folder HTTP/1.1\r\nHost: 127.0.0.1\r\nX: " + b"y" * 4000:
                    if self.over.wait(0.3):
                        return
                    connection.sendall(bytes([byte]))
        except OSError:
            pass


def post(bench, path, **body):
    answer = bench.ask("POST", path, {**bench.good, "Content-Type": "application/json"}, json.dumps(body).encode())
    return answer or (0, "")


def both_save(t, bench, file):
    """Two pages have read the same text and save at once, each its own. One is told that it came too late."""
    for number in range(60):
        before = folders.bytes_of(file).decode()
        texts = [f"# {number} {page}\n" for page in "ab"]
        answers = [0, 0]

        def save(page, before=before, texts=texts, answers=answers):
            answers[page] = post(bench, "/api/save", name="notes.toml", text=texts[page], before=before)[0]

        pages = [threading.Thread(target=save, args=(page,)) for page in (0, 1)]
        for page in pages:
            page.start()
        for page in pages:
            page.join()
        taken = [text for text, status in zip(texts, answers) if status == 200]
        if sorted(answers) != [200, 409] or folders.bytes_of(file).decode() != taken[0]:
            t.found(f"two pages that save at once are told {answers}")


def full_disk(t, bench, disk, file):
    """A case that cannot be written stays what it was."""
    before = folders.bytes_of(file).decode()
    resize(disk.folder, max(8, room_taken(disk.folder) - 8))
    status, said = post(bench, "/api/save", name="notes.toml", text="# " + "large " * 20000, before=before)
    if status == 200:
        t.found("a case is saved though the disk is full")
    elif "space" not in said:
        t.found(f"a full disk is not told: {status} {said[:200]}")
    if folders.bytes_of(file).decode() != before:
        t.found("a full disk spoils the case that was there")
    disk.more()
    if post(bench, "/api/save", name="notes.toml", text=before + "# more\n", before=before)[0] != 200:
        t.found("once there is room again, a case is not saved")


def besieged(t, bench, work):
    """Its own pages work while it is besieged."""
    attackers = [Besieger(t, bench, i) for i in range(BESIEGERS)]
    slow = [Slow(bench) for _ in range(SLOW)]
    if post(bench, "/api/run", name="my.toml")[0] != 200:
        t.found("a run does not begin")
    for thread in attackers + slow:
        thread.start()
    both_save(t, bench, os.path.join(work, "notes.toml"))
    for thread in attackers:
        thread.join()
    for _ in range(600):
        answer = bench.ask("GET", "/api/running", bench.good)
        if answer is None or answer[0] != 200:
            t.found(f"its own page is not answered: {answer and answer[0]}")
            break
        if json.loads(answer[1]) == []:
            break
        time.sleep(0.1)
    for thread in slow:
        thread.over.set()
        thread.join()


def attempt(t):
    disk = Disk(t)
    work = os.path.join(disk.folder, "work")
    folders.write(os.path.join(disk.folder, "outside.toml"), SECRET)
    text = t.ground.case_text("long", "vulkan")
    folders.write(os.path.join(work, "my.toml"), text)
    folders.write(os.path.join(work, "notes.toml"), "# at first\n")
    os.symlink(os.path.join(disk.folder, "outside.toml"), os.path.join(work, "link.toml"))
    os.symlink(disk.folder, os.path.join(work, "up"))
    folders.write(t.path("my.toml"), text)
    t.vkdose("run", t.path("my.toml"), "--out", t.path("good"), "--quiet")
    bench = Bench(t, work)
    if bench.port == 0:
        t.found("the workbench does not begin to listen")
    else:
        besieged(t, bench, work)
        if not bench.running.over() and disk.mounted:
            full_disk(t, bench, disk, os.path.join(work, "notes.toml"))
    bench.running.send(signal.SIGINT)
    end = t.ended(bench.running)
    if end.code not in (0, None):
        t.found(f"told to end, it ends with {end.how()}: {end.said()}")
    t.expect_same(t.path("good"), os.path.join(work, "out", "my"), "a run of a workbench that is besieged")
    if folders.bytes_of(os.path.join(disk.folder, "outside.toml")).decode() != SECRET:
        t.found("a file outside was changed")
    unmount(disk.folder)
