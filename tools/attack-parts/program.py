"""The program under attack as a child of ours: started under limits, watched, ended, and judged by how it ended."""

import os
import signal
import subprocess
import tempfile
import threading
import time

TAIL = 8000  # characters of its output that are looked at
CODES = (0, 1, 2, 3, 4, 5, 130)  # those that host/app/README.md documents
IDLE = 8  # seconds of sleep, without any work, after which a program waits for what will not come
SANITIZERS = ("Sanitizer", "runtime error:")

_sessions = set()  # of the children that may still live
_guard = threading.Lock()


def stat(path):
    """What /proc says of a process or thread from its state on; None if it is gone."""
    try:
        with open(f"{path}/stat", encoding="utf-8", errors="replace") as file:
            return file.read().rpartition(")")[2].split()
    except OSError:
        return None


def stats_of(session):
    """The processes of a session that have not ended (a child of ours, its children, and theirs): the entry of each in
    /proc, and the states of its threads."""
    alive = {}
    for name in os.listdir("/proc"):
        fields = stat(f"/proc/{name}") if name.isdigit() else None
        if fields is None or int(fields[3]) != session:
            continue
        try:
            threads = [stat(f"/proc/{name}/task/{thread}") for thread in os.listdir(f"/proc/{name}/task")]
        except OSError:
            continue
        states = [thread[0] for thread in threads if thread and thread[0] not in "ZX"]
        if states:
            alive[int(name)] = (fields, states)
    return alive


def in_session(session):
    return list(stats_of(session))


def work_of(session):
    """The processor time [s] that a session has taken, and whether all its threads sleep and none waits for a disk."""
    alive = stats_of(session).values()
    ticks = sum(int(fields[i]) for fields, _ in alive for i in (11, 12, 13, 14))
    return ticks / os.sysconf("SC_CLK_TCK"), bool(alive) and all(set(states) == {"S"} for _, states in alive)


def send(pid, number):
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


def end_all():
    """Ends every child that may still live."""
    with _guard:
        sessions = set(_sessions)
    for session in sessions:
        for pid in in_session(session):
            send(pid, signal.SIGKILL)


class Ended:
    """How the program ended. `code` is negative for a signal, None if it had to be ended because it hung."""

    def __init__(self, code, out, err, seconds):
        self.code, self.out, self.err, self.seconds = code, out, err, seconds

    def said(self):
        """The last line on stderr, shortened."""
        lines = self.err.strip().splitlines()
        return lines[-1][:300] if lines else "(nothing on stderr)"

    def how(self):
        if self.code is None:
            return "hung"
        return signal.Signals(-self.code).name if self.code < 0 else f"exit {self.code}"

    def fault(self, sent=()):
        """The faults that no command may ever show; empty if there are none. `sent`: signals that we sent."""
        if self.code is None:
            return "hangs"
        if any(word in self.err + self.out for word in SANITIZERS):
            return "a sanitizer's report: " + self.said()
        if "internal error" in self.err:
            return "internal error: " + self.said()
        if self.code < 0 and -self.code not in sent:
            return f"ended by {self.how()}: {self.said()}"
        if self.code >= 0 and self.code not in CODES:
            return f"exit {self.code}, which means nothing: {self.said()}"
        return ""


class Running:
    """A program that has been started, with everything it starts, in a session of its own."""

    def __init__(self, words, folder, environment, memory=0, file_size=0, limits=()):
        limits = ["prlimit", "--core=0", *limits]
        if memory:
            limits.append(f"--as={memory}")
        if file_size:
            limits.append(f"--fsize={file_size}")
        self._out, self._err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        self.began = time.monotonic()
        # A limit on the size of files stands for a full disk. A full disk sends no signal, so SIGXFSZ stays ignored, as
        # Python has it.
        self._child = subprocess.Popen(limits + ["--"] + words, cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                       stdout=self._out, stderr=self._err, start_new_session=True,
                                       restore_signals=not file_size)
        self.pid = self._child.pid
        self._looked, self._work, self._idle_since = self.began, -1, self.began
        with _guard:
            _sessions.add(self.pid)

    def over(self):
        return self._child.poll() is not None

    def work(self):
        return work_of(self.pid)[0]

    def family(self):
        """The program's children, theirs included."""
        return [pid for pid in in_session(self.pid) if pid != self.pid]

    def send(self, number):
        if not self.over():
            send(self.pid, number)

    def so_far(self):
        """What it has printed until now."""
        return os.pread(self._out.fileno(), TAIL, 0).decode("utf-8", "replace")

    def hangs(self, seconds):
        """Whether it has taken so much processor time, or waits idly. The clock would say nothing on a busy machine."""
        now = time.monotonic()
        if now < self._looked + 0.25:
            return False
        self._looked = now
        work, asleep = work_of(self.pid)
        if work != self._work or not asleep:
            self._work, self._idle_since = work, now
        return work > seconds or now > self._idle_since + IDLE

    def wait(self, seconds):
        """Waits for its end; if it hangs, ends it. `seconds`: the processor time that it may take."""
        while not self.over() and not self.hangs(seconds):
            time.sleep(0.002)
        code = self._child.poll()
        if code is None:
            self.end()
        return Ended(code, self._text(self._out), self._text(self._err), time.monotonic() - self.began)

    def wait_family(self, seconds):
        """Waits for whatever outlived it; False if something did not end and had to be ended."""
        self._idle_since = time.monotonic()
        while in_session(self.pid) and not self.hangs(seconds):
            time.sleep(0.01)
        good = not in_session(self.pid)
        self.end()
        return good

    def end(self):
        while True:
            family = in_session(self.pid)
            for pid in family:
                send(pid, signal.SIGKILL)
            self._child.poll()
            if not family:
                break
            time.sleep(0.01)
        self._child.wait()
        with _guard:
            _sessions.discard(self.pid)

    @staticmethod
    def _text(file):
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - TAIL))
        return file.read().decode("utf-8", "replace")
