"""Finds two hidden frictions from the height of the powder while it falls in, by scipy and scikit-learn."""
import sys
import numpy
from scipy.optimize import differential_evolution
from scipy.stats import qmc
from sklearn.gaussian_process import GaussianProcessRegressor, kernels

import vkdose


def heights(frictions):
    """Mean height of the particles, each 5 ms from 20 ms to 60 ms [mm]: what a camera sees through a wall of glass."""
    changes = dict(zip(("contact.friction", "contact.wall.friction"), frictions))
    with vkdose.Simulation("mini", changes, backend="reference") as sim:
        return [sim.positions[:, 1].mean() * 1e3 for _ in zip(range(12), sim.samples())][3:]


hidden = [float(word) for word in sys.argv[1:]] or [0.3, 0.2]
measured, low, high = heights(hidden), numpy.log([0.1, 0.05]), numpy.log([0.7, 0.5])
tried = qmc.scale(qmc.Halton(2, seed=1).random(24), low, high)
runs = numpy.array([heights(numpy.exp(point)) for point in tried])
model = GaussianProcessRegressor(kernels.RBF([1, 1]) + kernels.WhiteKernel(0.01), normalize_y=True).fit(tried, runs)
miss = lambda point: (((model.predict([point]) - measured) / runs.std(axis=0)) ** 2).sum()
found = numpy.exp(differential_evolution(miss, list(zip(low, high)), seed=1).x)
print("found {:.3f} and {:.3f}; hidden were {:g} and {:g}".format(*found, *hidden))
