# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the programs that draw the manual's figures share: reading meshes, colours, titles, and views
# side by side in one picture. Needs python3-vtk9.
import numpy
import vtk
from palette import write_png
from vtk.util.numpy_support import vtk_to_numpy

# Samples of "cool to warm", the colours of the fields that surety writes to PLY files.
DIVERGING = [(59, 76, 192), (141, 176, 254), (221, 221, 221), (244, 152, 122), (180, 4, 38)]
GAP = 5  # pixels at either side of a view


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


def array(data, name):
    """The values of an array of the vertices."""
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def corners_and_points(data):
    """The faces of a triangle mesh as rows of three vertices, and the points of these."""
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return corners, points_of(data)


def color_scale(samples, low, high, by_logarithm=False):
    colors = vtk.vtkColorTransferFunction()
    for i, sample in enumerate(samples):
        t = i / (len(samples) - 1)
        value = low * (high / low) ** t if by_logarithm else low + (high - low) * t
        colors.AddRGBPoint(value, *(c / 255 for c in sample))
    if by_logarithm:
        colors.SetScaleToLog10()
    return colors


def smooth_surface(data, name, colors):
    """A mesh without its edges, coloured by an array of its vertices."""
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(name)
    mapper.SetLookupTable(colors)
    mapper.UseLookupTableScalarRangeOn()
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetAmbient(0.45)
    actor.GetProperty().SetDiffuse(0.55)
    return actor


def title(text):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    actor.GetTextProperty().SetFontSize(30)
    actor.GetTextProperty().SetColor(0.1, 0.1, 0.1)
    actor.GetTextProperty().SetJustificationToCentered()
    actor.GetTextProperty().SetBackgroundColor(1, 1, 1)
    actor.GetTextProperty().SetBackgroundOpacity(1)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.GetTextProperty().SetVerticalJustificationToTop()
    actor.SetPosition(0.5, 0.985)
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


def draw(views, size, aim, picture_path, columns=None):
    """Views, pairs of a title and actors, side by side, in rows of `columns` if that is given; `aim`
    gets the number of each and its renderer, to place the camera."""
    columns = columns or len(views)
    rows = -(-len(views) // columns)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*size)
    ground = vtk.vtkRenderer()  # behind the gaps
    ground.SetBackground(1, 1, 1)
    window.AddRenderer(ground)
    for i, (text, actors) in enumerate(views):
        row, column = divmod(i, columns)
        renderer = vtk.vtkRenderer()
        gap = GAP / size[0]
        renderer.SetViewport(column / columns + gap, 1 - (row + 1) / rows,
                             (column + 1) / columns - gap, 1 - row / rows)
        renderer.SetBackground(1, 1, 1)
        renderer.AddActor(title(text))
        for actor in actors:
            renderer.AddActor(actor)
        window.AddRenderer(renderer)
        aim(i, renderer)
    window.Render()

    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    image.Update()
    write_png(image.GetOutput(), picture_path)


def from_the_front(zoom, shift=0):
    """A camera in front of a model that stands upright; `shift` leaves room below."""

    def aim(_, renderer):
        camera = renderer.GetActiveCamera()
        camera.SetPosition(0, 0.15, 1)
        camera.SetViewUp(0, 1, 0)
        renderer.ResetCamera()
        camera.Zoom(zoom)
        camera.SetWindowCenter(0, shift)

    return aim


def from_a_corner(zoom):
    """A camera to the right of a model and above it."""

    def aim(_, renderer):
        camera = renderer.GetActiveCamera()
        camera.SetPosition(0.6, 0.5, 1)
        camera.SetViewUp(0, 1, 0)
        renderer.ResetCamera()
        camera.Zoom(zoom)
        camera.SetWindowCenter(0, -0.05)

    return aim


def fitted(points, direction, up=(0, 1, 0)):
    """A camera without perspective that sees all of these points, looking against a direction.
    Room is left for a title and a scale of colours."""
    away = numpy.array(direction, float) / numpy.linalg.norm(direction)
    right = numpy.cross(up, away)
    right /= numpy.linalg.norm(right)
    upwards = numpy.cross(away, right)
    depth = float(numpy.ptp(points @ away))
    centre, extent = numpy.zeros(3), []
    for axis in (right, upwards, away):
        low, high = (points @ axis).min(), (points @ axis).max()
        centre += (low + high) / 2 * axis
        extent.append(high - low)

    def aim(_, renderer):
        width, height = renderer.GetSize()
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetViewUp(*up)
        camera.SetFocalPoint(*centre)
        camera.SetPosition(*(centre + 2 * depth * away))
        camera.SetParallelScale(max(extent[1] / 0.78, extent[0] / 0.94 * height / width) / 2)
        renderer.ResetCameraClippingRange()

    return aim
