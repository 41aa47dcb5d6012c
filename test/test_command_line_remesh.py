# SPDX-License-Identifier: GPL-3.0-or-later
#
# surety remesh, from outside: a certified mesh and a report, every flag changes what it says, and
# nothing is left on disk when the command fails.
import json
import math
import unittest

from command_runs import Runs
from info_runs import BAD_INPUT, USAGE, off_text, sphere


class Remesh(Runs):
    def setUp(self):
        super().setUp()
        (self.folder / "in.off").write_text(off_text(sphere()))

    def report(self, *arguments):
        self.surety("remesh", "in.off", "-o", "out.off", "--report", "r.json", *arguments)
        return json.loads((self.folder / "r.json").read_text())

    def test_makes_a_certified_mesh(self):
        report = self.report("-t", "1%")
        self.assertTrue(report["certificate"]["holds"])
        self.assertLessEqual(report["certificate"]["bound"], report["certificate"]["tolerance"])
        self.assertTrue(report["certificate"]["distance_check"]["holds"])
        self.assertGreaterEqual(report["output"]["unit_edges"], 98)
        self.assertGreaterEqual(report["output"]["efficiency_index"], .95)
        metric = report["output"]["metric"]
        self.assertEqual(sum(b["number"] for b in metric["qualities"]), report["output"]["faces"])
        for name in ("collapse", "split", "flip", "relocation"):
            self.assertIn(name, report["operations"]["performed"])
        self.surety("compare", "in.off", "out.off", "-t", "1%")

    def test_sizes_do_what_they_say(self):
        usual = self.report("-t", "1%")["output"]["faces"]
        few = self.report("-t", "1%", "--fewest")
        self.assertTrue(few["parameters"]["fewest_faces"])
        self.assertLessEqual(few["output"]["faces"], usual)
        self.assertGreater(self.report("-t", "1%", "--max-size", "5%")["output"]["faces"], usual)
        # Sizes of .2 on a sphere of radius 1.
        both = ("--min-size", ".2", "--max-size", ".2")
        faces = self.report("-t", "3%", *both)["output"]["faces"]
        self.assertAlmostEqual(faces / (4 * math.pi / (.433 * .04)), 1.15, delta=.35)

    def test_a_size_field_does_what_it_says(self):
        points = sphere()[0]
        sizes = "\n".join(".1" if p[2] > .5 else "1" for p in points)
        (self.folder / "s.sol").write_text(
            f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{len(points)}\n1 1\n{sizes}\nEnd\n")
        usual = self.report("-t", "1%")["output"]["faces"]
        field = self.report("-t", "1%", "--min-size", ".05", "--size-field", "s.sol")
        self.assertGreater(field["output"]["faces"], 1.2 * usual)
        (self.folder / "s.sol").write_text("MeshVersionFormatted 2\nDimension 2\n")
        self.surety("remesh", "in.off", "-o", "new.off", "-t", "1%", "--size-field", "s.sol",
                    status=BAD_INPUT)
        self.assertFalse((self.folder / "new.off").exists())

    def test_flags_are_in_the_report(self):
        report = self.report("-t", "1%", "--metric", "anisotropic", "--gradation", "1.5",
                             "--placement", "on-surface", "--iterations", "2", "--max-aspect", "4",
                             "--feature-angle", "180", "--corner-angle", "50")
        expected = {"metric": "anisotropic", "gradation": 1.5, "placement": "on-surface",
                    "iterations": 2, "maximum_aspect_ratio": 4, "feature_angle": 180,
                    "corner_angle": 50}
        for name, value in expected.items():
            self.assertEqual(report["parameters"][name], value)
        self.assertLessEqual(report["iterations"], 2)

    def test_quiet_prints_nothing(self):
        done = self.surety("remesh", "in.off", "-o", "out.off", "-t", "2%", "--quiet", "--no-verify")
        self.assertEqual(done.stdout + done.stderr, "")

    def test_wrong_usage(self):
        for arguments in (("-t", "0"), ("-t", "200%"), ("-t", "1%", "--metric", "round"),
                          ("-t", "1%", "--gradation", "-1"), ("-t", "1%", "--gradation", ".5")):
            with self.subTest(arguments=arguments):
                self.surety("remesh", "in.off", "-o", "new.off", *arguments, status=USAGE)
                self.assertFalse((self.folder / "new.off").exists())
        self.surety("remesh", "in.off", "-o", "new.xyz", "-t", "1%", status=USAGE)

    def test_bad_input(self):
        (self.folder / "bad.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
        self.surety("remesh", "bad.off", "-o", "new.off", "-t", "1%", status=BAD_INPUT)
        self.assertFalse((self.folder / "new.off").exists())


if __name__ == "__main__":
    unittest.main()
