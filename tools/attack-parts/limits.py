"""Limits: the stacks, the address space or the open files of a run are limited. It works, with the files of an
undisturbed run, or it says what it lacks."""

NAME, TRIES = "limits", 60
MEBIBYTE = 1 << 20
CODES = (3, 4, 5)  # it could not go on, the device failed, a result could not be written


def attempt(t):
    backend = t.rng.choice(("vulkan", "vulkan", "reference"))
    good, _ = t.ground.good("short", backend)
    folder = t.path("run")
    kinds = ("stack", "nofile") if t.ground.sanitized else ("stack", "as", "as", "nofile")
    kind = t.rng.choice(kinds)
    value = {"stack": t.rng.randint(48, 1024) << 10, "as": t.rng.randint(150, 900) * MEBIBYTE,
             "nofile": t.rng.randint(6, 60)}[kind]
    t.note(f"{kind} limited to {value}")
    words = t.ground.run_words("short", backend, folder)
    running = t.start(*words, limits=[f"--{kind}={value}"])
    end = t.ended(running)
    if end.code == 0:
        t.expect_same(good, folder, f"{kind} limited to {value}, exit 0, but")
        return
    if kind == "stack":
        t.found(f"a stack of {value >> 10} KiB ends it with {end.how()}: {end.said()}")
    elif end.code not in CODES + ((2,) if kind == "nofile" else ()):
        t.found(f"{kind} limited to {value}: {end.how()}: {end.said()}")
    elif not end.err.strip():
        t.found(f"{kind} limited to {value}: {end.how()} without a word")
    elif kind == "as" and "(ulimit -v)" not in end.err:
        t.found(f"an address space of {value // MEBIBYTE} MiB is not told: {end.said()}")
