# SPDX-License-Identifier: GPL-3.0-or-later
#
# What tests of surety info share: surfaces that are known, readers of what it writes, and a folder
# to run it in.
import json
import math
import os
import struct
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

SURETY = os.environ.get("SURETY", "surety")
DATA = os.environ.get("SURETY_DATA_DIR", "")
DONE, USAGE, BAD_INPUT = 0, 2, 3


def sphere(rounds=4):
    """An octahedron, split and pushed out to the unit sphere."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4),
             (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(rounds):
        middles = {}

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                sums = [x + y for x, y in zip(points[a], points[b])]
                middles[key] = len(points)
                points.append(tuple(x / math.hypot(*sums) for x in sums))
            return middles[key]

        split = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            split += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = split
    return points, faces


def cylinder(around=48, along=24, height=3):
    """With flat caps: ridges between sides whose curvatures differ."""
    points = [(math.cos(2 * math.pi * i / around), math.sin(2 * math.pi * i / around),
               height * j / along) for j in range(along + 1) for i in range(around)]
    faces = []
    for j in range(along):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            faces += [(a, b, b + around), (a, b + around, a + around)]
    for z, ring, turned in ((0, 0, True), (height, along * around, False)):
        points.append((0, 0, z))
        for i in range(around):
            a, b = ring + i, ring + (i + 1) % around
            faces.append((b, a, len(points) - 1) if turned else (a, b, len(points) - 1))
    return points, faces


def off_text(mesh):
    points, faces = mesh
    lines = [f"OFF\n{len(points)} {len(faces)} 0"]
    lines += [" ".join(map(repr, map(float, p))) for p in points]
    lines += ["3 " + " ".join(map(str, f)) for f in faces]
    return "\n".join(lines) + "\n"


def read_vtp(path, part="PointData"):
    """Arrays by name, a list of rows each: of the vertices; or of "CellData", "Points", "Polys"."""
    arrays = {}
    for element in xml.parse(path).getroot().iter(part):
        for array in element:
            numbers = list(map(float, array.text.split()))
            width = int(array.get("NumberOfComponents"))
            arrays[array.get("Name")] = [
                numbers[i : i + width] for i in range(0, len(numbers), width)]
    return arrays


def read_ply_vertices(path):
    """Vertices as dictionaries, from a binary file."""
    header, data = path.read_bytes().split(b"end_header\n", 1)
    names, code, count = [], "<", 0
    in_vertices = False
    for line in header.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            in_vertices = words[1] == "vertex"
            count = int(words[2]) if in_vertices else count
        elif words[0] == "property" and in_vertices:
            names.append(words[2])
            code += {"double": "d", "int": "i", "uchar": "B"}[words[1]]
    size = struct.calcsize(code)
    return [dict(zip(names, struct.unpack_from(code, data, i * size))) for i in range(count)]


class Info(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.input = self.folder / "in.off"
        self.input.write_text(off_text(sphere()))

    def run_info(self, *arguments, status=DONE):
        before = {p.name for p in self.folder.iterdir()}
        result = subprocess.run(
            [SURETY, "info", str(self.input), *arguments], cwd=self.folder, capture_output=True,
            text=True, check=False)
        self.assertEqual(result.returncode, status, result.stderr + result.stdout)
        if status != DONE:
            self.assertNotEqual(result.stderr, "")
            self.assertEqual({p.name for p in self.folder.iterdir()}, before)
        return result

    def report(self, *arguments):
        self.run_info(*arguments, "--report", "report.json")
        return json.loads((self.folder / "report.json").read_text())
