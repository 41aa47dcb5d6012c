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

import vtk
from heat_map import read_off, surface, title

SIZE = (2400, 700)


def main(folder, picture_path):
    index = json.loads((Path(folder) / "index.json").read_text(encoding="utf-8"))
    diagonal = index["input"]["diagonal"]
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    levels = index["levels"]
    for i, level in enumerate(levels):
        renderer = vtk.vtkRenderer()
        renderer.SetViewport(i / len(levels), 0, (i + 1) / len(levels), 1)
        renderer.SetBackground(1, 1, 1)
        bound = 100 * level["bound"] / diagonal
        renderer.AddActor(title(f"{level['faces']:,} faces within {bound:.2g} %"))
        renderer.AddActor(surface(read_off(Path(folder) / level["file"])))
        camera = renderer.GetActiveCamera()
        camera.SetPosition(0, 0.15, 1)
        camera.SetViewUp(0, 1, 0)
        renderer.ResetCamera()
        camera.Zoom(1.1)
        window.AddRenderer(renderer)
    window.Render()

    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture_path)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: levels.py folder picture.png")
    main(*sys.argv[1:])
