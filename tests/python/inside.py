"""What tests of runs inside Python share. Ends the test, and tells why, if they cannot be had."""

import os
import sys

import support  # noqa: F401  first: it tells what is missing

import vkdose

try:
    import vkdose._core
except ImportError as lack:
    print(f"skipped: the module for runs inside Python was not built ({lack})")
    sys.exit(77)

DEVICE = os.environ.get("VKDOSE_TEST_DEVICE", "")


def simulation(case, **options):
    """On the reference, which is the same everywhere."""
    return vkdose.Simulation(case, backend="reference", **options)
