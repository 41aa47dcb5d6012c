#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# A scan made into meshes for simulation with two tolerances (figure 7 of the paper): what is left of
# its shape, and the faces; with statistics.
#
#   xvfb-run -a python3 decimation.py surety models work_folder figure_folder
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
from heat_map import surface
from runs import arguments, result_row, row, write_table
from scene import draw, fitted, points_of, read_off, read_vtp

SIZE = (1200, 920)
MODEL, TOLERANCES = "armadillo", ("0.1%", "0.3%")
FRONT = (0, 0.15, -1)


def main():
    runs, figures = arguments()
    meshes, names, rows = [read_off(str(runs.model(MODEL)))], ["input"], []
    for tolerance in TOLERANCES:
        path, report = runs("remesh", runs.model(MODEL), f"{MODEL}_{tolerance[:-1]}",
                            "-t", tolerance)
        if not rows:
            rows.append(row(f"{MODEL}, input", report["input"]))
        meshes.append(read_vtp(path))
        names.append(f"within {tolerance[:-1]} %")
        rows.append(result_row(names[-1], report))
    write_table(runs.folder / "decimation.md", rows)

    views = [(f"{name}: {mesh.GetNumberOfPolys():,} faces", [surface(mesh, edges=False)])
             for name, mesh in zip(names, meshes)]
    views += [("", [surface(mesh)]) for mesh in meshes]
    points = points_of(meshes[0])
    head = points[(points[:, 1] > 42) & (abs(points[:, 0]) < 28)]
    whole, detail = fitted(points, FRONT), fitted(head, FRONT)

    def aim(i, renderer):
        (whole if i < len(meshes) else detail)(i, renderer)

    draw(views, SIZE, aim, str(figures / "decimation.png"), columns=len(meshes))


if __name__ == "__main__":
    main()
