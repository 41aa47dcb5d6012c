#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# A scan made into a mesh for simulation (figure 7 of the paper), with two tolerances, and where the
# tolerance is spent; with statistics.
#
#   xvfb-run -a python3 decimation.py surety models work_folder figure_folder
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
from heat_map import HEAT, surface
from runs import arguments, result_row, row, write_table
from scene import color_scale, draw, fitted, read_off, read_vtp, scale

SIZE = (1600, 1400)
MODEL, TOLERANCES = "armadillo", ("0.1%", "0.3%")


def main():
    runs, figures = arguments()
    original = read_off(str(runs.model(MODEL)))
    views = [(f"input: {original.GetNumberOfPolys():,} faces", [surface(original)])]
    rows = []
    for tolerance in TOLERANCES:
        path, report = runs("remesh", runs.model(MODEL), f"{MODEL}_{tolerance[:-1]}",
                            "-t", tolerance)
        if not rows:
            rows.append(row(f"{MODEL}, input", report["input"]))
        rows.append(result_row(f"within {tolerance[:-1]} %", report))
        mesh = read_vtp(path)
        views.append((f"within {tolerance[:-1]} %: {report['output']['faces']:,} faces",
                      [surface(mesh)]))
    limit = report["certificate"]["tolerance"]
    colors = color_scale(HEAT, 0, limit)
    views.append((f"proven deviation, up to {TOLERANCES[-1][:-1]} % of the diagonal",
                  [surface(mesh, colors), scale(colors)]))
    draw(views, SIZE, fitted(original, (0, 0.15, -1)), str(figures / "decimation.png"), columns=2)
    write_table(runs.folder / "decimation.md", rows)


if __name__ == "__main__":
    main()
