"""The workbench asked by what is no page of its own: without its token, by another host's name, from another site, for files
outside of its folder, with requests that are torn, too large, slow or nonsense, while runs begin and end. Nothing outside
its folder is read or changed, it goes on answering, and ends when it is told to."""

import http.client
import json
import os
import re
import signal
import socket
import time
import urllib.parse

import folders
from ground import MINI

NAME, TRIES = "browsers", 40

REQUESTS = 30
SECRET = "a secret outside of the folder"
PATHS = ("/api/case?name=", "/api/frame?run=", "/api/history?run=", "/api/events?run=", "/api/members?run=",
         "/file?name=case.toml&run=", "/file?run=out/my&name=", "/page/", "/")
POSTS = ("/api/check", "/api/new", "/api/save", "/api/run", "/api/resume", "/api/stop", "/api/report", "/api/edit", "/api/order",
         "/api/compare", "/api/picture", "/api/mesh?name=../outside.stl", "/api/mesh?name=my.toml")
ESCAPES = ("../outside.toml", "..%2foutside.toml", "%2e%2e/outside.toml", "sub/../../outside.toml", "link.toml",
           "up/outside.toml", "/etc/passwd", "....//outside.toml", "..\\outside.toml", "my.toml%00.txt", "%", "", ".", "..")


class Bench:
    """A workbench that listens, and how its own page asks it."""

    def __init__(self, t, folder):
        self.running = t.start("studio", folder)
        address = None
        while address is None and not self.running.over() and not self.running.hangs(t.ground.patience):
            address = re.search(r"http://127\.0\.0\.1:(\d+)/\?token=(\w+)", self.running.so_far())
            time.sleep(0.01)
        self.port, self.token = (int(address[1]), address[2]) if address else (0, "")
        self.good = {"Host": f"127.0.0.1:{self.port}", "Cookie": f"vkdose-{self.port}={self.token}"}

    def ask(self, method, path, headers, body=None):
        """Status and text of the answer; None if the connection was closed without one."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        try:
            connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
            for name, value in headers.items():
                connection.putheader(name, value)
            if body is not None:
                connection.putheader("Content-Length", str(len(body)))
            connection.endheaders(body)
            answer = connection.getresponse()
            return answer.status, answer.read(1 << 20).decode("utf-8", "replace")
        except (OSError, http.client.HTTPException, ValueError):
            return None
        finally:
            connection.close()

    def throw(self, content, rest=0.0):
        """Bytes that are no request, in two parts if there is to be a rest between them."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=60) as connection:
            half = len(content) // 2
            try:
                connection.sendall(content[:half])
                time.sleep(rest)
                connection.sendall(content[half:])
            except OSError:
                pass


def stranger(t, bench):
    """A request that the gate has to refuse."""
    headers = dict(bench.good)
    way = t.rng.choice(("no token", "wrong token", "host", "origin", "null"))
    if way == "no token":
        del headers["Cookie"]
    if way == "wrong token":
        headers["Cookie"] = f"vkdose-{bench.port}={bench.token[:-1]}x"
    if way == "host":
        headers["Host"] = t.rng.choice(("evil.example", f"evil.example:{bench.port}", "127.0.0.1", "[::1]", ""))
    if way in ("origin", "null"):
        headers["Origin"] = "null" if way == "null" else t.rng.choice(("http://evil.example", "https://127.0.0.1"))
    path = t.rng.choice(("/", "/api/folder", "/api/case?name=my.toml", "/page/studio.js", "/api/running"))
    answer = bench.ask("GET", path, headers)
    if answer is None or answer[0] != 403:
        t.found(f"{way} of {path} is let in: {answer and answer[0]}")


def escape(t, bench):
    """A name that leads outside."""
    name = t.rng.choice(ESCAPES)
    if t.rng.random() < 0.5:
        answer = bench.ask("GET", t.rng.choice(PATHS) + name, bench.good)
    else:
        key = urllib.parse.unquote(name)
        body = json.dumps({"name": key, "run": key, "text": "spoilt", "before": t.rng.choice((None, SECRET)),
                           "force": True, "runs": [key, key], "order": "speed 1\nstop", "key": key, "value": "1",
                           "like": t.rng.choice(("mini", "dosator", "sweep", key)), "of": key}).encode()
        answer = bench.ask("POST", t.rng.choice(POSTS), {**bench.good, "Content-Type": "application/json"}, body)
    if answer is not None and (SECRET in answer[1] or "root:" in answer[1]):
        t.found(f"{name} is read")


def nonsense(t, bench):
    """No JSON, too much of it, or of other kinds; the answer is a refusal."""
    body = t.rng.choice((b"", b"{", b"[]", b"null", b"\xff\xfe", b'{"name": 3}', b'{"name": ["my.toml"], "run": {}}',
                         b"[" * 100000, b'{"name": "' + b"n" * 300000 + b'.toml", "text": ""}', b"x" * (5 << 20)))
    kind = t.rng.choice(("application/json", "text/plain", "application/x-www-form-urlencoded", ""))
    method, path = t.rng.choice(("POST", "PUT", "DELETE", "OPTIONS")), t.rng.choice(POSTS)
    answer = bench.ask(method, path, {**bench.good, "Content-Type": kind}, body)
    if answer is not None and answer[0] == 200:
        t.found(f"{method} {path} with {body[:40]!r} as {kind!r} is taken")


def torn(t, bench):
    """Bytes that are no request, or only a part of one."""
    size = t.rng.choice((1, 100, 10000))
    bench.throw(t.rng.choice((
        bytes(t.rng.randrange(256) for _ in range(size)),
        b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n",
        b"POST /api/save HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n{}",
        b"POST /api/save HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n{}",
        b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n",
        b"GET / HTTP/1.1\r\n" + b"".join(b"X-%d: y\r\n" % i for i in range(5000)) + b"\r\n",
    )), t.rng.choice((0, 0, 0.2)))


def runs(t, bench):
    """Its own page, in a hurry."""
    path = t.rng.choice(("/api/run", "/api/stop", "/api/resume", "/api/report", "/api/order"))
    body = json.dumps({"name": "my.toml", "run": "out/my", "force": t.rng.random() < 0.5,
                       "order": t.rng.choice(("speed 60", "dose 0.01", "stop", "nonsense", ""))}).encode()
    bench.ask("POST", path, {**bench.good, "Content-Type": "application/json"}, body)
    bench.ask("GET", t.rng.choice(("/api/frame?run=out/my", "/api/history?run=out/my", "/api/folder")), bench.good)


def attempt(t):
    work = t.path("work")
    folders.write(t.path("outside.toml"), SECRET)
    folders.write(os.path.join(work, "my.toml"), folders.bytes_of(MINI))
    os.symlink(t.path("outside.toml"), os.path.join(work, "link.toml"))
    os.symlink(t.folder, os.path.join(work, "up"))
    bench = Bench(t, work)
    if bench.port == 0:
        t.found("the workbench does not begin to listen")
        t.ended(bench.running)
        return
    for _ in range(REQUESTS):
        t.rng.choice((stranger, escape, nonsense, torn, runs))(t, bench)
        if bench.running.over():
            t.found("the workbench has ended")
            break
    else:
        answer = bench.ask("GET", "/api/case?name=my.toml", bench.good)
        if answer is None or answer[0] != 200 or "seed = 1" not in answer[1]:
            t.found(f"afterwards it does not answer its own page: {answer and answer[0]}")
    bench.running.send(signal.SIGINT)
    end = t.ended(bench.running)
    if end.code not in (0, None):
        t.found(f"told to end, it ends with {end.how()}: {end.said()}")
    if folders.bytes_of(t.path("outside.toml")).decode() != SECRET:
        t.found("a file outside was changed")
    left = [name for name in os.listdir(work) if name not in ("my.toml", "link.toml", "up", "out")]
    if left or os.listdir(t.folder).count("outside.toml") != 1:
        t.found(f"it leaves {left}")
