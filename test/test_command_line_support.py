# SPDX-License-Identifier: GPL-3.0-or-later
#
# surety info --support, from outside: what it draws of surfaces that are known, that the report
# holds for what is drawn, and that each control does something.
import math
import unittest
from pathlib import Path

import info_runs
from info_runs import DATA, USAGE, cylinder, off_text, read_ply_vertices, read_vtp, sphere

POINT_ARRAYS = {"stripes": 1, "isophote": 1, "normal": 3, "min_curvature": 1, "max_curvature": 1,
                "displacement": 1, "spent": 1}
FACE_ARRAYS = {"face": 1, "may_saturate": 1, "is_refused": 1, "is_tangent": 1}
LIGHT = [x / math.sqrt(14) for x in (1, 2, 3)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Support(info_runs.Info):
    def drawn(self, *arguments):
        """Points, arrays of the points and arrays of the triangles."""
        self.run_info("--support", *arguments, "-o", "out.vtp")
        path = self.folder / "out.vtp"
        return (read_vtp(path, "Points")["Points"], read_vtp(path), read_vtp(path, "CellData"))

    def support(self, *arguments):
        return self.report("--support", *arguments)["support"]

    def test_of_a_sphere_is_a_sphere(self):
        points, at_points, _ = self.drawn("-t", "1%")
        for point, normal in zip(points, at_points["normal"]):
            self.assertAlmostEqual(math.hypot(*point), 1, delta=2e-5)
            self.assertGreater(dot(point, normal), 0.99999)
        middle = [rows for i, rows in enumerate(zip(at_points["min_curvature"],
                                                    at_points["max_curvature"])) if i % 15 == 7]
        for (least,), (largest,) in middle:
            self.assertAlmostEqual(least, -1, delta=0.05)
            self.assertAlmostEqual(largest, -1, delta=0.05)

    def test_has_its_arrays_and_points_of_each_face(self):
        faces = len(sphere()[1])
        for n in (1, 4, 7):
            points, at_points, at_faces = self.drawn("-t", "1%", "--subdivisions", str(n))
            self.assertEqual(len(points), faces * (n + 1) * (n + 2) // 2)
            self.assertEqual({name: len(rows[0]) for name, rows in at_points.items()}, POINT_ARRAYS)
            self.assertEqual({name: len(rows[0]) for name, rows in at_faces.items()}, FACE_ARRAYS)
            self.assertEqual([int(f) for (f,) in at_faces["face"]],
                             [f for f in range(faces) for _ in range(n * n)])
            for rows in at_points.values():
                self.assertEqual(len(rows), len(points))
        self.assertEqual(len(self.drawn("-t", "1%")[0]), faces * 15, "4 subdivisions by default")

    def test_triangles_look_the_way_of_the_normals(self):
        points, at_points, _ = self.drawn("-t", "1%")
        corners = read_vtp(self.folder / "out.vtp", "Polys")["connectivity"]
        for i in range(0, len(corners), 3):
            a, b, c = (points[int(corners[i + k][0])] for k in range(3))
            u, v = ([x - y for x, y in zip(p, a)] for p in (b, c))
            cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            self.assertGreater(dot(cross, at_points["normal"][int(corners[i][0])]), 0)

    def test_stripes_are_isophotes(self):
        _, at_points, _ = self.drawn("-t", "1%")
        stripes = [s for (s,) in at_points["stripes"]]
        for (isophote,), stripe, normal in zip(at_points["isophote"], stripes, at_points["normal"]):
            self.assertAlmostEqual(isophote, dot(normal, LIGHT), places=12)
            self.assertAlmostEqual(stripe, math.cos(48 * math.acos(isophote)), places=6)
        self.assertLess(min(stripes), -0.9)
        self.assertGreater(max(stripes), 0.9)

    def test_is_proven_to_stay_within_half_of_the_tolerance(self):
        self.input.write_text(off_text(sphere(1)))
        loose, tight = self.support("-t", "1"), self.support("-t", "0.02")
        self.assertEqual((loose["tolerance"], tight["tolerance"]), (1, 0.02))
        self.assertEqual((loose["saturated_share"], loose["smooth_share"]), (0, 1))
        self.assertEqual(loose["sampled_smooth_share"], 1)
        self.assertGreater(tight["sampled_saturated_share"], 0.2)
        self.assertLess(tight["sampled_smooth_share"], 0.8)
        self.assertLessEqual(tight["sampled_saturated_share"], tight["saturated_share"])
        for tolerance in (1, 0.02):
            _, at_points, at_faces = self.drawn("-t", str(tolerance))
            report = self.support("-t", str(tolerance))
            moved = [d for (d,) in at_points["displacement"]]
            self.assertGreater(max(moved), 0.005)
            self.assertLessEqual(max(moved), report["deviation"])
            self.assertLessEqual(report["deviation"], tolerance / 2)
            for d, (spent,) in zip(moved, at_points["spent"]):
                self.assertAlmostEqual(spent, d / (tolerance / 2), places=12)
            self.assertEqual(any(s for (s,) in at_faces["may_saturate"]),
                             report["saturated_share"] > 0)

    def test_finds_ridges_by_need_and_gives_them_two_normals(self):
        self.input.write_text(off_text(cylinder()))
        report = self.support("-t", "0.1%")
        self.assertEqual((report["ridge_edges"], report["corners"]), (96, 0))
        points, at_points, _ = self.drawn("-t", "0.1%")
        directions = set()
        for (x, y, z), normal in zip(points, at_points["normal"]):
            if z == 0 and math.hypot(x, y) > 0.999:
                directions.add(round(abs(normal[2]), 2))
        self.assertEqual(directions, {0, 1})

    def test_takes_a_feature_angle_and_a_corner_angle(self):
        self.input.write_text(off_text(cylinder()))
        self.assertEqual(self.support("-t", "0.1%", "--feature-angle", "180")["ridge_edges"], 0)
        self.assertEqual(self.support("-t", "0.1%", "--feature-angle", "40")["ridge_edges"], 96)
        # The rims turn by 7.5 degrees at each vertex.
        for features in ((), ("--feature-angle", "40")):
            report = self.support("-t", "0.1%", *features, "--corner-angle", "5")
            self.assertEqual(report["corners"], 96)

    def test_a_noise_floor_changes_the_normals(self):
        _, free, _ = self.drawn("-t", "1%")
        _, floor, _ = self.drawn("-t", "1%", "--noise-floor", "1%")
        self.assertNotEqual(free["normal"], floor["normal"])

    def test_ply_shows_the_stripes(self):
        self.run_info("--support", "-t", "1%", "-o", "out.ply")
        vertices = read_ply_vertices(self.folder / "out.ply")
        self.assertEqual(len(vertices), 15 * len(sphere()[1]))
        dark = min(vertices, key=lambda v: v["stripes"])
        bright = max(vertices, key=lambda v: v["stripes"])
        self.assertGreater(dark["blue"], dark["red"] + 50)
        self.assertGreater(bright["red"], bright["blue"] + 50)
        self.assertEqual(set(vertices[0]) - {"x", "y", "z", "red", "green", "blue", "alpha"},
                         set(POINT_ARRAYS) - {"normal"} | {"normal_x", "normal_y", "normal_z"})

    def test_prints_its_report_beside_the_others(self):
        out = self.run_info("--support", "--curvature", "--metric", "-t", "1%").stdout
        self.assertRegex(out, r"support: within [\d.e-]+ of the mesh, for a tolerance of [\d.]+")
        self.assertRegex(out, r"smooth on about 100 % of the area, at least 100 %")
        self.assertIn("elliptic", out)
        both = self.report("--support", "--curvature", "-t", "1%")
        self.assertIn("curvature", both)
        self.assertEqual(both["support"]["refused_faces"], 0)
        quiet = self.run_info("--support", "-t", "1%", "-o", "out.vtp", "--quiet")
        self.assertEqual(quiet.stdout + quiet.stderr, "")

    def test_a_per_cent_is_of_the_diagonal(self):
        self.assertAlmostEqual(self.support("-t", "1%")["tolerance"], 0.01 * math.sqrt(12))

    def test_is_deterministic(self):
        for form in ("vtp", "ply"):
            for name in ("a", "b"):
                self.run_info("--support", "-t", "1%", "-o", f"{name}.{form}")
            self.assertEqual((self.folder / f"a.{form}").read_bytes(),
                             (self.folder / f"b.{form}").read_bytes())

    def test_wrong_usage(self):
        support = ("--support", "-t", "1%")
        for arguments in (
                ("--support",),
                ("--subdivisions", "4"),
                ("--support", "-t", "0"),
                ("--support", "-t", "200%"),
                ("--support", "-t", "inf"),
                (*support, "--subdivisions", "0"),
                (*support, "--subdivisions", "101"),
                (*support, "--subdivisions", "x"),
                (*support, "--noise-floor", "-1"),
                (*support, "--curvature", "-o", "out.vtp"),
                (*support, "--metric", "-o", "out.vtp"),
                (*support, "-o", "out.sol"),
                (*support, "-o", "out.off"),
                (*support, "-o", "missing/out.vtp"),
                (*support, "-o", "same.vtp", "--report", "same.vtp")):
            with self.subTest(arguments):
                self.run_info(*arguments, status=USAGE)

    @unittest.skipUnless(DATA and Path(DATA, "fandisk.off").exists(), "no real models")
    def test_of_a_part(self):
        self.input = Path(DATA, "fandisk.off")
        report = self.support("-t", "0.1%", "--subdivisions", "1", "-o", "out.vtp")
        self.assertGreater(report["ridge_edges"], 100)
        self.assertGreater(report["sampled_smooth_share"], 0.95)
        self.assertLessEqual(report["deviation"], report["tolerance"] / 2)
        for rows in read_vtp(self.folder / "out.vtp").values():
            self.assertTrue(all(math.isfinite(x) for row in rows for x in row))


if __name__ == "__main__":
    unittest.main()
