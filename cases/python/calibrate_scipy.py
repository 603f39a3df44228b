"""Looks for the friction with which a case doses a measured mass, by an optimiser of scipy."""

from scipy.optimize import minimize_scalar

import vkdose

device = vkdose.Case("mini", {"stop.max_doses": 1})


def first_dose(friction, seed):
    """Mass of the first dose [g]."""
    case = device.with_({"contact.friction": round(friction, 4), "seed": seed})
    return case.run("out/calibrate", force=True).wait().doses.mass_kg[0] * 1e3


hidden = first_dose(0.3, seed=1)  # what a balance would say
found = minimize_scalar(lambda mu: (first_dose(mu, seed=2) - hidden) ** 2, bounds=(0.1, 0.8), method="bounded",
                        options={"maxiter": 6})
print(f"measured {hidden:.4f} g; nearest with friction {found.x:.3f}, {found.fun**0.5:.4f} g off")
