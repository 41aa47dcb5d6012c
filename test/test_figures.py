# SPDX-License-Identifier: GPL-3.0-or-later
#
# The figures of the manual are made by one program, and what they measure themselves is right.
import re
import struct
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).parent.parent
FIGURES = ROOT / "doc/figures"
SHARED = {"make_all", "measure", "palette", "runs", "scene"}
sys.path.insert(0, str(FIGURES))
sys.dont_write_bytecode = True
try:
    import numpy
    import measure
except ImportError:
    numpy = None
try:
    import vtk
    import palette
except ImportError:
    vtk = None


def pages():
    return "".join(page.read_text() for page in sorted((ROOT / "doc/manual").glob("*.md")))


def tables():
    """The tables of the manual between their markers, as lists of cells, by name."""
    found = re.findall(r"<!-- table: (\w+) -->\n(.*?)<!-- end of the table -->",
                       pages(), re.DOTALL)
    return {name: [[cell.strip() for cell in line.strip("|").split("|")]
                   for line in text.splitlines()] for name, text in found}


class The_figures(unittest.TestCase):
    def test_are_all_made_by_one_program(self):
        maker = (FIGURES / "make_all.py").read_text()
        for program in FIGURES.glob("*.py"):
            if program.stem not in SHARED:
                with self.subTest(program=program.name):
                    self.assertIn(f'"{program.stem}"', maker)

    def test_are_small_and_shown(self):
        shown = pages() + (ROOT / "README.md").read_text()
        for picture in FIGURES.glob("*.png"):
            with self.subTest(picture=picture.name):
                self.assertIn(f"figures/{picture.name})", shown)
                self.assertLess(picture.stat().st_size, 400_000)

    def test_come_with_tables_that_are_filled(self):
        self.assertGreater(len(tables()), 5)
        sources = "".join(program.read_text() for program in FIGURES.glob("*.py"))
        for name, lines in tables().items():
            with self.subTest(table=name):
                self.assertIn(f"{name}.md", sources)
                self.assertGreater(len(lines), 2)
                self.assertEqual(len({len(line) for line in lines}), 1)

    def test_of_adaptation_have_the_error_of_a_fine_even_mesh_with_a_fifth_of_its_vertices(self):
        # As the page says.
        for name in ("adaptation", "solved_front"):
            with self.subTest(table=name):
                head, _, *rows = tables()[name]
                size = head.index("np") if "np" in head else head.index("vertices")
                rows = [(row[0].startswith("adapted"), float(row[size].replace(",", "")),
                         float(row[head.index("L2 error")])) for row in rows]
                vertices, error = max(row[1:] for row in rows if not row[0])
                self.assertTrue(any(row[0] and row[2] <= error and 5 * row[1] <= vertices
                                    for row in rows))


@unittest.skipIf(numpy is None, "NumPy is not there")
class A_measurement(unittest.TestCase):
    def test_of_shape_is_one_for_the_equilateral_triangle_only(self):
        points = numpy.array([[0, 0, 0], [2, 0, 0], [1, 3**0.5, 0], [0, 2, 0]])
        equilateral, right = measure.qualities(numpy.array([[0, 1, 2], [0, 1, 3]]), points)
        self.assertAlmostEqual(equilateral, 1, 14)
        # Its longest edge is 2 sqrt(2), the radius of its inscribed circle 2 - sqrt(2).
        self.assertAlmostEqual(right, 3**0.5 / 6 * 2 * 2**0.5 / (2 - 2**0.5), 14)

    def test_finds_corners_below_thirty_degrees_however_they_are_divided(self):
        for degrees, is_sharp in ((29, True), (31, False)):
            for pieces in (1, 2, 5):
                with self.subTest(degrees=degrees, pieces=pieces):
                    angles = numpy.radians(numpy.linspace(0, degrees, pieces + 1))
                    points = [[0, 0, 0], *([numpy.cos(t), numpy.sin(t), 0] for t in angles)]
                    # Far away from the corner the piece goes on, so that only the corner is sharp.
                    rim = [[3 * x, 3 * y, 0] for x, y, _ in points[1:]]
                    faces = [[0, i + 1, i + 2] for i in range(pieces)]
                    n = pieces + 1
                    for i in range(pieces):
                        faces += [[i + 1, n + i + 1, i + 2], [n + i + 1, n + i + 2, i + 2]]
                    found = measure.sharp_faces(numpy.array(faces), numpy.array(points + rim))
                    self.assertEqual(list(found[:pieces]), [is_sharp] * pieces)
                    self.assertFalse(found[pieces:].any())


    def test_of_interpolation_agrees_with_the_integral_of_a_parabola(self):
        # On right triangles with legs h along the axes, x^2 is interpolated with the error
        # x^2 - h x from the left end of each, whose mean square is h^4/30.
        n = 5
        points = numpy.array([[i / n, j / n, 0] for i in range(n + 1) for j in range(n + 1)])
        at = [(n + 1) * i + j for i in range(n) for j in range(n)]
        corners = numpy.array([face for v in at for face in (
            (v, v + n + 1, v + n + 2), (v, v + n + 2, v + 1))])
        measured = [measure.interpolation_error(corners, points, lambda x: x[..., 0] ** 2, rows)
                    for rows in (8, 32)]
        exact = n**-2 / 30**0.5
        self.assertAlmostEqual(measured[0] / exact, 1, delta=0.02)
        self.assertAlmostEqual(measured[1] / exact, 1, delta=0.002)


@unittest.skipIf(vtk is None or numpy is None, "VTK is not there")
class A_picture(unittest.TestCase):
    def test_with_a_palette_has_nearly_the_same_colours(self):
        source = vtk.vtkImageData()
        source.SetDimensions(64, 48, 1)
        source.AllocateScalars(vtk.VTK_UNSIGNED_CHAR, 3)
        given = palette.vtk_to_numpy(source.GetPointData().GetScalars())
        x, y = numpy.meshgrid(numpy.arange(64), numpy.arange(48))
        given[:] = numpy.stack([4 * x, 5 * y, 0 * x + 40], axis=2).reshape(-1, 3)
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/picture.png"
            palette.write_png(source, path)
            header = Path(path).read_bytes()[16:26]
            self.assertEqual(struct.unpack(">IIBB", header), (64, 48, 8, 3))
            reader = vtk.vtkPNGReader()
            reader.SetFileName(path)
            reader.Update()
            got = palette.vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        difference = numpy.abs(given.astype(int) - got[:, :3]).max()
        self.assertLess(difference, 24)  # 256 squares of this plane of colours are 16 wide
        self.assertGreater(len(numpy.unique(got, axis=0)), 128)


if __name__ == "__main__":
    unittest.main()
