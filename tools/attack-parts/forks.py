"""Forks: Python opens simulations and forks, and a daemon thread may be inside one when Python ends. Nothing hangs, no
process ends by a signal, and the parent's run is that of an undisturbed one."""

import glob
import os

import folders

NAME, TRIES = "forks", 30

SCRIPT = """
import os, sys, threading
import vkdose
CASE = {"settle.time_s": 0.03, "dose.rotate_s": 0.06, "dose.rest_s": 0.01, "stop.max_doses": 2, "seed": %(seed)d}
def opened():
    return vkdose.Simulation("mini", CASE, backend=%(backend)r)
def refused(call):
    try:
        call()
    except vkdose.VkdoseError:
        return
    sys.exit("a fork used the simulation of its parent")
sim, codes = opened(), []
for step in range(%(steps)d):
    sim.advance(0.005)
    if step not in %(forks)r:
        continue
    child = os.fork()
    if child == 0:
        refused(sim.advance)
        way = %(way)r
        if way == "own":
            own = opened()
            own.advance(0.005)
        if way == "closed":
            sim.close()
        if way == "at once":
            os._exit(0)
        sys.exit(0)
    codes.append(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
sim.run()
with opened() as undisturbed:
    undisturbed.run()
    same = (undisturbed.positions == sim.positions).all()
if %(daemon)r:
    busy = vkdose.Simulation("mini", {"stop.rule": "none", "stop.max_doses": 1000000}, backend=%(backend)r)
    threading.excepthook = lambda told: None
    threading.Thread(target=busy.run, daemon=True).start()
print(codes == [0] * len(%(forks)r) and same)
"""


def attempt(t):
    module = os.path.join(os.path.dirname(t.ground.program), "python")
    if t.ground.sanitized or not glob.glob(os.path.join(module, "vkdose", "_core*")):
        t.note("no module for runs inside Python beside the program")
        return
    steps = t.rng.randint(1, 8)
    script = SCRIPT % {"seed": t.rng.randint(1, 1000), "backend": t.rng.choice(("reference", "vulkan")), "steps": steps,
                       "forks": sorted(t.rng.sample(range(steps), t.rng.randint(1, steps))),
                       "way": t.rng.choice(("own", "closed", "at once", "plain")), "daemon": t.rng.random() < 0.5}
    folders.write(t.path("script.py"), script)
    end = t.python(t.path("script.py"), module)
    if end.code is not None and (end.code != 0 or end.out.strip() != "True"):
        t.found(f"{end.how()}: {end.out.strip()}: {end.said()}")
