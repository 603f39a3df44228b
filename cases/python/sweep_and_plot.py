"""Dose against speed: a study of four members as a table and a picture."""
import vkdose

study = vkdose.Study({"base": "mini", "seeds": 2, "axis": [{"key": "coil.speed_rpm", "values": [60, 120]}]})
members = study.sweep("out/sweep-and-plot").members
print(members[["coil.speed_rpm", "seed", "mean_dose_kg"]])

grams = members.groupby("coil.speed_rpm").mean_dose_kg.agg(["mean", "std"]) * 1e3
axes = grams.plot(y="mean", yerr="std", marker="o", xlabel="speed [rpm]", ylabel="mean dose [g]")
axes.figure.savefig("out/sweep-and-plot.png")
