# SPDX-License-Identifier: GPL-3.0-or-later
#
# PNG files with a palette of 256 colours, which VTK chooses but does not write. Flat-shaded meshes
# take a third of the space like this.
import struct
import zlib

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

ROUNDS = 4  # in which colours move to the mean of those that they stand for


def first_palette(image):
    quantize = vtk.vtkImageQuantizeRGBToIndex()
    quantize.SetInputData(image)
    quantize.SetNumberOfColors(256)
    quantize.Update()
    table = quantize.GetLookupTable()
    return 255 * numpy.array(
        [table.GetTableValue(i)[:3] for i in range(table.GetNumberOfTableValues())])


def nearest(colors, palette):
    blocks = numpy.array_split(colors, max(1, len(colors) // 4096))
    return numpy.concatenate(
        [((block[:, None] - palette) ** 2).sum(2).argmin(1) for block in blocks])


def quantized(image):
    """The palette of a picture, and for each pixel its place there."""
    pixels = vtk_to_numpy(image.GetPointData().GetScalars())[:, :3]
    colors, of_pixel, pixels_of = numpy.unique(
        pixels, axis=0, return_inverse=True, return_counts=True)
    palette = first_palette(image)
    for _ in range(ROUNDS):
        chosen = nearest(colors, palette)
        weight = numpy.bincount(chosen, pixels_of, len(palette))
        for k in range(3):
            total = numpy.bincount(chosen, pixels_of * colors[:, k], len(palette))
            palette[:, k] = numpy.where(weight > 0, total / numpy.maximum(weight, 1), palette[:, k])
    palette = palette.round()
    return palette.astype("uint8"), nearest(colors, palette)[of_pixel.ravel()].astype("uint8")


def chunk(kind, data):
    return (struct.pack(">I", len(data)) + kind + data
            + struct.pack(">I", zlib.crc32(kind + data)))


def write_png(image, path):
    width, height, _ = image.GetDimensions()
    palette, pixels = quantized(image)
    rows = pixels.reshape(height, width)[::-1]  # VTK's first row is the lowest
    header = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)  # 8 bits, with a palette
    lines = b"".join(b"\0" + row.tobytes() for row in rows)  # 0: the line as it is
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"PLTE", palette.tobytes())
                   + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))
