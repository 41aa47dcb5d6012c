#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws levels of detail side by side, with their edges, faces and proven bounds.
#
#   surety hierarchy bunny00.off -o levels --format off -t 0.02%,0.1%,0.3%,1%
#   xvfb-run -a python3 levels.py levels picture.png
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
import json
import sys
from pathlib import Path

from heat_map import surface
from scene import draw, from_the_front, read_off

SIZE = (2400, 700)


def main(folder, picture_path):
    index = json.loads((Path(folder) / "index.json").read_text(encoding="utf-8"))
    diagonal = index["input"]["diagonal"]
    levels = index["levels"]
    views = []
    for level in levels:
        bound = 100 * level["bound"] / diagonal
        views.append((f"{level['faces']:,} faces within {bound:.2g} %",
                      [surface(read_off(Path(folder) / level["file"]))]))
    draw(views, SIZE, from_the_front(1.1), picture_path)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: levels.py folder picture.png")
    main(*sys.argv[1:])
