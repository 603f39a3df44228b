"""Looks with VTK's reader at the image that tests/output/vtk_test.cpp made. image_check.py FILE"""
import sys

import h5py
from vtkmodules.vtkIOHDF import vtkHDFReader

reader = vtkHDFReader()
assert reader.CanReadFile(sys.argv[1])
reader.SetFileName(sys.argv[1])
reader.Update()
image = reader.GetOutput()
assert image.GetClassName() == "vtkImageData"
assert image.GetDimensions() == (3, 4, 5)
assert image.GetOrigin() == (0.1, 0.2, 0.3)
assert image.GetSpacing() == (1, 0.5, 0.25)
where, number = (image.GetPointData().GetArray(name) for name in ("where", "number"))
for z in range(5):
    for y in range(4):
        for x in range(3):
            point = image.ComputePointId((x, y, z))
            assert where.GetTuple(point) == (x, y, z) and number.GetValue(point) == x + 10 * y + 100 * z
with h5py.File(sys.argv[1]) as file:
    assert file["FieldData/TimeValue"][0] == 0.75 and file["FieldData/TimeValue"].attrs["unit"] == b"s"
