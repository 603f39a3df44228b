"""Spheres of several materials among meshes, in Yade: a part of tools/bench-peers, which calls it by
`yade -n -x dosta-yade.py INPUT.json`. It prints a line STEP SPHERES COUNT ... at the start and after every `every` steps,
as the other programs do: how many spheres there are, and how many of a powder lie in each box. With a ball it prints the
ball's height and speed upwards in place of the counts; the ball stands still until its step `from`.
Yade runs this text with its own names (O, FrictMat, facet ...) in place of modules."""
# ruff: noqa: F821
import csv
import json
import math
import struct
import sys

task = json.load(open(sys.argv[-1]))
material = {
    name: O.materials.append(FrictMat(density=of["density"], young=of["young"], poisson=task["poisson"], label=name))
    for name, of in task["materials"].items()
}
pairs = [(material[a], material[b], restitution, math.atan(friction)) for a, b, restitution, friction in task["pairs"]]


def triangles(file):
    """The corners of each triangle of a binary STL."""
    data = open(file, "rb").read()
    for i in range(struct.unpack_from("<I", data, 80)[0]):
        corners = struct.unpack_from("<9f", data, 84 + 50 * i + 12)
        yield corners[0:3], corners[3:6], corners[6:9]


facets = {}
for name, corners in [(mesh, triangles(mesh)) for mesh in task["meshes"]] + list(task.get("triangles", {}).items()):
    facets[name] = O.bodies.append([facet(t, material="steel") for t in corners])
powder = {}
for row in csv.DictReader(open(task["spheres"])):
    at = tuple(float(row[axis]) for axis in ("x", "y", "z"))
    powder[O.bodies.append(sphere(at, float(row["radius"]), material=row["powder"]))] = row["powder"]

ball = None
if "ball" in task:
    number = O.bodies.append(sphere(task["ball"]["at"], task["ball"]["radius"], material="steel"))
    ball = O.bodies[number].state
    ball.blockedDOFs = "xyzXYZ"

movers = []
for motion in task.get("motions", []):
    ids = [i for name in motion["of"] for i in facets[name]]
    if motion["kind"] == "turn":
        engine = RotationEngine(
            ids=ids, rotateAroundZero=True, zeroPoint=(0, 0, 0), rotationAxis=motion["axis"], angularVelocity=motion["rate"]
        )
    else:
        speed = math.hypot(*motion["velocity"])
        engine = TranslationEngine(ids=ids, translationAxis=[v / speed for v in motion["velocity"]], velocity=speed)
    engine.dead = True
    movers.append((motion, engine))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()], verletDist=task["reach"] / 2),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(hertzian=True)],
        [
            Ip2_FrictMat_FrictMat_MindlinPhys(
                en=MatchMaker(matches=[(a, b, e) for a, b, e, _ in pairs]),
                frictAngle=MatchMaker(matches=[(a, b, angle) for a, b, _, angle in pairs]),
            )
        ],
        [Law2_ScGeom_MindlinPhys_Mindlin()],
    ),
    *[engine for _, engine in movers],
    NewtonIntegrator(damping=0, gravity=(0, -9.81, 0)),
]
O.dt = task["step"]
O.dynDt = False


def tell():
    if ball is not None:
        print(O.iter, len(powder) + 1, f"{ball.pos[1]:.9g} {ball.vel[1]:.9g}", flush=True)
        return
    places = {i: O.bodies[i].state.pos for i in powder}
    counts = [
        sum(
            powder[i] == box["powder"] and all(box["low"][k] < at[k] < box["high"][k] for k in range(3))
            for i, at in places.items()
        )
        for box in task["counts"]
    ]
    print(O.iter, len(powder), *counts, flush=True)
    for i in [i for i, at in places.items() if at[1] < task.get("erase_below", -math.inf)]:
        O.bodies.erase(i)
        del powder[i]


tell()
while O.iter < task["steps"]:
    for motion, engine in movers:  # they begin and end at steps that are told
        engine.dead = not motion["from"] <= O.iter < motion.get("to", math.inf)
    if ball is not None and O.iter == task["ball"]["from"]:
        ball.blockedDOFs = ""
        ball.vel = task["ball"]["velocity"]
    O.run(task["every"], True)
    tell()
