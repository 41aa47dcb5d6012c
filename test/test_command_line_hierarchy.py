# SPDX-License-Identifier: GPL-3.0-or-later
#
# surety hierarchy, from outside: files, index, exit statuses, and that nothing is left on disk when
# it fails.
import json
import math
import os
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

SURETY = os.environ.get("SURETY", "surety")
DONE, USAGE, BAD_INPUT = 0, 2, 3


def sheet(size=20):
    """OFF text of a wavy sheet whose coordinates are no single-precision numbers."""
    lines = [f"OFF\n{(size + 1) ** 2} {2 * size * size} 0"]
    for i in range(size + 1):
        for j in range(size + 1):
            x, y = i / size, j / size
            lines.append(f"{x!r} {y!r} {0.1 * math.sin(6 * x) * math.cos(5 * y)!r}")
    for i in range(size):
        for j in range(size):
            a = i * (size + 1) + j
            b, c, d = a + size + 1, a + size + 2, a + 1
            lines += [f"3 {a} {b} {c}", f"3 {a} {c} {d}"]
    return "\n".join(lines) + "\n"


def read_glb(path):
    """Points and faces."""
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON"
    scene = json.loads(data[20 : 20 + size])
    size_of_buffer, kind = struct.unpack_from("<I4s", data, 20 + size)
    assert kind == b"BIN\0" and size_of_buffer == scene["buffers"][0]["byteLength"]
    buffer = data[28 + size :]
    arrays = []
    for accessor, width, code in zip(scene["accessors"], (3, 1), "fI"):
        view = scene["bufferViews"][accessor["bufferView"]]
        count = width * accessor["count"]
        assert view["byteLength"] == 4 * count
        arrays.append(struct.unpack_from(f"<{count}{code}", buffer, view["byteOffset"]))
    xyz, corners = arrays
    return ([xyz[i : i + 3] for i in range(0, len(xyz), 3)],
            [corners[i : i + 3] for i in range(0, len(corners), 3)])


class Hierarchy(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.input = self.folder / "in.off"
        self.input.write_text(sheet())
        self.output = self.folder / "levels"

    def run_hierarchy(self, *arguments, status=DONE, tolerances="0.1%,0.5%,2%"):
        result = subprocess.run(
            [SURETY, "hierarchy", str(self.input), "-o", str(self.output), "-t", tolerances,
             *arguments], capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, status, result.stderr)
        if status != DONE:
            self.assertNotEqual(result.stderr, "")
            self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                             sorted({"in.off", *self.allowed}))
        return result

    allowed = ()

    def index(self):
        return json.loads((self.output / "index.json").read_text())

    def test_levels_are_proven_and_coarser_and_coarser(self):
        self.run_hierarchy("--format", "off", "--certificates")
        levels = self.index()["levels"]
        self.assertEqual(len(levels), 3)
        for level in levels:
            self.assertTrue(level["certified"])
            self.assertLessEqual(level["bound"], level["tolerance"])
            for command in (["verify", self.input, self.output / level["file"],
                             self.output / level["certificate"]],
                            ["compare", self.input, self.output / level["file"], "-t",
                             repr(level["tolerance"])]):
                subprocess.run([SURETY, *map(str, command)], check=True, capture_output=True)
        faces = [level["faces"] for level in levels]
        self.assertEqual(faces, sorted(faces, reverse=True))
        self.assertLess(faces[-1], faces[0] / 2)
        bounds = [level["bound"] for level in levels]
        self.assertEqual(bounds, sorted(bounds))

    def test_glb_holds_the_rounded_mesh_within_the_bound(self):
        self.run_hierarchy()
        for level in self.index()["levels"]:
            points, faces = read_glb(self.output / level["file"])
            self.assertEqual((len(points), len(faces)), (level["vertices"], level["faces"]))
            rounded = self.folder / "rounded.off"
            rounded.write_text(
                f"OFF\n{len(points)} {len(faces)} 0\n"
                + "".join(" ".join(map(repr, p)) + "\n" for p in points)
                + "".join("3 " + " ".join(map(str, f)) + "\n" for f in faces))
            subprocess.run([SURETY, "compare", str(self.input), str(rounded), "-t",
                            repr(level["bound"] * 1.0001)], check=True, capture_output=True)

    def test_switching_distance_is_the_documented_formula(self):
        self.run_hierarchy("--viewport-height", "720", "--field-of-view", "90", "--pixel-error", "2")
        for level in self.index()["levels"]:
            self.assertAlmostEqual(level["switching_distance"] / (level["bound"] * 720 / 4), 1)

    def test_formats(self):
        for form in ("off", "obj", "ply", "stl", "glb"):
            self.output = self.folder / form
            self.run_hierarchy("--format", form)
            self.assertEqual(sorted(p.name for p in self.output.iterdir()),
                             ["index.json", *(f"level_{i}.{form}" for i in range(3)),
                              "operations.txt"])
            self.assertTrue((self.output / "operations.txt").read_text()
                            .startswith("surety-hierarchy 1\n"))

    def test_report_and_quiet(self):
        report = self.folder / "report.json"
        result = self.run_hierarchy("--report", str(report), "--quiet")
        self.assertEqual(result.stdout + result.stderr, "")
        self.assertEqual(json.loads(report.read_text())["levels"], self.index()["levels"])

    def test_an_empty_folder_is_taken_and_a_full_one_refused(self):
        self.output.mkdir()
        self.run_hierarchy()
        self.allowed = ("levels",)
        before = sorted(self.output.iterdir())
        self.run_hierarchy(status=USAGE)
        self.assertEqual(sorted(self.output.iterdir()), before)

    def test_wrong_usage(self):
        for tolerances in ("", "0.5,", "1%,0.5%", "1%,1%", "0", "-1", "nan", "1,2,x", "200%"):
            with self.subTest(tolerances=tolerances):
                self.run_hierarchy(status=USAGE, tolerances=tolerances)
        self.run_hierarchy("--format", "vtp", status=USAGE)
        self.run_hierarchy("--certificates", status=USAGE)
        self.run_hierarchy("--certificates", "--format", "stl", status=USAGE)
        self.run_hierarchy(status=USAGE, tolerances="1e-12,1e-3")  # finer than single precision

    def test_target_faces_leaves_coarser_levels_out(self):
        self.run_hierarchy("--format", "off")
        faces = [level["faces"] for level in self.index()["levels"]]
        target = (faces[0] + faces[1]) // 2
        self.output = self.folder / "fewer"
        self.run_hierarchy("--format", "off", "--target-faces", str(target))
        ended = [level["faces"] for level in self.index()["levels"]]
        self.assertEqual(len(ended), 2)
        self.assertEqual(ended[0], faces[0])
        self.assertIn(ended[1], (target, target - 1))

    def test_normal_tolerance_keeps_more_faces(self):
        self.run_hierarchy("--format", "off")
        faces = [level["faces"] for level in self.index()["levels"]]
        self.output = self.folder / "normals"
        report = self.folder / "report.json"
        self.run_hierarchy("--format", "off", "--normal-tolerance", "5", "--report", str(report))
        self.assertEqual(json.loads(report.read_text())["parameters"]["normal_tolerance"], 5)
        self.assertGreater(self.index()["levels"][-1]["faces"], faces[-1])

    def test_ridge_tolerance_keeps_more_faces(self):
        self.run_hierarchy("--format", "off")
        faces = [level["faces"] for level in self.index()["levels"]]
        self.output = self.folder / "borders"
        self.run_hierarchy("--ridge-tolerance", "0.01%")
        self.assertGreater(self.index()["levels"][-1]["faces"], faces[-1])

    def test_stages_are_steps_to_each_level(self):
        self.run_hierarchy("--format", "off")
        at_once = (self.output / "operations.txt").read_text()
        self.output = self.folder / "steps"
        self.run_hierarchy("--format", "off", "--stages", "3")
        self.assertEqual(len(self.index()["levels"]), 3)
        self.assertNotEqual((self.output / "operations.txt").read_text(), at_once)

    def test_accumulated_bound_has_levels_without_proofs(self):
        self.run_hierarchy("--format", "off", "--bound", "accumulated")
        for level in self.index()["levels"]:
            self.assertTrue(level["certified"])
            subprocess.run([SURETY, "compare", str(self.input), str(self.output / level["file"]),
                            "-t", repr(level["tolerance"])], check=True, capture_output=True)

    def test_controls_that_exclude_each_other(self):
        for other in (("--placement", "free"), ("--normal-tolerance", "10"), ("--ridge-tolerance", "0.1%"),
                      ("--certificates", "--format", "off")):
            with self.subTest(other=other):
                self.run_hierarchy("--bound", "accumulated", *other, status=USAGE)

    def test_bad_input(self):
        self.input.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n")
        self.run_hierarchy(status=BAD_INPUT)

    def test_help_has_an_example(self):
        result = subprocess.run([SURETY, "hierarchy", "--help"], capture_output=True, text=True,
                                check=True)
        self.assertIn("Example: surety hierarchy", result.stdout)


if __name__ == "__main__":
    unittest.main()
