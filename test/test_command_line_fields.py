# SPDX-License-Identifier: GPL-3.0-or-later
#
# surety info with curvature and metric, from outside: what the fields say about surfaces that are
# known, that files and report agree, and that nothing is left on disk when the command fails.
import math
import unittest
from pathlib import Path

import info_runs
from info_runs import BAD_INPUT, DATA, USAGE, cylinder, off_text, read_ply_vertices, read_vtp, sphere

CURVATURE = {"mean_curvature": 1, "gaussian_curvature": 1, "min_curvature": 1, "max_curvature": 1,
             "min_direction": 3, "max_direction": 3, "normal": 3, "point_type": 1, "sides": 1,
             "face_shown": 1}
METRIC = {"smallest_size": 1, "largest_size": 1, "smallest_size_direction": 3, "metric": 9}


class Fields(info_runs.Info):
    def arrays(self, *arguments):
        self.run_info(*arguments, "-o", "out.vtp")
        return read_vtp(self.folder / "out.vtp")

    def test_curvature_of_the_unit_sphere(self):
        curvature = self.report("--curvature")["curvature"]
        for name, value in (("min_curvature", -1), ("max_curvature", -1), ("mean_curvature", -1),
                            ("gaussian_curvature", 1)):
            for bound in curvature[name]:
                self.assertAlmostEqual(bound, value, delta=0.01)
        self.assertEqual(curvature["sides"], 1026)
        self.assertEqual(curvature["point_types"],
                         {"planar": 0, "parabolic": 0, "elliptic": 1026, "hyperbolic": 0})
        self.assertEqual(sum(curvature["fits"].values()), 1026)
        self.assertEqual(curvature["fallbacks"], 0)

    def test_vtp_has_the_fields_that_are_asked_for(self):
        both = self.arrays("--curvature", "--metric", "-t", "1%")
        self.assertEqual({name: len(rows[0]) for name, rows in both.items()},
                         {**CURVATURE, **METRIC})
        self.assertEqual(self.arrays("--curvature").keys(), CURVATURE.keys())
        self.assertEqual(self.arrays("--metric", "-t", "1%").keys(), METRIC.keys())
        round_one = self.arrays("--metric", "-t", "1%", "--metric-kind", "isotropic")
        self.assertEqual(round_one.keys(), {"smallest_size"})
        for rows in both.values():
            self.assertEqual(len(rows), 1026)

    def test_vectors_are_unit_and_orthogonal_and_normals_point_outwards(self):
        arrays = self.arrays("--curvature")
        points = sphere()[0]
        for i, point in enumerate(points):
            frame = [arrays[n][i] for n in ("min_direction", "max_direction", "normal")]
            for a in range(3):
                for b in range(3):
                    dot = sum(x * y for x, y in zip(frame[a], frame[b]))
                    self.assertAlmostEqual(dot, float(a == b), places=9)
            self.assertGreater(sum(x * y for x, y in zip(frame[2], point)), 0.99)

    def test_ridges_show_the_side_of_largest_curvature(self):
        self.input.write_text(off_text(cylinder()))
        arrays = self.arrays("--curvature")
        ring = range(48)
        faces_of_the_side = range(2 * 48 * 24)
        for v in ring:
            self.assertEqual(arrays["sides"][v], [2])
            self.assertAlmostEqual(arrays["min_curvature"][v][0], -1, delta=0.05)
            self.assertIn(arrays["face_shown"][v][0], faces_of_the_side)
        self.assertEqual(arrays["sides"][48], [1])
        self.assertEqual(arrays["point_type"][48 * 12], [1], "parabolic")
        self.assertEqual(self.report("--curvature")["curvature"]["sides"], 48 * 25 + 2 * 48 + 2)

    def test_sizes_are_those_of_a_sphere(self):
        # The middle of an equilateral triangle of side h lies h^2/6 below a unit sphere.
        tolerance = 0.01
        metric = self.report("--metric", "-t", str(tolerance), "--metric-kind", "isotropic",
                             "--max-size", "1")["metric"]
        expected = math.sqrt(6 * tolerance)
        for size in metric["sizes"]:
            self.assertAlmostEqual(size, expected, delta=0.02 * expected)
        self.assertEqual(metric["largest_aspect_ratio"], 1)
        triangles = 4 * math.pi / (math.sqrt(3) / 4 * expected**2)
        self.assertAlmostEqual(metric["predicted_faces"], triangles, delta=0.05 * triangles)
        self.assertEqual(metric["tolerance"], tolerance)

    def test_a_per_cent_is_of_the_diagonal(self):
        length = 0.01 * math.sqrt(12)
        a = self.report("--metric", "-t", "1%")["metric"]
        b = self.report("--metric", "-t", repr(length))["metric"]
        self.assertAlmostEqual(a["tolerance"], b["tolerance"], places=12)
        self.assertAlmostEqual(a["predicted_faces"] / b["predicted_faces"], 1, places=9)

    def test_each_control_changes_the_metric(self):
        self.input.write_text(off_text(cylinder()))
        base = self.report("--metric", "-t", "0.1%")["metric"]
        self.assertEqual((base["kind"], base["gradation"]), ("anisotropic", 1.3))
        self.assertGreater(base["largest_aspect_ratio"], 1.5)
        self.assertGreater(base["sides_changed_by_gradation"], 0)

        def faces(*arguments):
            return self.report("--metric", "-t", "0.1%", *arguments)["metric"]["predicted_faces"]

        jumping = self.report("--metric", "-t", "0.1%", "--gradation", "inf")["metric"]
        self.assertEqual(jumping["gradation"], "inf")
        self.assertEqual(jumping["sides_changed_by_gradation"], 0)
        self.assertLess(jumping["predicted_faces"], base["predicted_faces"])
        self.assertGreater(faces("--metric-kind", "isotropic"), base["predicted_faces"])
        self.assertGreater(faces("--max-size", "2%"), base["predicted_faces"])
        self.assertLess(faces("--min-size", "8%"), base["predicted_faces"])

    def test_a_noise_floor_changes_the_fit(self):
        free = self.report("--curvature")["curvature"]
        floor = self.report("--curvature", "--noise-floor", "1%")["curvature"]
        self.assertNotEqual(free["mean_curvature"], floor["mean_curvature"])

    def test_sol_holds_what_vtp_shows(self):
        for kind, width in (("isotropic", 1), ("anisotropic", 6)):
            arguments = ("--metric", "-t", "1%", "--metric-kind", kind)
            arrays = self.arrays(*arguments)
            self.run_info(*arguments, "-o", "out.sol")
            lines = (self.folder / "out.sol").read_text().split("\n")
            start = lines.index("SolAtVertices") + 1
            self.assertEqual(lines[start : start + 2], ["1026", "1 1" if width == 1 else "1 3"])
            rows = [list(map(float, line.split())) for line in lines[start + 3 : start + 3 + 1026]]
            for v, row in enumerate(rows):
                self.assertEqual(len(row), width)
                shown = (arrays["smallest_size"][v] if width == 1 else
                         [arrays["metric"][v][c] for c in (0, 1, 4, 2, 5, 8)])
                self.assertEqual(row, shown)

    def test_ply_has_colours_of_the_mean_curvature(self):
        self.input.write_text(off_text(cylinder()))
        report = self.report("--curvature", "-o", "out.ply")
        low, high = report["colors"]["range"]
        self.assertEqual((report["colors"]["quantity"], low), ("mean_curvature", -high))
        vertices = read_ply_vertices(self.folder / "out.ply")
        self.assertEqual(len(vertices), 48 * 25 + 2)
        rgb = [(v["red"], v["green"], v["blue"]) for v in vertices]
        self.assertEqual(rgb[-1], (221, 221, 221), "a cap is flat")
        self.assertGreater(rgb[48 * 12][2], rgb[48 * 12][0] + 50, "bent away from its normal: blue")
        self.assertAlmostEqual(vertices[48 * 12]["mean_curvature"], -0.5, delta=0.01)

    def test_ply_has_colours_of_the_size(self):
        self.input.write_text(off_text(cylinder()))
        report = self.report("--metric", "-t", "0.1%", "--metric-kind", "isotropic",
                             "--gradation", "inf", "-o", "out.ply")
        self.assertEqual(report["colors"]["quantity"], "smallest_size")
        vertices = sorted(read_ply_vertices(self.folder / "out.ply"),
                          key=lambda v: v["smallest_size"])
        self.assertEqual((vertices[0]["red"], vertices[0]["blue"]), (59, 192))
        self.assertEqual((vertices[-1]["red"], vertices[-1]["blue"]), (180, 38))

    def test_summary_and_quiet(self):
        result = self.run_info("--curvature", "--metric", "-t", "1%")
        self.assertIn("1,026 elliptic", result.stdout)
        self.assertRegex(result.stdout, r"about [\d,]+ triangles")
        result = self.run_info("--curvature", "-o", "out.vtp", "--quiet")
        self.assertEqual(result.stdout + result.stderr, "")

    def test_is_deterministic(self):
        for form in ("vtp", "ply", "sol"):
            for name in ("a", "b"):
                self.run_info("--curvature", "--metric", "-t", "1%", "-o", f"{name}.{form}")
            self.assertEqual((self.folder / f"a.{form}").read_bytes(),
                             (self.folder / f"b.{form}").read_bytes())

    def test_wrong_usage(self):
        metric = ("--metric", "-t", "1%")
        for arguments in (
                ("-o", "out.vtp"),
                ("--metric",),
                ("--tolerance", "1%"),
                ("--curvature", "--gradation", "2"),
                ("--curvature", "--metric-kind", "isotropic"),
                ("--curvature", "--min-size", "1"),
                ("--curvature", "--max-size", "1"),
                ("--noise-floor", "1%"),
                ("--curvature", "--noise-floor", "-1"),
                ("--metric", "-t", "0"),
                ("--metric", "-t", "nan"),
                ("--metric", "-t", "200%"),
                ("--metric", "-t", "100"),
                (*metric, "--gradation", "0.9"),
                (*metric, "--gradation", "nan"),
                (*metric, "--metric-kind", "round"),
                (*metric, "--min-size", "2%", "--max-size", "1%"),
                (*metric, "--min-size", "x"),
                ("--curvature", "-o", "out.sol"),
                ("--curvature", "-o", "out.off"),
                ("--curvature", "-o", "out"),
                ("--curvature", "-o", "missing/out.vtp"),
                ("--curvature", "-o", "same.vtp", "--report", "same.vtp")):
            with self.subTest(arguments):
                self.run_info(*arguments, status=USAGE)

    def test_bad_input_writes_nothing(self):
        self.input.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n")
        self.run_info("--curvature", "-o", "out.vtp", status=BAD_INPUT)

    @unittest.skipUnless(DATA and Path(DATA, "fandisk.off").exists(), "no real models")
    def test_a_part_with_ridges(self):
        self.input = Path(DATA, "fandisk.off")
        report = self.report("--curvature", "--metric", "-t", "0.1%", "-o", "out.vtp")
        arrays = read_vtp(self.folder / "out.vtp")
        curvature, metric = report["curvature"], report["metric"]
        self.assertEqual(sum(curvature["point_types"].values()), curvature["sides"])
        self.assertGreater(curvature["point_types"]["planar"], 0)
        self.assertGreater(curvature["sides"], len(arrays["sides"]))
        self.assertEqual(sum(n for (n,) in arrays["sides"]), curvature["sides"])
        for rows in arrays.values():
            self.assertTrue(all(math.isfinite(x) for row in rows for x in row))
        low, high = metric["sizes"]
        self.assertGreaterEqual(low, metric["minimum_size"] * (1 - 1e-9))
        self.assertLessEqual(high, metric["maximum_size"] * (1 + 1e-9))
        self.assertGreater(metric["largest_aspect_ratio"], 2)


if __name__ == "__main__":
    unittest.main()
