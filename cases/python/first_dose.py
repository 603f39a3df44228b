"""The first dose of a case: its mass, and the torque on the way."""

import vkdose

with vkdose.Case("mini").run("out/first-dose") as run:
    dose = next(run.doses())

seen = vkdose.Result("out/first-dose").timeseries.query("phase == 'rotate'")
print(f"dose 1: {dose['mass_kg'] * 1e3:.3f} g of {dose['closed_form_mass_kg'] * 1e3:.3f} g by the closed form")
print(f"largest torque: {seen.coil_torque_Nm.max() * 1e3:.3f} mN m")
