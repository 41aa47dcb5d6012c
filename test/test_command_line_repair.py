# SPDX-License-Identifier: GPL-3.0-or-later
#
# --repair, from outside: what is no manifold surface becomes one, the report lists what was done,
# sheets that meet still do so, and without the flag all of it is refused.
import json
import math
import unittest

from command_runs import Runs
from info_runs import BAD_INPUT, off_text, sphere


def fan_of_sheets(sheets=3, n=12):
    """Flat sheets that share one edge of theirs, from (0,0,0) to (0,0,1), as one soup."""
    points, faces = [(0, 0, j / n) for j in range(n + 1)], []
    for s in range(sheets):
        phi = 2 * math.pi * s / sheets + .3
        column = list(range(n + 1))
        for i in range(1, n + 1):
            following = []
            for j in range(n + 1):
                following.append(len(points))
                points.append((i / n * math.cos(phi), i / n * math.sin(phi), j / n))
            for j in range(n):
                faces.append((column[j], following[j], following[j + 1]))
                faces.append((column[j], following[j + 1], column[j + 1]))
            column = following
    return points, faces


def read_off(path):
    numbers = iter(path.read_text().split()[1:])
    points, faces = int(next(numbers)), int(next(numbers))
    next(numbers)
    points = [tuple(float(next(numbers)) for _ in range(3)) for _ in range(points)]
    return points, [[int(next(numbers)) for _ in range(int(next(numbers)))] for _ in range(faces)]


class Repair(Runs):
    def write(self, points, faces, name="in.off"):
        (self.folder / name).write_text(off_text((points, faces)))

    def repairs(self, command="simplify"):
        done = self.surety(command, "in.off", "-o", "out.off", "-t", "1%", "--repair",
                           "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["certificate"]["holds"])
        for what, count in report["input"]["repairs"].items():
            self.assertIn(f"repaired: {count:,} {what}", done.stdout)
        return report["input"]["repairs"]

    def refused_without(self):
        self.surety("simplify", "in.off", "-o", "out.off", "-t", "1%", status=BAD_INPUT)

    def test_what_is_sound_needs_none(self):
        self.write(*sphere())
        self.assertEqual(self.repairs(), {})

    def test_soups_are_cleaned(self):
        points, faces = sphere()
        points = [*points, points[faces[0][0]], (5, 5, 5)]
        copy = len(points) - 2
        faces = [tuple(copy if v == faces[0][0] else v for v in faces[0]), *faces[1:]]
        faces = [*faces, faces[7][::-1], (faces[9][0], faces[9][0], faces[9][1])]
        self.write(points, faces)
        self.refused_without()
        self.assertEqual(self.repairs(), {
            "equal points merged": 1, "faces with a corner twice removed": 1,
            "faces removed that were there already": 1, "points without faces removed": 1})

    def test_faces_without_area_go(self):
        points, faces = sphere(0)
        a, b, c = faces[0]
        middle = len(points)
        points = [*points, tuple((x + y) / 2 for x, y in zip(points[a], points[b]))]
        # A cap on the edge from a to b: its corners lie on one line.
        faces = [(a, middle, c), (middle, b, c), (a, b, middle), *faces[1:]]
        self.write(points, faces)
        self.refused_without()
        self.assertEqual(self.repairs(), {"faces without area removed": 1})

    def test_parts_that_meet_in_a_point_are_split(self):
        points, faces = sphere(2)
        moved = [(x + 2, y, z) for x, y, z in points]
        at = points.index((1, 0, 0))
        to = moved.index((1, 0, 0))
        other = [tuple(at if v == to else v + len(points) for v in face) for face in faces]
        self.write([*points, *moved[:to], (9, 9, 9), *moved[to + 1:]], [*faces, *other])
        self.refused_without()
        done = self.repairs()
        self.assertEqual(done["points without faces removed"], 1)
        self.assertEqual(done["points doubled"], 1)

    def test_sheets_that_share_a_curve_stay_together(self):
        for command in ("simplify", "remesh"):
            with self.subTest(command=command):
                points, faces = fan_of_sheets()
                self.write(points, faces)
                self.refused_without()
                done = self.repairs(command)
                self.assertEqual(
                    done["edges of three faces or more fixed, their sheets separated"], 12)
                self.surety("compare", "in.off", "out.off", "-t", "1%")
                after = read_off(self.folder / "out.off")[0]
                on_curve = [p for p in after if p[0] == 0 and p[1] == 0]
                heights = [z for _, _, z in points[:13]]
                for z in heights:
                    self.assertGreaterEqual(sum(p[2] == z for p in on_curve), 2, z)
                self.assertEqual(set(p[2] for p in on_curve), set(heights))

    def test_certificates_are_about_the_repaired_mesh(self):
        self.write(*fan_of_sheets())
        self.surety("simplify", "in.off", "-o", "out.off", "-t", "1%", "--repair",
                    "--certificate", "c.cert")
        self.surety("verify", "in.off", "out.off", "c.cert", "--repair")
        self.surety("verify", "in.off", "out.off", "c.cert", status=BAD_INPUT)

    def test_levels_of_what_is_repaired(self):
        self.write(*fan_of_sheets())
        self.surety("hierarchy", "in.off", "-o", "levels", "-t", "1%,2%", "--repair")
        self.assertTrue((self.folder / "levels" / "index.json").exists())

    def test_what_is_referred_to_by_number_is_left_alone(self):
        self.write(*sphere(2))
        self.surety("remesh", "in.off", "-o", "in.mesh", "-t", "1%")
        error = self.surety(
            "remesh", "in.mesh", "-o", "out.off", "-t", "1%", "--repair", status=BAD_INPUT).stderr
        self.assertIn("--repair", error)


if __name__ == "__main__":
    unittest.main()
