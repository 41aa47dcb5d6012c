#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Unit meshes without gradation, with the default and with a slow one (table 2 and figure 6 of the
# paper), with their statistics.
#
#   xvfb-run -a python3 graded_meshes.py surety models work_folder figure_folder
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
from heat_map import surface
from runs import arguments, judged, number, result_row, share, write_table
from scene import draw, fitted, points_of, read_vtp

SIZE = (2100, 560)
PART, SMOOTH, TOLERANCE = "fandisk", "blobby", "0.1%"
OFF = "1000"  # the flag takes finite numbers; no sizes of a mesh are as far apart
GRADATIONS = {"without gradation": OFF, "gradation 1.3": "1.3", "gradation 1.1": "1.1"}
AIMS = ("mesh", "Q mean, at most 1.14", "Q <= 2, at least 99.9 %")


def aims(name, result):
    mean, good = result["Q_avg"], result["Q_le_2"]
    return (name, judged(number(mean, 3), mean <= 1.14), judged(share(good), good >= 99.9))


def main():
    runs, figures = arguments()
    rows, reached, views = [], [], []
    for model in (PART, SMOOTH):
        for name, gradation in GRADATIONS.items():
            path, report = runs("remesh", runs.model(model), f"{model}_gradation_{gradation}",
                                "-t", TOLERANCE, "--gradation", gradation)
            rows.append(result_row(f"{model}, {name}", report))
            if gradation != OFF:
                reached.append(aims(f"{model}, {name}", report["output"]))
            if model == PART:
                mesh = read_vtp(path)
                views.append((f"{name}: {report['output']['faces']:,} faces", [surface(mesh)]))
    draw(views, SIZE, fitted(points_of(mesh), (0.6, 0.5, 1)),
         str(figures / "graded_meshes.png"))
    write_table(runs.folder / "graded_meshes.md", rows)
    write_table(runs.folder / "aims_of_gradation.md", reached, AIMS)


if __name__ == "__main__":
    main()
