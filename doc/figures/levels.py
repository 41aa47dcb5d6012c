#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws levels of detail side by side, with their edges, faces and proven bounds (figure 8 of the
# paper), and writes their statistics as a table if a third name is given.
#
#   surety hierarchy bunny00.off -o levels --format off -t 0.02%,0.1%,0.3%,1%
#   xvfb-run -a python3 levels.py levels picture.png [table.md]
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
import json
import sys
from pathlib import Path

from heat_map import surface
from measure import qualities
from runs import number, per_cent_above, share, write_table
from scene import corners_and_points, draw, from_the_front, read_off

SIZE = (2400, 700)
COLUMNS = ("tolerance", "np", "ne", "Q worst", "Q mean", "Q <= 2", "proven distance")


def row(level, mesh, diagonal):
    quality = qualities(*corners_and_points(mesh))
    return (f"{100 * level['tolerance'] / diagonal:.3g} %", number(level["vertices"], 0),
            number(level["faces"], 0), number(quality.max(), 2), number(quality.mean(), 3),
            share(100 * (quality <= 2).mean()), per_cent_above(100 * level["bound"] / diagonal, 4))


def main(folder, picture_path, table_path=None):
    index = json.loads((Path(folder) / "index.json").read_text(encoding="utf-8"))
    diagonal = index["input"]["diagonal"]
    views, rows = [], []
    for level in index["levels"]:
        mesh = read_off(str(Path(folder) / level["file"]))
        bound = 100 * level["bound"] / diagonal
        views.append((f"{level['faces']:,} faces within {bound:.2g} %", [surface(mesh)]))
        rows.append(row(level, mesh, diagonal))
    draw(views, SIZE, from_the_front(1.1), picture_path)
    if table_path:
        write_table(table_path, rows, COLUMNS)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: levels.py folder picture.png [table.md]")
    main(*sys.argv[1:])
