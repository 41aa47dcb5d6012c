#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws a model and its unit meshes side by side, with their edges.
#
#   surety remesh fandisk.off -o round.off -t 0.1%
#   surety remesh fandisk.off -o long.off -t 0.1% --metric anisotropic
#   xvfb-run -a python3 unit_mesh.py fandisk.off round.off long.off picture.png
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
import sys

from heat_map import surface
from scene import draw, from_a_corner, read_off

SIZE = (2400, 640)


def main(input_path, isotropic_path, anisotropic_path, picture_path):
    views = []
    for name, path in (("input", input_path), ("isotropic", isotropic_path),
                       ("anisotropic", anisotropic_path)):
        data = read_off(path)
        views.append((f"{name}: {data.GetNumberOfPolys():,} faces", [surface(data)]))
    draw(views, SIZE, from_a_corner(1.3), picture_path)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit("usage: unit_mesh.py input.off isotropic.off anisotropic.off picture.png")
    main(*sys.argv[1:])
