# SPDX-License-Identifier: GPL-3.0-or-later
#
# surety adapt, from outside: small faces where the solution bends, a certified mesh, every flag
# changes what it says, and nothing is left on disk when the command fails.
import json
import math
import unittest

from command_runs import Runs
from info_runs import BAD_INPUT, USAGE, off_text, sphere


def solution_text(values):
    lines = "\n".join(repr(v) for v in values)
    return f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{len(values)}\n1 1\n{lines}\nEnd\n"


def points_of(path):
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    number = int(lines[1].split()[0])
    return [tuple(float(x) for x in line.split()) for line in lines[2:2 + number]]


def front(p, place=.2, width=.15):
    return math.tanh((p[2] - place) / width)


class Adapt(Runs):
    def setUp(self):
        super().setUp()
        (self.folder / "in.off").write_text(off_text(sphere()))
        (self.folder / "u.sol").write_text(solution_text([front(p) for p in sphere()[0]]))

    def report(self, *arguments, target=("--target-vertices", "300"), out="out.off"):
        self.surety("adapt", "in.off", "-o", out, "-t", "1%", "--solution", "u.sol", "--report",
                    "r.json", *target, *arguments)
        return json.loads((self.folder / "r.json").read_text())

    def test_follows_the_solution_within_the_tolerance(self):
        report = self.report()
        self.assertTrue(report["certificate"]["holds"])
        self.assertTrue(report["certificate"]["distance_check"]["holds"])
        self.assertGreaterEqual(report["output"]["unit_edges"], 95)
        self.assertAlmostEqual(report["field"]["vertices_asked_for"], 300, delta=.4)
        self.assertGreaterEqual(report["field"]["vertices_after_gradation"], 299)
        points = points_of(self.folder / "out.off")
        # A zone of the sphere has an area in proportion to its height.
        near = sum(1 for p in points if abs(p[2] - .2) < .2) / .4
        far = sum(1 for p in points if p[2] < -.4) / .6
        self.assertGreater(near, 1.5 * far)
        self.surety("compare", "in.off", "out.off", "-t", "1%")

    def test_flags_do_what_they_say(self):
        usual = self.report()["output"]["vertices"]
        self.assertGreater(self.report(target=("--target-vertices", "1500"))["output"]["vertices"],
                           1.5 * usual)
        fine = self.report(target=("--target-error", "0.003"))["output"]["vertices"]
        coarse = self.report(target=("--target-error", "0.03"))["output"]["vertices"]
        self.assertGreater(fine, coarse)
        self.assertGreater(self.report("--max-size", "4%")["output"]["vertices"], usual)
        self.assertNotEqual(self.report("--norm", "inf")["output"]["vertices"], usual)
        changed = self.report("--metric", "isotropic", "--gradation", "1.6", "--norm", "1",
                              "--max-aspect", "3", "--iterations", "2", "--feature-angle", "180",
                              "--corner-angle", "50")
        expected = {"metric": "isotropic", "gradation": 1.6, "norm": 1, "maximum_aspect_ratio": 3,
                    "iterations": 2, "feature_angle": 180, "corner_angle": 50,
                    "target_vertices": 300}
        for name, value in expected.items():
            self.assertEqual(changed["parameters"][name], value)

    def test_the_solution_may_belong_to_another_mesh(self):
        self.report(out="first.off")
        moved = [front(p, -.4) for p in points_of(self.folder / "first.off")]
        (self.folder / "u.sol").write_text(solution_text(moved))
        report = self.report("--background", "first.off", out="second.off")
        self.assertTrue(report["certificate"]["holds"])
        self.surety("compare", "in.off", "second.off", "-t", "1%")
        points = points_of(self.folder / "second.off")
        near = sum(1 for p in points if abs(p[2] + .4) < .2) / .4
        far = sum(1 for p in points if p[2] > .4) / .6
        self.assertGreater(near, 1.5 * far)

    def test_quiet_prints_nothing(self):
        done = self.surety("adapt", "in.off", "-o", "out.off", "-t", "2%", "--solution", "u.sol",
                           "--target-vertices", "200", "--quiet", "--no-verify")
        self.assertEqual(done.stdout + done.stderr, "")

    def test_wrong_usage(self):
        both = ("--target-vertices", "100", "--target-error", "1")
        for arguments in ((), both, ("--target-vertices", "-1"), ("--target-error", "0"),
                          ("--target-vertices", "100", "--norm", ".5"),
                          ("--target-vertices", "100", "--metric", "round")):
            with self.subTest(arguments=arguments):
                self.surety("adapt", "in.off", "-o", "new.off", "-t", "1%", "--solution", "u.sol",
                            *arguments, status=USAGE)
                self.assertFalse((self.folder / "new.off").exists())

    def test_bad_input(self):
        for text in (solution_text([1., 2.]), "MeshVersionFormatted 2\nDimension 2\n",
                     solution_text([math.nan] * len(sphere()[0]))):
            with self.subTest(text=text[:60]):
                (self.folder / "u.sol").write_text(text)
                self.surety("adapt", "in.off", "-o", "new.off", "-t", "1%", "--solution", "u.sol",
                            "--target-vertices", "100", status=BAD_INPUT)
                self.assertFalse((self.folder / "new.off").exists())


if __name__ == "__main__":
    unittest.main()
