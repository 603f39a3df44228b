"""Where the powder lies, and how dense: the mid-plane of the canister before and after a dose."""

import vkdose

fields = [{"preset": "mid-plane", "interval_s": 0.1}]
result = vkdose.Case("mini", {"field": fields, "stop.max_doses": 1}).run("out/fields", force=True).wait()
plane = result.field("mid-plane")
# The density of the column over each place along the coil.
columns = plane.groupby(["time_s", "z_m"]).density_kg_m3.mean().unstack()
print((columns.iloc[-1] - columns.iloc[0]).rename("change of density [kg/m3]"))
