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

SIZE = (2100, 840)


def read_off(path):
    """VTK has no reader for OFF."""
    with open(path, encoding="utf-8") as file:
        words = " ".join(line.split("#")[0] for line in file).split()
    count, faces = int(words[1]), int(words[2])
    points, polygons = vtk.vtkPoints(), vtk.vtkCellArray()
    for i in range(count):
        points.InsertNextPoint(*(float(x) for x in words[4 + 3 * i : 7 + 3 * i]))
    position = 4 + 3 * count
    for _ in range(faces):
        corners = int(words[position])
        polygons.InsertNextCell(corners)
        for corner in words[position + 1 : position + 1 + corners]:
            polygons.InsertCellPoint(int(corner))
        position += 1 + corners
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polygons)
    return data


def read_vtp(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def heat_colors(tolerance):
    """The same colours as those of surety's PLY files."""
    samples = [(68, 1, 84), (65, 68, 135), (42, 120, 142), (34, 168, 132), (122, 209, 81),
               (253, 231, 37)]
    colors = vtk.vtkColorTransferFunction()
    for i, sample in enumerate(samples):
        colors.AddRGBPoint(tolerance * i / (len(samples) - 1), *(c / 255 for c in sample))
    return colors


def surface(data, colors=None):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    if colors is not None:
        mapper.ScalarVisibilityOn()
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray("deviation")
        mapper.SetLookupTable(colors)
        mapper.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetInterpolationToFlat()
    look.SetColor(0.86, 0.84, 0.80)
    look.SetAmbient(0.25 if colors is None else 0.6)
    look.SetDiffuse(0.75 if colors is None else 0.4)
    if colors is None:
        look.EdgeVisibilityOn()
        look.SetEdgeColor(0.15, 0.18, 0.25)
        look.SetLineWidth(1.0)
    return actor


def title(text):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    actor.GetTextProperty().SetFontSize(30)
    actor.GetTextProperty().SetColor(0.1, 0.1, 0.1)
    actor.GetTextProperty().SetJustificationToCentered()
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(0.5, 0.94)
    return actor


def scale(colors):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetNumberOfLabels(3)
    bar.SetLabelFormat("%.3g")
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.2, 0.015)
    bar.SetWidth(0.6)
    bar.SetHeight(0.07)
    bar.UnconstrainedFontSizeOn()
    bar.GetLabelTextProperty().SetFontSize(24)
    bar.GetLabelTextProperty().SetColor(0.1, 0.1, 0.1)
    bar.GetLabelTextProperty().ShadowOff()
    bar.GetLabelTextProperty().ItalicOff()
    bar.GetLabelTextProperty().BoldOff()
    return bar


def main(original_path, simplified_path, report_path, picture_path):
    with open(report_path, encoding="utf-8") as file:
        report = json.load(file)
    tolerance = report["certificate"]["tolerance"]
    colors = heat_colors(tolerance)
    original, simplified = read_off(original_path), read_vtp(simplified_path)
    views = [
        (f"input: {report['input']['faces']:,} faces", [surface(original)]),
        (f"output: {report['output']['faces']:,} faces", [surface(simplified)]),
        ("proven deviation, up to the tolerance", [surface(simplified, colors), scale(colors)]),
    ]

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    for i, (text, actors) in enumerate(views):
        renderer = vtk.vtkRenderer()
        renderer.SetViewport(i / len(views), 0, (i + 1) / len(views), 1)
        renderer.SetBackground(1, 1, 1)
        renderer.AddActor(title(text))
        for actor in actors:
            renderer.AddActor(actor)
        camera = renderer.GetActiveCamera()
        camera.SetPosition(0, 0.15, 1)
        camera.SetViewUp(0, 1, 0)
        renderer.ResetCamera()
        camera.Zoom(1.2)
        camera.SetWindowCenter(0, -0.06)  # room for the scale below
        window.AddRenderer(renderer)
    window.Render()

    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture_path)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit("usage: heat_map.py original.off simplified.vtp report.json picture.png")
    main(*sys.argv[1:])
