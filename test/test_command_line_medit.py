# SPDX-License-Identifier: GPL-3.0-or-later
#
# Medit's files through the command line: what a mesh generator says of vertices, edges and
# triangles is kept and comes back, and files that are wrong are refused by line.
import json
import unittest

from command_runs import Runs
from info_runs import BAD_INPUT, sphere
from medit_files import bytes_of, from_bytes, from_text, text_of


def cube(size=8):
    """The unit cube: a reference a side, references from 21 on its edges, which are ridges except
    for the first four, corners, and in the middle of a side a required triangle, a required edge
    and a required vertex."""
    names, points, triangles = {}, [], []

    def vertex(p):
        if p not in names:
            names[p] = len(points) + 1
            points.append(tuple(x / size for x in p))
        return names[p]

    for side in range(6):
        axis, height = side // 2, size * (side % 2)
        for i in range(size):
            for j in range(size):
                def place(a, b):
                    p = [a, b]
                    p.insert(axis, height)
                    return vertex(tuple(p))
                quad = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)]
                if (side % 2 == 1) != (axis != 1):
                    quad.reverse()
                triangles += [(*quad[:3], side + 1), (quad[0], *quad[2:], side + 1)]
    vertices = [(*p, 100 if p.count(0.5) == 2 else 7) for p in points]

    def line(p, q):
        """The edge of the cube on which a triangle's side lies, or none."""
        fixed = [k for k in range(3) if p[k] == q[k] and p[k] in (0, 1)]
        if len(fixed) < 2:
            return None
        free = ({0, 1, 2} - set(fixed[:2])).pop()
        return 4 * free + sum(2 ** i * int(p[k]) for i, k in enumerate(sorted(set(fixed[:2]))))

    edges, ridges = [], []
    for a, b, c, _ in triangles:
        for v, w in ((a, b), (b, c), (c, a)):
            on = line(points[v - 1], points[w - 1])
            if v < w and on is not None:
                edges.append((v, w, 21 + on))
                if on >= 4:
                    ridges.append((len(edges),))
    middle = names[(size // 2, size // 2, 0)]
    beside = names[(size // 2 + 1, size // 2, 0)]
    edges.append((middle, beside, 99))
    inner = max(range(len(triangles)), key=lambda i: sum(
        triangles[i][3] == 6 and x not in (0, 1)
        for v in triangles[i][:3] for x in points[v - 1][:2]))
    return {"Vertices": vertices, "Triangles": triangles, "Edges": edges, "Ridges": ridges,
            "Corners": [(v + 1,) for v, p in enumerate(points) if set(p) <= {0, 1}],
            "RequiredVertices": [(names[(0, 3, 3)],)],
            "RequiredEdges": [(len(edges),)], "RequiredTriangles": [(inner + 1,)]}


def ball(rounds=3):
    points, faces = sphere(rounds)
    return {"Vertices": [(*map(float, p), i % 5) for i, p in enumerate(points)],
            "Triangles": [(a + 1, b + 1, c + 1, 1 if points[a][2] + points[b][2] + points[c][2] > 0
                           else -2) for a, b, c in faces]}


def point(mesh, v):
    return mesh["Vertices"][v - 1][:3]


def places(mesh, keyword, within=None):
    """The places of listed elements, each the set of its points."""
    result = []
    for (index,) in mesh.get(keyword, []):
        entry = (index,) if within is None else mesh[within][index - 1][:-1]
        result.append(frozenset(point(mesh, v) for v in entry))
    return set(result)


class Medit(Runs):
    def refused(self, content, pattern, name="bad.mesh"):
        data = content if isinstance(content, bytes) else content.encode()
        (self.folder / name).write_bytes(data)
        done = self.surety("info", name, status=BAD_INPUT)
        self.assertRegex(done.stderr, pattern)

    def check_cube(self, old, new):
        """Everything that the cube's file says is there again."""
        for v, w, x, reference in new["Triangles"]:
            axis, height = (reference - 1) // 2, (reference - 1) % 2
            for corner in (v, w, x):
                self.assertAlmostEqual(point(new, corner)[axis], height, delta=.011)
        self.assertEqual({t[3] for t in new["Triangles"]}, set(range(1, 7)))
        ridges = {i for (i,) in new["Ridges"]}
        for i, (v, w, reference) in enumerate(new["Edges"], 1):
            if reference == 99:
                continue
            on = reference - 21
            self.assertEqual(i in ridges, on >= 4)
            free = on // 4
            fixed = [k for k in range(3) if k != free]
            for corner in (v, w):
                for bit, k in enumerate(fixed):
                    self.assertAlmostEqual(point(new, corner)[k], on >> bit & 1, delta=.011)
        # The sides of the required triangle are kept, but the file did not list them.
        lengths = {}
        for v, w, reference in new["Edges"]:
            length = sum((a - b) ** 2 for a, b in zip(point(new, v), point(new, w))) ** .5
            lengths[reference] = lengths.get(reference, 0) + length
        self.assertEqual(set(lengths), {*range(21, 33), 99})
        for reference in range(21, 33):
            self.assertAlmostEqual(lengths[reference], 1, delta=.03)
        self.assertEqual(places(new, "Corners"), places(old, "Corners"))
        self.assertEqual(places(new, "RequiredVertices"), places(old, "RequiredVertices"))
        for keyword, within in (("RequiredEdges", "Edges"), ("RequiredTriangles", "Triangles")):
            self.assertEqual(places(new, keyword, within), places(old, keyword, within))

    def test_info_counts_what_is_marked(self):
        mesh = cube()
        (self.folder / "in.mesh").write_text(text_of(mesh))
        plain = {"Vertices": mesh["Vertices"], "Triangles": [(*t[:3], 0) for t in mesh["Triangles"]]}
        (self.folder / "plain.mesh").write_text(text_of(plain))
        counts = []
        for name in ("plain.mesh", "in.mesh"):
            self.surety("info", name, "--feature-angle", "180", "--report", "r.json")
            counts.append(json.loads((self.folder / "r.json").read_text())["features"])
        self.assertEqual((counts[0]["marked_edges"], counts[0]["corners"]), (0, 0))
        self.assertGreaterEqual(counts[1]["marked_edges"], len(mesh["Edges"]))
        self.assertGreaterEqual(counts[1]["corners"], len(mesh["Corners"]))

    def test_simplification_keeps_what_the_file_says(self):
        (self.folder / "in.mesh").write_text(text_of(cube()))
        for placement in ("on-surface", "free"):
            for effort in ("fast", "default"):
                with self.subTest(placement=placement, effort=effort):
                    self.surety("simplify", "in.mesh", "-o", "out.mesh", "-t", "0.01",
                                "--placement", placement, "--effort", effort)
                    new = from_text((self.folder / "out.mesh").read_text())
                    self.assertLess(len(new["Triangles"]), 150)
                    self.check_cube(cube(), new)
                    self.assertIn((.5, .5, 0., 100), new["Vertices"])

    def test_remeshing_keeps_what_the_file_says(self):
        (self.folder / "in.meshb").write_bytes(bytes_of(cube(), 3))
        for size in (".4", ".06"):
            with self.subTest(size=size):
                self.surety("remesh", "in.meshb", "-o", "out.meshb", "-t", "0.01",
                            "--max-size", size, "--min-size", ".02")
                new = from_bytes((self.folder / "out.meshb").read_bytes())
                self.check_cube(cube(), new)
        self.assertGreater(len(new["Triangles"]), 1500)

    def test_ridges_that_are_found_are_written(self):
        mesh = cube()
        for keyword in ("Edges", "Ridges", "Corners", "RequiredVertices", "RequiredEdges",
                        "RequiredTriangles"):
            del mesh[keyword]
        mesh["Triangles"] = [(*t[:3], 0) for t in mesh["Triangles"]]
        (self.folder / "in.mesh").write_text(text_of(mesh))
        for command in (("simplify", "--feature-angle", "40"), ("remesh",)):
            with self.subTest(command=command):
                self.surety(*command, "in.mesh", "-o", "out.mesh", "-t", "0.01")
                new = from_text((self.folder / "out.mesh").read_text())
                self.assertEqual(len(new["Ridges"]), len(new["Edges"]))
                self.assertGreaterEqual(len(new["Ridges"]), 12)
                self.assertEqual(places(new, "Corners"),
                                 {frozenset([(float(x), float(y), float(z))])
                                  for x in (0, 1) for y in (0, 1) for z in (0, 1)})

    def test_nothing_changes_within_a_tolerance_that_admits_nothing(self):
        old = ball()
        old["Edges"] = [(*t[:2], 5) for t in old["Triangles"][:9]]
        old["Ridges"], old["Corners"] = [(1,), (4,)], [(3,)]
        old["RequiredTriangles"] = [(2,), (30,)]
        (self.folder / "in.mesh").write_text(text_of(old))
        self.surety("simplify", "in.mesh", "-o", "out.meshb", "-t", "1e-9")
        self.surety("simplify", "out.meshb", "-o", "out.mesh", "-t", "1e-9")
        for new in (from_bytes((self.folder / "out.meshb").read_bytes()),
                    from_text((self.folder / "out.mesh").read_text())):
            self.assertEqual(new["Vertices"], old["Vertices"])
            def turned(entry):
                corners = entry[:3]
                first = corners.index(min(corners))
                return (*corners[first:], *corners[:first], entry[3])
            self.assertEqual([turned(t) for t in new["Triangles"]],
                             [turned(t) for t in old["Triangles"]])
            edges = {frozenset(e[:2]): e[2] for e in new["Edges"]}
            self.assertEqual(edges, {frozenset(e[:2]): e[2] for e in old["Edges"]})
            self.assertEqual(new["RequiredTriangles"], old["RequiredTriangles"])
            self.assertEqual(places(new, "Ridges", "Edges"), places(old, "Ridges", "Edges"))
            self.assertIn((3,), new["Corners"])

    def test_all_versions_and_byte_orders_are_read(self):
        (self.folder / "a.mesh").write_text(text_of(ball()))
        for version in (1, 2, 3, 4):
            for order in "<>":
                with self.subTest(version=version, order=order):
                    (self.folder / "b.meshb").write_bytes(bytes_of(ball(), version, order))
                    self.surety("compare", "a.mesh", "b.meshb", "-t",
                                "1e-6" if version == 1 else "1e-12")

    def test_a_certificate_holds_for_medit_files(self):
        (self.folder / "in.mesh").write_text(text_of(ball()))
        for name in ("out.mesh", "out.meshb"):
            with self.subTest(name=name):
                self.surety("simplify", "in.mesh", "-o", name, "-t", "2%",
                            "--certificate", "c.cert")
                self.surety("verify", "in.mesh", name, "c.cert")

    def test_lists_that_are_of_no_use_are_skipped(self):
        text = text_of(ball()).replace(
            "Triangles", "Normals\n2\n0 0 1.5e0\n0 1 0\nNormalAtVertices\n1\n1 1\n"
            "Triangles # of the surface", 1)
        (self.folder / "in.mesh").write_text(text)
        self.surety("info", "in.mesh")

    def test_a_text_that_is_wrong_is_refused_by_line(self):
        head = "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
        for text, pattern in (
                (head + "Triangles 1\n1 2 4 0\nEnd\n", r"line 8: vertex 4 does not exist.* 1 to 3"),
                (head + "Triangles 1\n0 1 2 0\nEnd\n", "line 8: vertex 0 does not exist"),
                (head + "Triangles 1\n1 2 x 0\nEnd\n", 'line 8: "x" is not a whole number'),
                (head + "Triangles 1\n1 2 3 0.5\nEnd\n", 'line 8: "0.5" is not a reference'),
                (head + "Triangles 1\n1 2 3 0\n", "line 9: the file ends without the word End"),
                (head + "Triangles 2\n1 2 3 0\nEnd\n", 'line 9: "End" is not a whole number'),
                (head + "Triangles 1\n1 2 3 0\nRidges 1\n1\nEnd\n",
                 "line 10: edge 1 does not exist"),
                (head + "Triangles 1\n1 2 3 0\nTriangles 1\n1 2 3 0\nEnd\n",
                 "line 9: .*more than one"),
                (head + "Triangles 1\n1 2 3 0\n17\nEnd\n", 'line 9: "17" is where a keyword'),
                (head.replace("1 0 0 0", "1 nan 0 0") + "End\n", 'line 5: "nan" is not finite'),
                (head.replace("Vertices 3", "Vertices 3000000000") + "End\n", "line 7"),
                (head.replace("Dimension 3", "Dimension 2"), "line 2: the dimension is 2, not 3"),
                (head + "Quadrilaterals 1\n1 2 3 3 0\nEnd\n",
                 "1 Quadrilaterals.*into two triangles"),
                (head + "Tetrahedra 1\n1 2 3 3 0\nEnd\n", "1 Tetrahedra.*of the surface only"),
                (head + "End\n", "no faces")):
            with self.subTest(pattern=pattern):
                self.refused(text, pattern)
        mesh = ball()
        mesh["Edges"] = [(1, 2, 0)]
        self.refused(text_of(mesh), "edge 1, from vertex 1 to vertex 2, is the side of no triangle")

    def test_a_binary_file_that_is_wrong_is_refused(self):
        mesh = cube(4)
        whole = bytes_of(mesh)
        for length in range(1, len(whole) - 8, 97):
            self.refused(whole[:length], "bad.meshb", "bad.meshb")
        mesh["Triangles"][4] = (1, 2, 1000, 0)
        self.refused(bytes_of(mesh), "Triangles, entry 5: vertex 1000", "bad.meshb")
        mesh = cube(4)
        mesh["Vertices"][2] = (0., float("inf"), 0., 0)
        self.refused(bytes_of(mesh), "Vertices, entry 3: .*not finite", "bad.meshb")
        mesh = cube(4)
        mesh["Quadrilaterals"] = [(1, 2, 3, 4, 0)]
        self.refused(bytes_of(mesh), "1 Quadrilaterals", "bad.meshb")
        self.refused(whole[:4] + b"\7" + whole[5:], "version is 7", "bad.meshb")
        self.refused(b"\2" + whole[1:], "does not begin with the number 1", "bad.meshb")


if __name__ == "__main__":
    unittest.main()
