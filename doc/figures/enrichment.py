#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Coarse models refined towards the smooth surface that they stand for, and made into meshes for
# simulation (figures 9 and 10 of the paper), with statistics.
#
#   xvfb-run -a python3 enrichment.py surety models work_folder figure_folder
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
from heat_map import surface
from runs import arguments, number, per_cent_above, result_row, row, share, write_table
from scene import draw, fitted, points_of, read_off, read_vtp

SIZE = (1600, 1150)
TOLERANCE = "0.2%"
# A smooth one and a mechanical one, each with its flags and from where it is seen.
MODELS = {"eight": ((), (0.3, 0.9, 1)), "dragknob": (("--feature-angle", "40"), (0.6, 0.5, 1))}
COLUMNS = ("mesh", "np", "ne", "Q mean", "Q <= 2", "distance to the input", "damped faces")


def enriched_row(report):
    output, reported = report["output"], report["reported"]
    return ("enriched", number(output["vertices"], 0), number(output["faces"], 0),
            number(output["Q_avg"], 3), share(output["Q_le_2"]),
            per_cent_above(100 * reported["deviation"] / report["input"]["diagonal"], 4),
            number(reported["damped_faces"], 0))


def plain_row(name, statistics):
    return (name, number(statistics["vertices"], 0), number(statistics["faces"], 0),
            number(statistics["Q_avg"], 3), share(statistics["Q_le_2"]), "", "")


def main():
    runs, figures = arguments()
    rows, unit_rows, views, aims = [], [], [], []
    for model, (flags, direction) in MODELS.items():
        given = runs.model(model)
        fine, report = runs("enrich", given, f"{model}_enriched.off", "-t", TOLERANCE, *flags)
        unit, remeshed = runs("remesh", fine, f"{model}_of_enriched", "-t", "0.1%", *flags)
        rows += [plain_row(f"{model}, input", report["input"]), enriched_row(report)]
        unit_rows += [row(f"{model}, enriched", remeshed["input"]),
                      result_row("unit mesh", remeshed)]
        meshes = [read_off(str(given)), read_off(fine), read_vtp(unit)]
        views += [(f"{name}: {mesh.GetNumberOfPolys():,} faces", [surface(mesh)])
                  for name, mesh in zip(("input", "enriched", "its unit mesh"), meshes)]
        aims += [fitted(points_of(meshes[0]), direction)] * 3
    write_table(runs.folder / "enrichment.md", rows, COLUMNS)
    write_table(runs.folder / "unit_mesh_of_enriched.md", unit_rows)
    draw(views, SIZE, lambda i, renderer: aims[i](i, renderer), str(figures / "enrichment.png"),
         columns=3)


if __name__ == "__main__":
    main()
