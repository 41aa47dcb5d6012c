# SPDX-License-Identifier: GPL-3.0-or-later
#
# Colours, normals and texture coordinates, from outside: what is a function of the place before is
# the same function afterwards, sides of a ridge keep their own normals, and bad attributes are
# refused by the commands that carry them, with a message that names the element.
import json
import math
import struct
import unittest

from command_runs import Runs
from info_runs import (BAD_INPUT, cylinder, off_text, read_ply_vertices, read_vtp, sphere)

COLOR = ("red", "green", "blue")
NORMAL = ("nx", "ny", "nz")


def color_at(point):
    """Linear in the place, within [20, 235] on the unit sphere and the cylinder."""
    x, y, z = point
    return (127 + 60 * x, 127 + 50 * y - 20 * x, 120 + 35 * z)


def texture_at(point):
    return (.3 * point[0] + .1 * point[2], .2 * point[1])


def ply_text(mesh, *columns):
    """Columns are a name, a type and a number a vertex."""
    points, faces = mesh
    lines = ["ply", "format ascii 1.0", f"element vertex {len(points)}",
             *(f"property double {axis}" for axis in "xyz"),
             *(f"property {kind} {name}" for name, kind, _ in columns),
             f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    for i, p in enumerate(points):
        lines.append(" ".join(map(repr, [*map(float, p), *(values[i] for _, _, values in columns)])))
    lines += [" ".join(map(str, (len(face), *face))) for face in faces]
    return "\n".join(lines) + "\n"


def binary_ply(mesh, infinite):
    """With normals, one of which is no number."""
    points, faces = mesh
    names = (*"xyz", *NORMAL)
    text = "".join(["ply\nformat binary_little_endian 1.0\n", f"element vertex {len(points)}\n",
                    *(f"property double {name}\n" for name in names),
                    f"element face {len(faces)}\nproperty list uchar int vertex_indices\n",
                    "end_header\n"])
    data = b"".join(struct.pack("<6d", *p, *((math.inf,) * 3 if i == infinite else p))
                    for i, p in enumerate(points))
    return text.encode() + data + b"".join(struct.pack("<B3i", 3, *face) for face in faces)


def colors(mesh, kind="uchar"):
    whole = [[round(c) for c in color_at(p)] for p in mesh[0]]
    return [(name, kind, [c[i] if kind == "uchar" else c[i] / 255 for c in whole])
            for i, name in enumerate(COLOR)]


def normals(mesh, scale=1.):
    """Of a sphere about the origin."""
    return [(name, "float", [scale * p[i] for p in mesh[0]]) for i, name in enumerate(NORMAL)]


def texture(mesh, names=("s", "t")):
    return [(name, "float", [texture_at(p)[i] for p in mesh[0]]) for i, name in enumerate(names)]


def place(vertex):
    return tuple(vertex[axis] for axis in "xyz")


def length(v):
    return math.sqrt(sum(x * x for x in v))


def read_obj(path):
    """Vertices with what follows them, normals, and faces as lists of (vertex, normal)."""
    lines = [line.split() for line in path.read_text().splitlines()]
    vertices = [tuple(map(float, words[1:])) for words in lines if words[0] == "v"]
    found = [tuple(map(float, words[1:])) for words in lines if words[0] == "vn"]
    faces = [[tuple(int(part or 0) - 1 for part in corner.split("/")) for corner in words[1:]]
             for words in lines if words[0] == "f"]
    return vertices, found, faces


class Attributes(Runs):
    def write(self, text, name="in.ply"):
        (self.folder / name).write_text(text)

    def run_all(self, given, made, *flags):
        """By every command that carries attributes, and by both bounds of simplify."""
        solution = "\n".join(str(i % 7) for i in range(len(sphere()[0])))
        self.write("MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n"
                   f"{len(sphere()[0])}\n1 1\n{solution}\nEnd\n", "u.sol")
        for command in (("simplify",), ("simplify", "--bound", "accumulated"),
                        ("simplify", "--placement", "free"), ("remesh",),
                        ("adapt", "--solution", "u.sol", "--target-vertices", "400")):
            with self.subTest(command=command):
                done = self.surety(command[0], given, "-o", made, "-t", "1%", "--report", "r.json",
                                   *command[1:], *flags)
                yield done, json.loads((self.folder / "r.json").read_text())

    def test_linear_colors_come_back(self):
        ball = sphere()
        for kind in ("uchar", "float"):
            self.write(ply_text(ball, *colors(ball, kind)))
            for done, report in self.run_all("in.ply", "out.ply"):
                self.assertIn("carried over: colors", done.stdout)
                self.assertEqual(report["output"]["attributes"], ["colors"])
                # Half a unit of rounding before and after, and the way to the input's surface.
                allowed = 1 + 64 * report["certificate"]["tolerance"]
                vertices = read_ply_vertices(self.folder / "out.ply")
                self.assertEqual(len(vertices), report["output"]["vertices"])
                self.assertEqual(len({tuple(v[c] for c in COLOR) for v in vertices}) > 20, True)
                for vertex in vertices:
                    for name, wanted in zip(COLOR, color_at(place(vertex))):
                        self.assertAlmostEqual(vertex[name], wanted, delta=allowed)

    def test_vertices_that_stay_keep_what_they_have(self):
        ball = sphere()
        self.write(ply_text(ball, *colors(ball)))
        self.surety("simplify", "in.ply", "-o", "out.ply", "-t", "1%")
        self.require_colors_where_vertices_stayed(ball[0])

    def require_colors_where_vertices_stayed(self, points):
        given = {tuple(map(float, p)): tuple(round(c) for c in color_at(p)) for p in points}
        vertices = read_ply_vertices(self.folder / "out.ply")
        stayed = [vertex for vertex in vertices if place(vertex) in given]
        self.assertGreaterEqual(len(stayed), 5)
        for vertex in stayed:
            self.assertEqual(tuple(vertex[c] for c in COLOR), given[place(vertex)])

    def test_normals_stay_of_unit_length(self):
        ball = sphere()
        self.write(ply_text(ball, *normals(ball, 3.)))
        for done, report in self.run_all("in.ply", "out.vtp"):
            self.assertIn("carried over: normals", done.stdout)
            points = read_vtp(self.folder / "out.vtp", "Points")["Points"]
            made = read_vtp(self.folder / "out.vtp")["normal"]
            for point, normal in zip(points, made):
                self.assertAlmostEqual(length(normal), 1, delta=1e-12)
                cosine = sum(a * b for a, b in zip(point, normal)) / length(point)
                self.assertGreater(cosine, math.cos(math.radians(3)))

    def test_texture_coordinates_and_alpha_come_back(self):
        ball = sphere()
        alpha = ("alpha", "uchar", [7] * len(ball[0]))
        for names in (("s", "t"), ("u", "v"), ("texture_u", "texture_v")):
            self.write(ply_text(ball, *colors(ball), alpha, *texture(ball, names)))
            self.surety("remesh", "in.ply", "-o", "out.ply", "-t", "1%")
            for vertex in read_ply_vertices(self.folder / "out.ply"):
                wanted = texture_at(place(vertex))
                self.assertAlmostEqual(vertex["s"], wanted[0], delta=.01)
                self.assertAlmostEqual(vertex["t"], wanted[1], delta=.01)
                self.assertEqual(vertex["alpha"], 7)

    def write_cylinder_with_two_normals_at_its_rims(self):
        points, faces = cylinder()
        lines = ["v " + " ".join(map(repr, map(float, p))) + " .4 .2 1" for p in points]
        lines += ["vn 0 0 -1", "vn 0 0 1"]
        lines += [f"vn {p[0]!r} {p[1]!r} 0" for p in points]
        for face in faces:
            heights = {points[v][2] for v in face}
            flat = None if len(heights) > 1 else (1 if heights == {0} else 2)
            lines.append("f " + " ".join(f"{v + 1}//{flat or v + 3}" for v in face))
        self.write("\n".join(lines) + "\n", "in.obj")

    def test_each_side_of_a_ridge_keeps_its_normals(self):
        self.write_cylinder_with_two_normals_at_its_rims()
        for command in ("simplify", "remesh"):
            with self.subTest(command=command):
                self.surety(command, "in.obj", "-o", "out.obj", "-t", ".5%", "--feature-angle", "40")
                vertices, found, faces = read_obj(self.folder / "out.obj")
                self.assertEqual({tuple(round(x, 12) for x in v[3:]) for v in vertices}, {(.4, .2, 1.)})
                several, sides = {}, {}
                for face in faces:
                    heights = {round(vertices[v][2], 9) for v, _, _ in face}
                    for v, _, n in face:
                        normal = found[n]
                        if heights in ({0.}, {3.}):
                            self.assertEqual(normal, (0, 0, -1 if heights == {0.} else 1))
                        else:
                            self.assertAlmostEqual(normal[2], 0, delta=1e-12)
                            x, y = vertices[v][:2]
                            self.assertGreater(x * normal[0] + y * normal[1], .98)
                        several.setdefault(v, set()).add(n)
                        sides.setdefault(v, set()).add(len(heights) == 1)
                self.assertGreater(sum(len(s) == 2 for s in sides.values()), 20)
                self.assertEqual({v: len(s) for v, s in sides.items()},
                                 {v: len(s) for v, s in several.items()})

    def test_one_normal_a_vertex_is_the_mean_of_the_sides(self):
        self.write_cylinder_with_two_normals_at_its_rims()
        self.surety("simplify", "in.obj", "-o", "out.ply", "-t", ".5%", "--feature-angle", "40")
        rim = [v for v in read_ply_vertices(self.folder / "out.ply")
               if v["z"] == 3 and math.hypot(v["x"], v["y"]) > .5]
        self.assertGreater(len(rim), 10)
        for vertex in rim:
            self.assertAlmostEqual(vertex["nz"], math.sqrt(.5), delta=1e-9)

    def test_polygons_and_repaired_files_keep_theirs(self):
        ball = sphere()
        points, faces = [*ball[0], (5., 5., 5.)], [*ball[1], ball[1][3][::-1]]
        self.write(ply_text((points, faces), *colors((points, faces))))
        self.surety("simplify", "in.ply", "-o", "out.ply", "-t", "1%", "--repair")
        self.require_colors_where_vertices_stayed(points)
        box = ([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)],
               [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
        self.write(ply_text(box, *colors(box)))
        self.surety("simplify", "in.ply", "-o", "out.ply", "-t", "1%", "--triangulate")
        made = {place(v): tuple(v[c] for c in COLOR)
                for v in read_ply_vertices(self.folder / "out.ply")}
        self.assertEqual(made, {p: tuple(round(c) for c in color_at(p)) for p in box[0]})

    def test_results_can_be_read_back(self):
        ball = sphere()
        self.write(ply_text(ball, *colors(ball), *normals(ball), *texture(ball)))
        for first in ("one.ply", "one.obj"):
            self.surety("simplify", "in.ply", "-o", first, "-t", "1%", "--certificate", "c.cert")
            self.surety("verify", "in.ply", first, "c.cert")
            done = self.surety("simplify", first, "-o", "two.ply", "-t", "2%")
            for name in ("colors", "normals", "texture coordinates"):
                self.assertIn(f"  carried over: {name}\n", done.stdout)

    def test_what_is_not_carried_is_told(self):
        ball = sphere()
        self.write(ply_text(ball, *colors(ball)))
        done = self.surety("simplify", "in.ply", "-o", "out.off", "-t", "1%")
        self.assertIn("not carried over: colors", done.stdout)
        # Texture coordinates that are others in each face.
        points, faces = ball
        lines = ["v " + " ".join(map(repr, map(float, p))) for p in points]
        lines += ["vt 0 0", "vt 1 0", "vt 0 1"]
        lines += ["f " + " ".join(f"{v + 1}/{i + 1}" for i, v in enumerate(face)) for face in faces]
        self.write("\n".join(lines) + "\n", "in.obj")
        done = self.surety("simplify", "in.obj", "-o", "out.obj", "-t", "1%")
        self.assertIn("not carried over: texture coordinates", done.stdout)
        self.assertNotIn("vt", (self.folder / "out.obj").read_text())

    def test_without_attributes_nothing_changes(self):
        self.write(off_text(sphere()), "in.off")
        for name in ("out.ply", "out.obj", "out.vtp"):
            done = self.surety("simplify", "in.off", "-o", name, "-t", "1%", "--report", "r.json")
            self.assertNotIn("carried", done.stdout)
            self.assertNotIn("attributes",
                             json.loads((self.folder / "r.json").read_text())["output"])
        header = (self.folder / "out.ply").read_bytes().split(b"end_header")[0]
        self.assertNotIn(b"nx", header)
        self.assertEqual(header.count(b" red"), 1)

    def test_bad_attributes_are_refused(self):
        ball = sphere(1)
        number = len(ball[0])
        bright = [(name, "float", [2.] * number) for name in COLOR]
        cases = {"'blue'": ply_text(ball, *colors(ball)[:2]),
                 "'green'": ply_text(ball, colors(ball)[0], colors(ball, "float")[1],
                                     colors(ball)[2]),
                 "type int": ply_text(ball, *((n, "int", v) for n, _, v in colors(ball))),
                 "colour of vertex 0": ply_text(ball, *bright)}
        for words, text in cases.items():
            with self.subTest(words=words):
                self.write(text)
                self.refused("in.ply", words)
        self.surety("info", "in.ply")  # which has no use for them
        (self.folder / "in.ply").write_bytes(binary_ply(ball, 4))
        self.refused("in.ply", "normal of vertex 4 is not finite")

    def test_bad_attributes_of_obj_files_are_refused(self):
        points, faces = sphere(1)
        lines = ["v " + " ".join(map(repr, map(float, p))) for p in points] + ["vn 0 0 1"]
        good = [" ".join(f"{v + 1}//1" for v in face) for face in faces]
        first = lines[0]
        cases = {"face 5 refers to a normal that does not exist":
                 (first, [*good[:5], good[5].replace("//1", "//2"), *good[6:]]),
                 "face 2 has a corner without a normal":
                 (first, [*good[:2], good[2].replace("//1", ""), *good[3:]]),
                 "vertex 1 has no such colour": (first + " 1 0 0", good)}
        for words, (start, corners) in cases.items():
            with self.subTest(words=words):
                self.write("\n".join([start, *lines[1:], *("f " + c for c in corners)]) + "\n",
                           "in.obj")
                self.refused("in.obj", words)

    def refused(self, name, words):
        for command in ("simplify", "remesh"):
            done = self.surety(command, name, "-o", "new.ply", "-t", "1%", status=BAD_INPUT)
            self.assertIn(words, done.stderr)
            self.assertFalse((self.folder / "new.ply").exists())


if __name__ == "__main__":
    unittest.main()
