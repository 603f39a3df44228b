"""Opens the frames of a run with VTK's own reader and with h5py, as their users do, and looks at a picture of one.

vtk_check.py RUN PAGE PICTURE: the output folder of a run, the page of the manual with the lines for h5py, where to leave the picture.
"""
import csv
import io
import json
import os
import re
import subprocess
import sys
from contextlib import redirect_stdout

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkGlyph3D
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkWindowToImageFilter
from vtkmodules.vtkRenderingOpenGL2 import vtkXOpenGLRenderWindow

run, page, picture = sys.argv[1:4]
frames = os.path.join(run, "frames")


def check(holds, what):
    if not holds:
        sys.exit(f"vtk_check: {what}")


def load(name):
    reader = vtkHDFReader()
    file = os.path.join(frames, name)
    check(reader.CanReadFile(file), f"{name} is not for vtkHDFReader")
    reader.SetFileName(file)
    reader.Update()
    grid = reader.GetOutput()
    check(grid is not None and grid.GetClassName() == "vtkUnstructuredGrid", f"{name} is no grid")
    return grid


def array(data, name):
    found = data.GetArray(name)
    check(found is not None, f"there is no array {name}")
    return vtk_to_numpy(found)


def points(grid):
    return vtk_to_numpy(grid.GetPoints().GetData())


def table(name):
    with open(os.path.join(run, name)) as file:
        return list(csv.DictReader(file))


def check_particles(index):
    """The last frame is the end state, number for number."""
    rows = table("particles.csv")
    grid = load(f"particles_{index[-1]['frame']:0>6}.hdf")
    data = grid.GetPointData()
    check(grid.GetNumberOfPoints() == len(rows) == grid.GetNumberOfCells(), "not a vertex for each particle")
    check(grid.GetCellType(0) == 1, "no vertices")
    for name, columns in {"velocity": ["vx_m_s", "vy_m_s", "vz_m_s"], "spin": ["wx_rad_s", "wy_rad_s", "wz_rad_s"],
                          "radius": ["radius_m"], "id": ["id"]}.items():
        expected = np.array([[float(row[c]) for c in columns] for row in rows])
        check((array(data, name).reshape(expected.shape) == expected).all(), f"{name} is not that of particles.csv")
    expected = np.array([[float(row[c]) for c in ("x_m", "y_m", "z_m")] for row in rows])
    check((points(grid) == expected).all(), "positions are not those of particles.csv")
    status = [["active", "dosed", "lost"][s] for s in array(data, "status")]
    check(status == [row["status"] for row in rows], "status is not that of particles.csv")
    check((array(data, "member") == 5).all(), "not the member it was said to be")
    # The time series has the sum over what still moves, in nine digits; each here is a float.
    energy = array(data, "kinetic_energy")[array(data, "status") == 0].sum(dtype=float)
    expected = float(table("timeseries.csv")[-1]["kinetic_energy_J"])
    check(abs(energy - expected) <= 1e-6 * expected, f"kinetic energy {energy}, in the time series {expected}")
    time = array(grid.GetFieldData(), "TimeValue")[0]
    check(time == float(index[-1]["time_s"]), "not the time of frames.csv")
    return grid


def check_contacts(number, particles):
    """Lines from centre to centre, whose forces add up to those of the particles."""
    grid = load(f"contacts_{number:0>6}.hdf")
    data = grid.GetCellData()
    kind, one, other, force = (array(data, name) for name in ("kind", "particle", "other", "force"))
    check(set(kind) == {0, 1, 2}, "not all kinds of contacts are there")
    check(all(grid.GetCellType(c) == 3 for c in range(grid.GetNumberOfCells())), "no lines")
    ends = points(grid).reshape(-1, 2, 3)
    centre, radius = points(particles), array(particles.GetPointData(), "radius")
    near = 1e-5 * radius.min()  # floats, of a canister of some centimetres
    check((abs(ends[:, 0] - centre[one]) < near).all(), "a line does not begin at its particle")
    pairs = kind == 0
    check((abs(ends[pairs, 1] - centre[other[pairs]]) < near).all(), "a line does not end at the other particle")
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    reach = radius[one] + np.where(pairs, radius[np.where(pairs, other, 0)], 0)
    overlap = array(data, "overlap")
    check((abs(reach - length - overlap) < near).all(), "a line is not as long as its overlap says")
    normal, across = array(data, "normal_force"), array(data, "tangential_force")
    size = np.linalg.norm(force, axis=1)
    check(np.allclose(normal**2 + across**2, size**2, rtol=1e-5), "the parts of a force are not its parts")
    sums = np.zeros_like(centre)
    np.add.at(sums, one, force)
    np.add.at(sums, other[pairs], -force[pairs])
    worst = abs(sums - array(particles.GetPointData(), "force")).max()
    check(worst <= 1e-6 * size.max(), f"forces of contacts and particles differ by {worst} N")


def check_surfaces(index):
    """The coil lies where it has turned to; the canister is as large as the case says."""
    first, last = (points(load(f"coil_{entry['frame']:0>6}.hdf")) for entry in (index[0], index[-1]))
    angle = float(index[-1]["coil_angle_rad"])
    check(abs(angle) > 0.1, "the coil has not turned")
    turn = np.array([[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    check((abs(first @ turn - last) < 1e-8).all(), "the coil has not turned with the run")
    from_axis = np.hypot(last[:, 0], last[:, 1])
    check(5.1e-3 - 1e-8 < from_axis.min() and from_axis.max() < 6.7e-3 + 1e-8, "the coil has another size")
    low, high = (f(points(load("walls.hdf")), axis=0) for f in (np.min, np.max))
    check((abs(low - [-7e-3, -7e-3, 0]) < 1e-8).all(), f"the canister begins at {low}")
    check((abs(high - [7e-3, 53e-3, 21e-3]) < 1e-8).all(), f"the canister ends at {high}")


def check_series(index):
    for kind in ("particles", "contacts", "coil"):
        with open(os.path.join(frames, f"{kind}.hdf.series")) as file:
            files = json.load(file)["files"]
        check([(f["name"], f["time"]) for f in files] ==
              [(f"{kind}_{entry['frame']:0>6}.hdf", float(entry["time_s"])) for entry in index],
              f"the series of {kind} is not the list of frames")


def check_page(particles, number):
    """The lines for h5py, as they stand on the page."""
    with open(page) as file:
        block = re.search(r"((?:    .*\n)*    import h5py\n(?:    .*\n)*)", file.read()).group(1)
    lines = [line[4:] for line in block.splitlines()]
    check(len(lines) <= 5, "the lines for h5py are more than five")
    code = "\n".join(lines).replace("out/quickstart", run).replace("000012", f"{number:0>6}")
    check(run in code and number in code, "the lines for h5py read another file")
    said = io.StringIO()
    with redirect_stdout(said):
        exec(code, {})
    top = (points(particles)[:, 1] + array(particles.GetPointData(), "radius")).max()
    time = array(particles.GetFieldData(), "TimeValue")[0]
    check(re.findall(r"[\d.e+-]*\d", said.getvalue()) == [str(time), str(top)], f"the lines for h5py say {said.getvalue()}")


def render(particles, coil):
    """A picture from the outlet along the axis, parallel rays: particles red, the coil green, both as bright everywhere."""
    scene = vtkRenderer()
    scene.SetBackground(1, 1, 1)
    ball = vtkSphereSource()
    ball.SetRadius(1)
    ball.SetThetaResolution(24)
    ball.SetPhiResolution(24)
    glyphs = vtkGlyph3D()
    particles.GetPointData().SetActiveScalars("radius")
    glyphs.SetInputData(particles)
    glyphs.SetSourceConnection(ball.GetOutputPort())
    glyphs.SetScaleModeToScaleByScalar()
    skin = vtkGeometryFilter()
    skin.SetInputData(coil)
    for source, colour in ((glyphs, (1, 0, 0)), (skin, (0, 1, 0))):
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        mapper.ScalarVisibilityOff()
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(*colour)
        actor.GetProperty().LightingOff()
        scene.AddActor(actor)
    camera = scene.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetPosition(0, 0, 1)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 1, 0)
    camera.SetParallelScale(0.01)
    scene.ResetCameraClippingRange()
    window = vtkXOpenGLRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(200, 200)
    window.AddRenderer(scene)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    writer = vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()
    image = grab.GetOutput()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(200, 200, -1)[:, :, :3]


def check_picture(particles, coil):
    """Every pixel shows what lies in front there: computed for spheres and wire without VTK."""
    pixels = render(particles, coil)
    at = (np.arange(200) + 0.5) / 100 * 0.01 - 0.01
    x, y = np.meshgrid(at, at)
    depth = np.full(x.shape, -1.0)
    for centre, radius in zip(points(particles), array(particles.GetPointData(), "radius")):
        under = radius**2 - (x - centre[0]) ** 2 - (y - centre[1]) ** 2
        depth = np.where(under > 0, np.maximum(depth, centre[2] + np.sqrt(np.maximum(under, 0))), depth)
    ring = abs(np.hypot(x, y) - 5.9e-3) < 0.8e-3  # three turns cover it everywhere
    red = (pixels == [255, 0, 0]).all(axis=2)
    green = (pixels == [0, 255, 0]).all(axis=2)
    white = (pixels == [255, 255, 255]).all(axis=2)
    check((red | green | white).all(), "colours that are none of the scene's")
    balls, empty = (depth > -1) & ~ring, (depth <= -1) & ~ring
    check(balls.mean() > 0.1 and empty.mean() > 0.1 and ring.mean() > 0.1, "the scene is not worth a picture")
    # Edges: a ball of 24 corners is short of round by a hundredth, the wire of ten by a twentieth of its thickness.
    for name, expected, shown in (("particles", balls, red), ("background", empty, white), ("coil", ring, red | green)):
        wrong = (expected & ~shown).sum() / expected.sum()
        check(wrong < 0.05, f"{wrong:.1%} of the pixels of the {name} show something else")
    check((ring & green).sum() > 0.05 * ring.sum(), "the coil is nowhere to be seen")


def check_force_network(number):
    """The tool draws coil and contacts, and says what the largest force is."""
    tool = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "force-network")
    drawn = picture + ".forces.png"
    said = subprocess.run([tool, run, number, drawn], capture_output=True, text=True, check=True).stdout
    largest = array(load(f"contacts_{number:0>6}.hdf").GetCellData(), "normal_force").max()
    check(said.startswith(f"pushes up to {largest:.3g} N"), f"tools/force-network says {said}")
    reader = vtkPNGReader()
    reader.SetFileName(drawn)
    reader.Update()
    red, green, blue = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int).T[:3]
    check((abs(red - blue) + abs(red - green) < 30).mean() < 0.999, "no contacts in its picture")
    check(((red < 220) & (abs(red - blue) < 20)).mean() > 0.02, "no coil in its picture")
    refused = subprocess.run([tool, run, "999999", drawn], capture_output=True, text=True)
    check(refused.returncode != 0 and "there is no such file" in refused.stderr, "a frame that is not there is not refused")


index = table(os.path.join("frames", "frames.csv"))
check(len(index) > 3, "few frames")
last = index[-1]["frame"]
particles = check_particles(index)
check_contacts(last, particles)
check_surfaces(index)
check_series(index)
check_page(particles, last)
reading, writing = os.pipe()
server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "640x480x24", "-nolisten", "tcp"],
                          pass_fds=[writing], stderr=subprocess.DEVNULL)
os.close(writing)
try:
    display = os.read(reading, 16).decode().strip()
    check(display != "", "Xvfb does not start")
    os.environ["DISPLAY"] = ":" + display
    check_picture(particles, load(f"coil_{last:0>6}.hdf"))
    check_force_network(last)
finally:
    server.terminate()
    server.wait()
print("vtk_check: all is well")
