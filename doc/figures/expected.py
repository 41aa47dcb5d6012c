#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The tables of what to expect of unit meshes, in doc/manual/unit_mesh.md.
#
#   python3 expected.py surety models work_folder figure_folder
#
# Needs python3-vtk9.
from runs import arguments, number, share, write_table

MODELS = ("fandisk", "anchor_dense", "bear", "blobby", "bunny00", "elephant", "anchor",
          "couplingdown")
FEWEST_MODELS = ("fandisk", "anchor_dense", "elephant", "bunny00", "couplingdown")
FEWEST_COLUMNS = ("model", "isotropic", "unit edges", "anisotropic", "unit edges")
COLUMNS = ("model", "faces before", "after", "unit edges, final and asked for", "Q mean, worst",
           "least angle")


def row(model, report):
    before, after = report["input"], report["output"]
    return (model, number(before["faces"], 0), number(after["faces"], 0),
            f"{share(after['unit_edges'])}, {share(after['given_metric']['unit_edges'])}",
            f"{number(after['Q_avg'], 2)}, {number(after['Q_max'], 1)}",
            number(after["angle_min"], 0))


def fewest(runs, model):
    cells = [model]
    for kind in ("isotropic", "anisotropic"):
        after = runs("remesh", runs.model(model), f"{model}_fewest_{kind}", "-t", "0.1%",
                     "--fewest", "--metric", kind)[1]["output"]
        cells += [number(after["faces"], 0),
                  f"{share(after['unit_edges'])}, {share(after['given_metric']['unit_edges'])}"]
    return tuple(cells)


def main():
    runs, _ = arguments()
    rows = [row(model, runs("remesh", runs.model(model), f"{model}_expected", "-t", "0.1%")[1])
            for model in MODELS]
    write_table(runs.folder / "expected.md", rows, COLUMNS)
    write_table(runs.folder / "fewest.md", [fewest(runs, model) for model in FEWEST_MODELS],
                FEWEST_COLUMNS)


if __name__ == "__main__":
    main()
