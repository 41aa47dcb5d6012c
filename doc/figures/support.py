#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws stripes of equal angle between light and normal on a mesh, and on its geometric support.
#
#   surety info knot1.off --support -t 5% --subdivisions 8 -o support.vtp
#   xvfb-run -a python3 support.py knot1.off support.vtp support.png
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
import sys

import numpy
import vtk
from scene import array, draw, from_a_corner, read_off, read_vtp
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SIZE = (2000, 1000)
LIGHT = numpy.array([1, 2, 3]) / 14**0.5  # as that of the support's own stripes
PAIRS = 10
DARK, BRIGHT = (0.13, 0.30, 0.47), (0.97, 0.95, 0.90)


def stripes(normals):
    """1 where the stripes are bright, -1 where they are dark."""
    angle = numpy.arccos(numpy.clip(normals @ LIGHT, -1, 1))
    return numpy.cos(2 * PAIRS * angle)


def with_normals(data):
    maker = vtk.vtkPolyDataNormals()
    maker.SetInputData(data)
    maker.SplittingOff()
    maker.ConsistencyOff()
    maker.ComputeCellNormalsOn()
    maker.ComputePointNormalsOff()
    maker.Update()
    return maker.GetOutput()


def striped(data, values, of_faces=False):
    numbers = numpy_to_vtk(values, deep=True)
    numbers.SetName("stripes")
    (data.GetCellData() if of_faces else data.GetPointData()).SetScalars(numbers)
    colors = vtk.vtkColorTransferFunction()
    for value, color in ((-1, DARK), (-0.25, DARK), (0.25, BRIGHT), (1, BRIGHT)):
        colors.AddRGBPoint(value, *color)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetLookupTable(colors)
    mapper.UseLookupTableScalarRangeOn()
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetAmbient(0.55)
    actor.GetProperty().SetDiffuse(0.45)
    return actor


def main(mesh_path, support_path, picture_path):
    mesh, support = read_off(mesh_path), read_vtp(support_path)
    flat = with_normals(mesh)
    facets = striped(flat, stripes(vtk_to_numpy(flat.GetCellData().GetNormals())), True)
    smooth = striped(support, stripes(array(support, "normal")))
    views = [("the mesh", [facets]), ("its geometric support", [smooth])]
    draw(views, SIZE, from_a_corner(1.25), picture_path)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: support.py mesh.off support.vtp picture.png")
    main(*sys.argv[1:])
