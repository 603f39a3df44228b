"""Which powder comes out first: where the particles of the doses lay when the coil began to turn."""

import pandas

import vkdose

result = vkdose.Case("mini", {"frames.interval_s": 0.05}).run("out/which-first", force=True).wait()
before = next(frame for frame in result.frames if frame.phase == "rotate")

places = pandas.DataFrame(before.positions * 1e3, columns=["across", "up", "along the coil"])
later = result.particles.set_index("id").status.loc[before.particles["id"]]
print("mean place at the start of the first dose [mm], by the state at the end")
print(places.groupby(later.to_numpy()).mean().round(2))
