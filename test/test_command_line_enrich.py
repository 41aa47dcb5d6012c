# SPDX-License-Identifier: GPL-3.0-or-later
#
# surety enrich, from outside: what is enforced holds in the file, what is reported is true, every
# flag does something, and nothing is left on disk when the command fails.
import json
import math
import os
import re
import unittest
from pathlib import Path

from command_runs import Runs
from info_runs import BAD_INPUT, DATA, USAGE, cylinder, off_text, read_vtp, sphere

NOT_CERTIFIED = 4


def read_off(path):
    words = path.read_text().split()
    points, faces = int(words[1]), int(words[2])
    rows = [tuple(float(x) for x in words[4 + 3 * i : 7 + 3 * i]) for i in range(points)]
    return rows, faces


class Enrich(Runs):
    def setUp(self):
        super().setUp()
        (self.folder / "in.off").write_text(off_text(sphere(1)))

    def report(self, *arguments, out="out.off"):
        self.surety("enrich", "in.off", "-o", out, "--report", "r.json", *arguments)
        return json.loads((self.folder / "r.json").read_text())

    def test_goes_to_the_sphere_and_keeps_the_vertices(self):
        report = self.report("-t", "0.1%")
        points, faces = read_off(self.folder / "out.off")
        given, _ = read_off(self.folder / "in.off")
        self.assertEqual(points[:len(given)], given)
        self.assertEqual((report["output"]["vertices"], report["output"]["faces"]),
                         (len(points), faces))
        self.assertGreater(len(points), 2 * len(given))
        for p in points:
            self.assertAlmostEqual(math.hypot(*p), 1, delta=0.02)
        self.assertEqual(report["enforced"]["vertices_kept"], len(given))
        self.assertTrue(report["enforced"]["is_fine"])

    def test_what_is_reported_is_true(self):
        report = self.report("-t", "0.1%")
        deviation = report["reported"]["deviation"]
        self.assertGreater(deviation, 0.01)
        self.assertTrue(report["reported"]["distance_check"]["holds"])
        self.surety("compare", "in.off", "out.off", "-t", str(1.001 * deviation))
        self.surety("compare", "in.off", "out.off", "-t", str(0.9 * deviation),
                    status=NOT_CERTIFIED)

    def test_vtp_has_the_deviation_of_each_face(self):
        report = self.report("-t", "0.1%", out="out.vtp")
        cells = read_vtp(self.folder / "out.vtp", "CellData")
        self.assertEqual(max(d for (d,) in cells["deviation"]), report["reported"]["deviation"])

    def test_rims_of_a_cylinder_are_ridges_unless_told_otherwise(self):
        (self.folder / "in.off").write_text(off_text(cylinder()))
        self.assertGreater(self.report("-t", "0.01%")["features"]["ridges"], 0)
        self.assertEqual(self.report("-t", "1%", "--feature-angle", "180")["features"]["ridges"], 0)
        # Its rims turn by less than 10 degrees a vertex.
        corners = self.report("-t", "1%", "--corner-angle", "5")["features"]["corners"]
        self.assertGreater(corners, 0)

    def test_sizes(self):
        few = self.report("-t", "1%")["output"]["faces"]
        self.assertGreater(self.report("-t", "0.05%")["output"]["faces"], few)
        self.assertGreater(self.report("-t", "1%", "--max-size", "3%")["output"]["faces"], few)

    def test_too_few_rounds(self):
        done = self.surety("enrich", "in.off", "-o", "new.off", "-t", "0.001%", "--rounds", "1",
                           status=NOT_CERTIFIED)
        self.assertIn("--rounds", done.stderr)
        self.assertFalse((self.folder / "new.off").exists())

    def test_prints_what_is_enforced_and_what_is_reported(self):
        out = self.surety("enrich", "in.off", "-o", "out.off", "-t", "0.1%").stdout
        self.assertRegex(out, r"enforced\n.*kept")
        self.assertRegex(out, r"reported\n  the result leaves the input by at most [\d.e-]+")
        self.assertNotIn("not checked", out)
        quiet = self.surety("enrich", "in.off", "-o", "out.off", "-t", "1%", "--quiet")
        self.assertEqual(quiet.stdout + quiet.stderr, "")
        unchecked = self.surety("enrich", "in.off", "-o", "out.off", "-t", "1%", "--no-verify")
        self.assertIn("not checked", unchecked.stdout)

    def test_the_example_of_the_help_works(self):
        text = self.surety("enrich", "--help").stdout
        command = re.search(r"Example: surety (.*)", text)[1].split()
        self.surety("enrich", "in.off", "-o", "part.stl", "-t", "1%")
        self.surety(*command)
        self.assertTrue((self.folder / "fine.off").exists())
        self.assertTrue((self.folder / "fine.json").exists())

    def test_wrong_usage(self):
        for arguments in (("-t", "0"), ("-t", "200%"), ("-t", "1%", "--max-size", "0"),
                          ("-t", "1%", "--feature-angle", "181"), ("-t", "1%", "--rounds", "-1"),
                          ("-t", "1%", "--report", "new.html"), ()):
            with self.subTest(arguments=arguments):
                self.surety("enrich", "in.off", "-o", "new.off", *arguments, status=USAGE)
                self.assertFalse((self.folder / "new.off").exists())
        self.surety("enrich", "in.off", "-o", "new.xyz", "-t", "1%", status=USAGE)

    def test_bad_input(self):
        (self.folder / "bad.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
        self.surety("enrich", "bad.off", "-o", "new.off", "-t", "1%", status=BAD_INPUT)
        self.assertFalse((self.folder / "new.off").exists())

    def test_medit_has_the_ridges(self):
        (self.folder / "in.off").write_text(off_text(cylinder()))
        self.surety("enrich", "in.off", "-o", "out.mesh", "-t", "0.01%")
        self.assertIn("Ridges", (self.folder / "out.mesh").read_text())

    @unittest.skipUnless(os.path.exists(f"{DATA}/mushroom.off"), "no real models")
    def test_of_a_model(self):
        (self.folder / "in.off").write_bytes(Path(DATA, "mushroom.off").read_bytes())
        report = self.report("-t", "0.1%")
        self.assertGreater(report["output"]["faces"], report["input"]["faces"])
        self.assertEqual(report["output"]["self_intersections"],
                         report["input"]["self_intersections"])


if __name__ == "__main__":
    unittest.main()
