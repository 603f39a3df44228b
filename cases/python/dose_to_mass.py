"""A controller doses to a mass: it slows the coil down on the way, and stops it ahead by what fell late last time."""

import vkdose

TARGET = 0.1e-3  # kg

with vkdose.Simulation("mini", {"dose.rotate_s": 2, "stop.max_doses": 3}) as sim:
    while not sim.over:
        sim.advance()
        if not sim.takes_orders:
            continue
        late = sim.ended_doses[-1]["overshoot_kg"] if sim.ended_doses else 0
        if sim.dose_mass + late >= TARGET:
            sim.stop_drive()
        elif sim.dose_mass >= TARGET / 2:
            sim.change_speed(rpm=40)
    for dose in sim.ended_doses:
        mass, cause = dose["mass_kg"] * 1e3, dose["stopped_by"]
        print(f"dose {dose['dose']}: {mass:.3f} g of {TARGET * 1e3:g} g, stopped by {cause}")
