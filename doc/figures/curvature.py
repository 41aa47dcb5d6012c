#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws the mean curvature of a model, and a part of it with the principal directions.
#
#   surety info bunny00.off --curvature -o bunny.vtp
#   xvfb-run -a python3 curvature.py bunny.vtp curvature.png
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
import sys

import numpy
import vtk
from scene import DIVERGING, array, color_scale, draw, from_the_front, read_vtp, scale, smooth_surface
from vtk.util.numpy_support import vtk_to_numpy

SIZE = (2000, 1000)


def strokes(data, name, length, color):
    """A short line along a direction at each vertex, a little above the surface."""
    points = vtk_to_numpy(data.GetPoints().GetData()) + 0.25 * length * array(data, "normal")
    half = length / 2 * array(data, name)
    ends, lines = vtk.vtkPoints(), vtk.vtkCellArray()
    for point, offset in zip(points, half):
        lines.InsertNextCell(2)
        lines.InsertCellPoint(ends.InsertNextPoint(*(point - offset)))
        lines.InsertCellPoint(ends.InsertNextPoint(*(point + offset)))
    drawn = vtk.vtkPolyData()
    drawn.SetPoints(ends)
    drawn.SetLines(lines)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(drawn)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*color)
    actor.GetProperty().SetLineWidth(2.0)
    actor.GetProperty().LightingOff()
    return actor


def spacing(data):
    """Side of the square that a vertex has to itself."""
    area = vtk.vtkMassProperties()
    area.SetInputData(data)
    return (area.GetSurfaceArea() / data.GetNumberOfPoints()) ** 0.5


def main(field_path, picture_path):
    data = read_vtp(field_path)
    limit = float(numpy.quantile(numpy.abs(array(data, "mean_curvature")), 0.95))
    colors = color_scale(DIVERGING, -limit, limit)
    length = 0.9 * spacing(data)
    low, high = numpy.array(data.GetBounds()).reshape(3, 2).T

    def aim(i, renderer):
        from_the_front(1.25, -0.06)(i, renderer)
        if i == 1:  # the upper third of the model, from the same side
            camera = renderer.GetActiveCamera()
            camera.SetWindowCenter(0, 0)
            target = (low + high) / 2 + (high - low) * numpy.array([-0.22, 0.25, 0.0])
            shift = target - numpy.array(camera.GetFocalPoint())
            camera.SetFocalPoint(*target)
            camera.SetPosition(*(numpy.array(camera.GetPosition()) + shift))
            camera.Zoom(4.5)

    views = [
        ("mean curvature", [smooth_surface(data, "mean_curvature", colors), scale(colors)]),
        ("directions of least (black) and largest curvature (orange)",
         [smooth_surface(data, "mean_curvature", colors),
          strokes(data, "min_direction", length, (0.05, 0.05, 0.05)),
          strokes(data, "max_direction", length, (0.95, 0.55, 0.0))]),
    ]
    draw(views, SIZE, aim, picture_path)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: curvature.py field.vtp picture.png")
    main(*sys.argv[1:])
