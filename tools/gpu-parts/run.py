"""Running programs within the time that is left. A program that takes longer is ended, with all that it started."""

import os
import signal
import subprocess
import time


class Deadline:
    """Seconds that are left of a time. `now` is a clock that never goes back."""

    def __init__(self, seconds, now=time.monotonic):
        self.now = now
        self.end = now() + seconds

    def left(self):
        return self.end - self.now()

    def part(self, seconds):
        """A deadline after so many seconds from now, and no later than this one."""
        return Deadline(min(seconds, max(0.0, self.left())), self.now)


class Ended:
    """How a program ended."""

    def __init__(self, code, text, overran):
        self.code = code  # of its exit, -N by signal N, None if it could not be started
        self.text = text  # what it said on stdout and stderr
        self.overran = overran

    def words(self):
        if self.overran:
            return "overran its time and was ended"
        if self.code is None:
            return "could not be started: " + self.text
        if self.code < 0:
            return f"ended by signal {-self.code}"
        return "" if self.code == 0 else f"exit code {self.code}"


def _kill(process, number):
    try:
        os.killpg(process.pid, number)
    except ProcessLookupError:
        pass


def run(words, seconds, log, environment, folder, grace=5.0):
    """Runs a program for at most so many seconds, and says in the file `log` what it said. After its time it is
    interrupted, and `grace` seconds later killed."""
    os.makedirs(os.path.dirname(log), exist_ok=True)
    with open(log, "wb") as out:
        try:
            process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT,
                                       env=environment, cwd=folder, start_new_session=True)
        except OSError as error:
            return Ended(None, str(error), False)
        overran = False
        try:
            process.wait(max(0.0, seconds))
        except subprocess.TimeoutExpired:
            overran = True
            _kill(process, signal.SIGINT)
            try:
                process.wait(grace)
            except subprocess.TimeoutExpired:
                pass
        except BaseException:
            _kill(process, signal.SIGKILL)
            process.wait()
            raise
        _kill(process, signal.SIGKILL)  # what it started and left behind
        process.wait()
    with open(log, "rb") as said:
        text = said.read().decode("utf-8", "replace")
    return Ended(process.returncode, text, overran)
