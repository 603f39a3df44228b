"""What a user of the installed packages tries first: a run, its tables, a study of four members with a plot."""

import vkdose

with vkdose.Case("mini", {"frames.interval_s": 0.2}).run("out/try") as run:
    for dose in run.doses():
        print(dose["dose"], dose["mass_kg"])
    result = run.wait()
assert len(result.timeseries) > 100 and result.frames[-1].positions.shape[1] == 3

study = vkdose.Study({"base": "mini", "seeds": 2, "axis": [{"key": "coil.speed_rpm", "values": [60, 90]}]})
members = study.sweep("out/try-sweep").members
print(members.groupby("coil.speed_rpm").mean_dose_kg.mean())
assert len(members) == 4
