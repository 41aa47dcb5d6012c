#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws a model before and after simplification, and the simplified one coloured by the deviation
# that is proven for each face.
#
#   xvfb-run -a python3 heat_map.py original.off simplified.vtp report.json picture.png
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
import json
import sys

import vtk
from scene import color_scale, draw, from_the_front, read_off, read_vtp, scale

SIZE = (2100, 840)


# The colours of surety's PLY files.
HEAT = [(68, 1, 84), (65, 68, 135), (42, 120, 142), (34, 168, 132), (122, 209, 81), (253, 231, 37)]


def surface(data, colors=None, name="deviation", edges=True):
    """A mesh, with its edges unless it is coloured by an array of its faces."""
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    if colors is not None:
        mapper.ScalarVisibilityOn()
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray(name)
        mapper.SetLookupTable(colors)
        mapper.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetInterpolationToFlat()
    look.SetColor(0.86, 0.84, 0.80)
    look.SetAmbient(0.25 if colors is None else 0.6)
    look.SetDiffuse(0.75 if colors is None else 0.4)
    if colors is None and edges:
        look.EdgeVisibilityOn()
        look.SetEdgeColor(0.15, 0.18, 0.25)
        look.SetLineWidth(1.0)
    return actor


def main(original_path, simplified_path, report_path, picture_path):
    with open(report_path, encoding="utf-8") as file:
        report = json.load(file)
    tolerance = report["certificate"]["tolerance"]
    colors = color_scale(HEAT, 0, tolerance)
    original, simplified = read_off(original_path), read_vtp(simplified_path)
    views = [
        (f"input: {report['input']['faces']:,} faces", [surface(original)]),
        (f"output: {report['output']['faces']:,} faces", [surface(simplified)]),
        ("proven deviation, up to the tolerance", [surface(simplified, colors), scale(colors)]),
    ]

    draw(views, SIZE, from_the_front(1.2, -0.06), picture_path)  # with room for the scale


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit("usage: heat_map.py original.off simplified.vtp report.json picture.png")
    main(*sys.argv[1:])
