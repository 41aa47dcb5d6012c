#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws the sizes of a metric without and with gradation, in one scale of colours.
#
#   surety info fandisk.off --metric -t 0.1% --metric-kind isotropic --gradation inf -o off.vtp
#   surety info fandisk.off --metric -t 0.1% --metric-kind isotropic --gradation 1.3 -o on.vtp
#   xvfb-run -a python3 gradation.py off.vtp on.vtp gradation.png
#
# Needs python3-vtk9, and a display, which xvfb-run provides where there is none.
import sys

from scene import (
    DIVERGING, array, color_scale, draw, from_a_corner, read_vtp, scale, smooth_surface)

SIZE = (2000, 1000)


def main(off_path, on_path, picture_path):
    fields = [read_vtp(off_path), read_vtp(on_path)]
    sizes = [array(field, "smallest_size") for field in fields]
    low, high = (float(f(f(s) for s in sizes)) for f in (min, max))
    colors = color_scale(DIVERGING, low, high, by_logarithm=True)
    surfaces = [smooth_surface(field, "smallest_size", colors) for field in fields]
    views = [("size without gradation", [surfaces[0], scale(colors)]),
             ("with gradation", [surfaces[1]])]

    draw(views, SIZE, from_a_corner(1.05), picture_path)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: gradation.py off.vtp on.vtp picture.png")
    main(*sys.argv[1:])
