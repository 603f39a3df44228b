"""A study of four members: dose against speed, two seeds each, as a table and a picture."""

import matplotlib

matplotlib.use("Agg")
import vkdose

study = vkdose.Study({"base": "mini", "seeds": 2, "axis": [{"key": "coil.speed_rpm", "values": [60, 120]}]})
members = study.sweep("out/sweep-and-plot").members
print(members[["coil.speed_rpm", "seed", "mean_dose_kg"]])
dose = members.groupby("coil.speed_rpm").mean_dose_kg
axes = (dose.mean() * 1e3).plot(yerr=dose.std() * 1e3, marker="o", xlabel="speed [rpm]", ylabel="mean dose [g]")
axes.figure.savefig("out/sweep-and-plot.png")
