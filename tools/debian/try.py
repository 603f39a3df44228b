"""What a user of what is installed tries first, from the Debian packages or from the wheel: the first run, its pictures,
a run inside Python, and the examples, which lie beside the cases."""

import subprocess
import sys
from pathlib import Path

import nbclient
import nbformat

import vkdose


def called(*command):
    print("$", *command, flush=True)
    subprocess.run(command, check=True)


print(vkdose.version(), "from", vkdose.__file__, "with", vkdose.program(), flush=True)
with vkdose.Case("quickstart").run("out/try") as run:
    for dose in run.doses():
        print(dose["dose"], dose["mass_kg"], flush=True)
    result = run.wait()
assert len(result.timeseries) > 100
assert result.report().is_file() and result.picture().is_file()

with vkdose.Simulation("mini") as sim:
    print(sim.backend)
    sim.advance(0.05)
    assert sim.positions.shape == (111, 3)

examples = Path(vkdose.program()).resolve().parents[1] / "share/vkdose/cases/python"
scripts = sorted(examples.glob("*.py"))
assert len(scripts) >= 5
for script in scripts:
    called(sys.executable, script)

# A notebook runs in the environment whose kernel is installed there.
if sys.prefix != sys.base_prefix:
    called(sys.executable, "-m", "ipykernel", "install", "--prefix", sys.prefix)
book = nbformat.read(examples / "first_dose.ipynb", as_version=4)
nbclient.NotebookClient(book, timeout=None, kernel_name="python3").execute()
assert "<iframe" in book.cells[-1].outputs[0].data["text/html"]
print("the notebook says:", *(output.text for output in book.cells[1].outputs))
