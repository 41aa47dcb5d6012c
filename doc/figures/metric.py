#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws unit balls of an isotropic and of an anisotropic metric on a surface, at scattered vertices
# that no feature passes. Colours tell the ratio of the axes.
#
#   surety info fandisk.off --curvature --metric -t 0.1% --metric-kind isotropic -o round.vtp
#   surety info fandisk.off --curvature --metric -t 0.1% -o stretched.vtp
#   xvfb-run -a python3 metric.py round.vtp stretched.vtp metric.png
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
import sys

import numpy
import vtk
from scene import array, color_scale, draw, from_a_corner, read_vtp, scale
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SIZE = (2000, 1000)
CORNERS = 40  # of the polygon that stands for an ellipse
RATIOS = [(34, 94, 168), (65, 182, 196), (254, 217, 118), (227, 26, 28)]


def axes(data):
    """Half axes of the unit ellipses in the tangent planes, by vertex: short and long."""
    normal, small = array(data, "normal"), array(data, "smallest_size")
    if data.GetPointData().GetArray("largest_size") is None:
        along, large = array(data, "min_direction"), small
    else:
        along, large = array(data, "smallest_size_direction"), array(data, "largest_size")
    # Where both sizes are equal any direction will do, but one in the tangent plane.
    axis = numpy.eye(3)[numpy.abs(normal).argmin(axis=1)]
    along = numpy.where((small < 0.999 * large)[:, None], along, numpy.cross(normal, axis))
    along = along - (along * normal).sum(1)[:, None] * normal
    along /= numpy.linalg.norm(along, axis=1)[:, None]
    return small[:, None] * along, large[:, None] * numpy.cross(normal, along)


def scattered(points, short, long, normal, candidates):
    """Vertices whose ellipses, at half size, do not overlap: greedily, the smaller ones first."""
    chosen = []
    areas = numpy.linalg.norm(short, axis=1) * numpy.linalg.norm(long, axis=1)
    for v in candidates[numpy.argsort(areas[candidates], kind="stable")]:
        others = numpy.array(chosen, dtype=int)
        offset = points[others] - points[v]
        near = numpy.ones(len(others))
        for u in (numpy.full(len(others), v), others):
            x = (offset * short[u]).sum(1) / (short[u] ** 2).sum(1)
            y = (offset * long[u]).sum(1) / (long[u] ** 2).sum(1)
            z = (offset * normal[u]).sum(1) / numpy.linalg.norm(long[u], axis=1)
            near = numpy.minimum(near, numpy.sqrt(x**2 + y**2 + z**2))
        if len(others) == 0 or near.min() >= 1:
            chosen.append(v)
    return chosen


def ellipses(data):
    points = vtk_to_numpy(data.GetPoints().GetData())
    normal = array(data, "normal")
    short, long = axes(data)
    smooth = numpy.flatnonzero(array(data, "sides") == 1)
    corners, polygons, ratios = vtk.vtkPoints(), vtk.vtkCellArray(), []
    lift = 0.002 * numpy.ptp(points, axis=0).max()
    for v in scattered(points, short, long, normal, smooth):
        polygons.InsertNextCell(CORNERS)
        for angle in numpy.arange(CORNERS) * 2 * numpy.pi / CORNERS:
            corner = (points[v] + lift * normal[v]
                      + 0.48 * (numpy.cos(angle) * short[v] + numpy.sin(angle) * long[v]))
            polygons.InsertCellPoint(corners.InsertNextPoint(*corner))
        ratios.append(numpy.linalg.norm(long[v]) / numpy.linalg.norm(short[v]))
    drawn = vtk.vtkPolyData()
    drawn.SetPoints(corners)
    drawn.SetPolys(polygons)
    values = numpy_to_vtk(numpy.array(ratios), deep=True)
    values.SetName("ratio")
    drawn.GetCellData().SetScalars(values)
    return drawn


def painted(data, colors=None):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    if colors is None:
        mapper.ScalarVisibilityOff()
        look.SetColor(0.9, 0.89, 0.87)
        look.SetInterpolationToFlat()
    else:
        mapper.SetLookupTable(colors)
        mapper.UseLookupTableScalarRangeOn()
        look.LightingOff()
    look.SetAmbient(0.35)
    look.SetDiffuse(0.65)
    return actor


def main(isotropic_path, anisotropic_path, picture_path):
    colors = color_scale(RATIOS, 1, 10, by_logarithm=True)
    views = []
    for text, path in (("isotropic", isotropic_path), ("anisotropic", anisotropic_path)):
        data = read_vtp(path)
        balls = ellipses(data)
        views.append((f"{text}: unit circles" if text == "isotropic" else
                      f"{text}: unit ellipses, and the ratio of their axes",
                      [painted(data), painted(balls, colors)]))
    views[1][1].append(scale(colors))

    draw(views, SIZE, from_a_corner(1.05), picture_path)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: metric.py isotropic.vtp anisotropic.vtp picture.png")
    main(*sys.argv[1:])
