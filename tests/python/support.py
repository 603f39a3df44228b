"""What the tests of the Python package share."""

import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "host" / "python"))
sys.path.append(str(Path(os.environ.get("VKDOSE", "")).parent / "python"))  # its module, if it was built

try:
    import h5py  # noqa: E402, F401
    import jsonschema  # noqa: E402, F401
    import matplotlib  # noqa: E402, F401
    import pandas  # noqa: E402, F401
    import scipy  # noqa: E402, F401

    import vkdose  # noqa: E402
except ModuleNotFoundError as lack:
    if lack.name == "vkdose":
        raise
    print(f"skipped: no Python module {lack.name} (tools/packages-python)")
    sys.exit(77)

# A time step four times as long as mini's. Soft particles overlap deeper, which is no fault here.
SOFT = {"contact.soften": 16, "contact.max_overlap_ratio": 1}
# A run of a second.
SHORT = {
    **SOFT,
    "settle.time_s": 0.05,
    "dose.rotate_s": 0.1,
    "dose.rest_s": 0.02,
    "stop.max_doses": 2,
}


class InFolder(unittest.TestCase):
    """Each test has a folder of its own, which is the current one."""

    def setUp(self):
        before = os.getcwd()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, before)
        os.chdir(folder.name)


def short(**changes):
    return vkdose.Case("mini", {**SHORT, **changes})


def run(case, out="run"):
    """A run on the reference, which is the same everywhere."""
    return case.run(out, backend="reference")


def run_examples(inside):
    """Runs the blocks one after another, as a reader would, and returns their number and the names that they give.

    Their mini is a softer and shorter one: the program looks for a case in `cases` of the current folder first.
    """
    blocks = examples(inside)
    Path("cases").mkdir()
    changes = dict(SHORT)
    if inside:  # these blocks name times, which are to lie in the same phases as in mini
        changes.update({"settle.time_s": 0.15, "dose.rotate_s": 0.15})
    settings = "".join(f"{key} = {value}\n" for key, value in changes.items())
    Path("cases/mini.toml").write_text(f'base = "{ROOT}/cases/mini.toml"\n{settings}', encoding="utf-8")
    names = {"vkdose": vkdose} if inside else {}  # the first block of the page imports it
    assert Path("cases/mini.toml").samefile(vkdose.Case("mini").check().file)
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)
    return len(blocks), names


def examples(inside):
    """The blocks of Python on the package's page: those of the section on runs inside Python, or all others."""
    page = (ROOT / "host" / "python" / "README.md").read_text(encoding="utf-8")
    before, title, rest = page.partition("## A run inside Python\n")
    section, following, after = rest.partition("\n## ")
    text = section if inside else before + following + after
    return re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
