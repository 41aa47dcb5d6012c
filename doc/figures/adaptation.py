#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Meshes of a CAD part that follow the front of a field (figure 11 of the paper), next to meshes of
# even sizes: how well each interpolates the field. The field is a formula here; doc/examples has a
# field that is solved for, and adapt_to_front prints its errors.
#
#   xvfb-run -a python3 adaptation.py surety models work_folder figure_folder
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
import numpy
from heat_map import surface
from measure import interpolation_error
from runs import arguments, number, per_cent_above, write_table
from scene import (
    DIVERGING, color_scale, corners_and_points, draw, fitted, points_of, read_off, scale,
    smooth_surface)
from vtk.util.numpy_support import numpy_to_vtk

SIZE = (1600, 1200)
MODEL, TOLERANCE = "fandisk", "0.1%"
TARGETS = (1000, 2000, 4000)
EVEN_SIZES = ("3%", "1.5%", "0.75%")
LOOPS = 2
VIEW = (0.6, 0.5, 1)
COLUMNS = ("mesh", "np", "ne", "Q worst", "tau in its metric", "L2 error", "proven distance")


class Front:
    """A front of the given width, in units of the diagonal, along a sphere about a corner."""

    def __init__(self, points):
        self.diagonal = float(numpy.linalg.norm(numpy.ptp(points, axis=0)))
        low, high = points.min(axis=0), points.max(axis=0)
        self.centre = numpy.array([low[0], high[1], high[2]])
        self.radius, self.width = 0.45, 0.015

    def __call__(self, points):
        distance = numpy.linalg.norm(points - self.centre, axis=-1) / self.diagonal
        return numpy.tanh((distance - self.radius) / self.width)


def write_solution(values, path):
    text = f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{len(values)}\n1 1\n"
    path.write_text(text + "".join(f"{v!r}\n" for v in values.tolist()) + "End\n", encoding="utf-8")


def adapted(runs, field, vertices):
    """Each loop sees the field on the mesh of the one before, and starts from the input."""
    given = runs.model(MODEL)
    seen = given
    for loop in range(LOOPS):
        solution = runs.folder / f"front_{vertices}_{loop}.sol"
        write_solution(field(points_of(read_off(str(seen)))), solution)
        path, report = runs(
            "adapt", given, f"front_{vertices}_{loop}.off", "-t", TOLERANCE, "--solution",
            str(solution), "--background", str(seen), "--target-vertices", str(vertices))
        seen = path
    return read_off(path), report


def even(runs, size):
    path, report = runs("remesh", runs.model(MODEL), f"even_{size[:-1]}.off", "-t", TOLERANCE,
                        "--max-size", size)
    return read_off(path), report


def row(name, mesh, report, field):
    result, bound = report["output"], report["certificate"]["bound"]
    return (name, number(result["vertices"], 0), number(result["faces"], 0),
            number(result["Q_max"], 1), number(result["efficiency_index"], 3),
            f"{interpolation_error(*corners_and_points(mesh), field):.2g}",
            per_cent_above(100 * bound / report["input"]["diagonal"], 4))


def with_values(mesh, field):
    values = numpy_to_vtk(field(points_of(mesh)), deep=True)
    values.SetName("u")
    mesh.GetPointData().AddArray(values)
    return mesh


def main():
    runs, figures = arguments()
    original = read_off(str(runs.model(MODEL)))
    field = Front(points_of(original))
    rows, of_even, of_front = [], [], []
    for size in EVEN_SIZES:
        of_even.append(even(runs, size))
        rows.append(row(f"sizes up to {size[:-1]} %", *of_even[-1], field))
    for vertices in TARGETS:
        of_front.append(adapted(runs, field, vertices))
        rows.append(row(f"adapted, {vertices:,} asked for", *of_front[-1], field))

    write_table(runs.folder / "adaptation.md", rows, COLUMNS)

    colors = color_scale(DIVERGING, -1, 1)
    even_mesh, mesh = of_even[0][0], of_front[0][0]
    views = [
        ("the field", [smooth_surface(with_values(original, field), "u", colors), scale(colors)]),
        (f"sizes up to {EVEN_SIZES[0][:-1]} %: {even_mesh.GetNumberOfPolys():,} faces",
         [surface(even_mesh)]),
        (f"adapted: {mesh.GetNumberOfPolys():,} faces", [surface(mesh)]),
        ("", [surface(mesh)])]
    points = points_of(mesh)
    on_front = points[abs(field(points)) < 0.5]
    nearest = on_front[(on_front @ VIEW).argmax()]
    around = points[numpy.linalg.norm(points - nearest, axis=1) < 0.12 * field.diagonal]
    whole, detail = fitted(points, VIEW), fitted(around, VIEW)

    def aim(i, renderer):
        (whole if i < 3 else detail)(i, renderer)

    draw(views, SIZE, aim, str(figures / "adaptation.png"), columns=2)


if __name__ == "__main__":
    main()
