#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The table of what to expect of unit meshes, in doc/manual/unit_mesh.md.
#
#   python3 expected.py surety models work_folder figure_folder
#
# Needs python3-vtk9.
from runs import arguments, number, share, write_table

MODELS = ("fandisk", "anchor_dense", "bear", "blobby", "bunny00", "elephant", "anchor",
          "couplingdown")
COLUMNS = ("model", "faces before", "after", "unit edges, final and asked for", "Q mean, worst",
           "least angle")


def row(model, report):
    before, after = report["input"], report["output"]
    return (model, number(before["faces"], 0), number(after["faces"], 0),
            f"{share(after['unit_edges'])}, {share(after['given_metric']['unit_edges'])}",
            f"{number(after['Q_avg'], 2)}, {number(after['Q_max'], 1)}",
            number(after["angle_min"], 0))


def main():
    runs, _ = arguments()
    rows = [row(model, runs("remesh", runs.model(model), f"{model}_expected", "-t", "0.1%")[1])
            for model in MODELS]
    write_table(runs.folder / "expected.md", rows, COLUMNS)


if __name__ == "__main__":
    main()
