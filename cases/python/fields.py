"""Where the powder lies, and how dense: a map of the mid-plane of the canister before and after a dose."""

import vkdose

fields = [{"preset": "mid-plane", "interval_s": 0.1}]
result = vkdose.Case("mini", {"field": fields, "stop.max_doses": 1}).run("out/fields", force=True).wait()

plane = result.field("mid-plane").set_index(["time_s", "y_m", "z_m"]).to_xarray()
density = plane.density_kg_m3.fillna(0)
change = density.isel(time_s=-1) - density.isel(time_s=0)
print(change.mean("y_m").to_series().rename("change of density along the coil [kg/m3]"))
change.plot().figure.savefig("out/fields.png")
