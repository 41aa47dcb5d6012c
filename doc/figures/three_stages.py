#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# A finite-element mesh of a CAD part in three stages (table 1, figures 3 and 5 of the paper):
# the input, the geometric mesh and the unit mesh, with their statistics.
#
#   xvfb-run -a python3 three_stages.py surety models work_folder figure_folder
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
from heat_map import surface
from runs import (
    arguments, judged, number, result_row, row, share, worst_quality_elsewhere, write_table)
from scene import color_scale, draw, fitted, points_of, read_off, read_vtp, scale

SIZE = (1600, 1200)
TOLERANCE = "0.1%"
PARTS = {"anchor_dense": (-0.5, 0.6, 1), "fandisk": (0.6, 0.5, 1)}  # from where they are seen
AIMS = ("unit mesh of", "Q mean, at most 1.19", "Q <= 2, at least 99.5 %",
        "Q worst but in sharp corners, at most 3", "tau, at least 0.97", "faces in sharp corners")
# Dark is round; what is above 2 catches the eye.
QUALITY = [(49, 104, 142), (116, 173, 209), (224, 243, 248), (254, 224, 144), (215, 48, 39)]


def stages(runs, part):
    geometric = runs("simplify", runs.model(part), f"{part}_geometric", "-t", TOLERANCE)
    unit = runs("remesh", runs.model(part), f"{part}_unit", "-t", TOLERANCE)
    return geometric, unit


def picture(part, given, geometric, unit, path):
    colors = color_scale(QUALITY, 1, 2.5)
    meshes = [read_off(str(given)), read_vtp(geometric), read_vtp(unit)]
    names = ("input", "geometric mesh", "unit mesh")
    views = [(f"{name}: {mesh.GetNumberOfPolys():,} faces", [surface(mesh)])
             for name, mesh in zip(names, meshes)]
    views.append(("Q of the unit mesh", [surface(meshes[2], colors, "quality"), scale(colors)]))
    draw(views, SIZE, fitted(points_of(meshes[0]), PARTS[part]), path, columns=2)


def aims(part, path, result):
    worst, sharp = worst_quality_elsewhere(path)
    mean, good, tau = (result[name] for name in ("Q_avg", "Q_le_2", "efficiency_index"))
    return (part, judged(number(mean, 3), mean <= 1.19), judged(share(good), good >= 99.5),
            judged(number(worst, 2), worst <= 3), judged(number(tau, 3), tau >= 0.97),
            number(sharp, 0))


def main():
    runs, figures = arguments()
    rows, reached = [], []
    for part in PARTS:
        (geometric, simplified), (unit, remeshed) = stages(runs, part)
        picture(part, runs.model(part), geometric, unit, str(figures / f"stages_{part}.png"))
        rows += [row(f"{part}, input", simplified["input"]),
                 result_row("geometric mesh", simplified), result_row("unit mesh", remeshed)]
        reached.append(aims(part, unit, remeshed["output"]))
    write_table(runs.folder / "three_stages.md", rows)
    write_table(runs.folder / "aims_of_parts.md", reached, AIMS)


if __name__ == "__main__":
    main()
