# SPDX-License-Identifier: GPL-3.0-or-later
#
# The command line, from outside: every flag, every exit status, every format, every kind of bad
# input. What is refused must be refused with a message that helps, and leave nothing on disk.
#
# CTest runs it with SURETY set to the program; by hand: SURETY=build/release/surety python3 <this>.
import array
import json
import math
import os
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SURETY = os.environ.get("SURETY", "surety")
DATA = os.environ.get("SURETY_DATA_DIR", "")

DONE, USAGE, BAD_INPUT, NOT_CERTIFIED, INTERRUPTED = 0, 2, 3, 4, 130


# Meshes are pairs of lists: points and polygons.


def torus(rings=24, sides=12):
    points = []
    for i in range(rings):
        for j in range(sides):
            u, v = 2 * math.pi * i / rings, 2 * math.pi * j / sides
            r = 2 + math.cos(v)
            points.append((r * math.cos(u), r * math.sin(u), math.sin(v)))
    faces = []
    for i in range(rings):
        for j in range(sides):
            a, b = i * sides + j, (i + 1) % rings * sides + j
            c, d = (i + 1) % rings * sides + (j + 1) % sides, i * sides + (j + 1) % sides
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def grid(size=12, height=lambda x, y: 0.1 * math.sin(6 * x) * math.cos(5 * y)):
    step = 1 / size
    points = [
        (i * step, j * step, height(i * step, j * step))
        for i in range(size + 1)
        for j in range(size + 1)
    ]
    faces = []
    for i in range(size):
        for j in range(size):
            a = i * (size + 1) + j
            b, c, d = a + size + 1, a + size + 2, a + 1
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def cube():
    points = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, quads


def split(mesh):
    points, polygons = mesh
    return points, [(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)]


def folded(size=16, angle=50):
    """A sheet with one straight ridge in the middle, and a little waviness beside it."""
    slope = math.tan(math.radians(angle / 2))
    wave = 1e-3
    return grid(size, lambda x, y: slope * abs(x - 0.5) + wave * math.sin(40 * x * y))


def scaled(mesh, factor):
    return [tuple(factor * c for c in p) for p in mesh[0]], mesh[1]


def single_precision(mesh):
    return [tuple(array.array("f", p)) for p in mesh[0]], mesh[1]


def off_text(mesh):
    points, polygons = mesh
    lines = ["OFF", f"{len(points)} {len(polygons)} 0"]
    lines += [" ".join(map(repr, map(float, p))) for p in points]
    lines += [" ".join(map(str, (len(p), *p))) for p in polygons]
    return "\n".join(lines) + "\n"


def obj_text(mesh):
    points, polygons = mesh
    lines = ["v " + " ".join(map(repr, map(float, p))) for p in points]
    lines += ["f " + " ".join(str(v + 1) for v in p) for p in polygons]
    return "\n".join(lines) + "\n"


def ply_header(mesh, form):
    points, polygons = mesh
    return (
        f"ply\nformat {form} 1.0\nelement vertex {len(points)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {len(polygons)}\nproperty list uchar int vertex_indices\nend_header\n"
    )


def ply_text(mesh):
    return ply_header(mesh, "ascii") + off_text(mesh).split("\n", 2)[2]


def ply_bytes(mesh):
    data = ply_header(mesh, "binary_little_endian").encode()
    data += b"".join(struct.pack("<3d", *p) for p in mesh[0])
    return data + b"".join(struct.pack(f"<B{len(p)}i", len(p), *p) for p in mesh[1])


def stl_text(mesh, name="part"):
    lines = [f"solid {name}"]
    for polygon in mesh[1]:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(map(repr, map(float, mesh[0][v]))) for v in polygon]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + [f"endsolid {name}"]) + "\n"


def stl_bytes(mesh, header=b""):
    data = header.ljust(80, b" ") + struct.pack("<I", len(mesh[1]))
    for polygon in mesh[1]:
        corners = [c for v in polygon for c in mesh[0][v]]
        data += struct.pack("<12fH", 0, 0, 0, *corners, 0)
    return data


WRITERS = {
    "in.off": off_text,
    "in.obj": obj_text,
    "in.ply": ply_text,
    "binary.ply": ply_bytes,
    "in.stl": stl_text,
    "binary.stl": stl_bytes,
}


def read_off(path):
    words = Path(path).read_text().split()
    points, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    corners = [tuple(map(float, numbers[3 * i : 3 * i + 3])) for i in range(points)]
    indices = numbers[3 * points :]
    return corners, [tuple(map(int, indices[4 * i + 1 : 4 * i + 4])) for i in range(faces)]


class Case(unittest.TestCase):
    """A test in a folder of its own."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def write(self, name, content):
        path = self.folder / name
        if isinstance(content, str):
            content = content.encode()
        path.write_bytes(content)
        return path

    def run_surety(self, *arguments):
        return subprocess.run(
            [SURETY, *map(str, arguments)],
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=300,
            check=False,
        )

    def succeed(self, *arguments):
        result = self.run_surety(*arguments)
        self.assertEqual(result.returncode, DONE, result.stderr + result.stdout)
        return result

    def refuse(self, status, message, *arguments):
        """The command must fail with this status and message, and change nothing on disk."""
        before = self.snapshot()
        result = self.run_surety(*arguments)
        self.assertEqual(result.returncode, status, result.stderr + result.stdout)
        self.assertRegex(result.stderr, message)
        self.assertEqual(self.snapshot(), before, "something was written")
        return result

    def snapshot(self):
        return {
            str(p.relative_to(self.folder)): p.read_bytes() if p.is_file() else None
            for p in self.folder.rglob("*")
        }

    def report(self, *arguments):
        self.succeed(*arguments, "--report", "report.json")
        return json.loads((self.folder / "report.json").read_text())


class Simplify(Case):
    def setUp(self):
        super().setUp()
        self.write("torus.off", off_text(torus()))

    def test_reports_everything_that_is_promised(self):
        report = self.report("simplify", "torus.off", "-o", "out.off", "-t", "2%")
        for mesh in ("input", "output"):
            for key in ("vertices", "faces", "Q_max", "Q_avg", "Q_le_2", "angle_min", "angle_max",
                        "self_intersections"):
                self.assertIn(key, report[mesh])
        self.assertEqual(report["input"]["faces"], 576)
        self.assertLess(report["output"]["faces"], 300)
        self.assertEqual(report["output"]["genus"], 1)
        self.assertTrue(report["certificate"]["holds"])
        self.assertLessEqual(report["certificate"]["bound"], report["certificate"]["tolerance"])
        self.assertAlmostEqual(
            report["certificate"]["tolerance"], 0.02 * report["input"]["diagonal"], places=12)
        self.assertTrue(report["certificate"]["certificate_check"]["holds"])
        self.assertTrue(report["certificate"]["distance_check"]["holds"])
        for step in ("read", "geometric_mesh", "verify", "write"):
            self.assertGreaterEqual(report["seconds"][step], 0)
        self.assertGreater(report["operations"]["performed"]["collapse"], 0)
        self.assertGreater(sum(report["operations"]["refused"].values()), 0)
        version = self.succeed("--version").stdout.split()[1]
        self.assertEqual(report["version"], version)

    def test_takes_a_length_or_a_per_cent(self):
        relative = self.report("simplify", "torus.off", "-o", "relative.off", "-t", "1%")
        length = relative["certificate"]["tolerance"]
        self.report("simplify", "torus.off", "-o", "absolute.off", "-t", repr(length))
        self.assertEqual(
            (self.folder / "relative.off").read_bytes(), (self.folder / "absolute.off").read_bytes())

    def test_is_deterministic(self):
        for name in ("a", "b"):
            self.succeed("simplify", "torus.off", "-o", f"{name}.ply", "-t", "1%",
                         "--certificate", f"{name}.cert")
        for kind in ("ply", "cert"):
            self.assertEqual((self.folder / f"a.{kind}").read_bytes(),
                             (self.folder / f"b.{kind}").read_bytes())

    def test_summary_says_what_is_proven(self):
        result = self.succeed("simplify", "torus.off", "-o", "out.off", "-t", "1%")
        self.assertRegex(result.stdout, r"576 faces")
        self.assertRegex(result.stdout, r"proven")
        self.assertRegex(result.stdout, r"holds")
        self.assertEqual(result.stderr, "", "the progress bar is for terminals")

    def test_quiet_prints_nothing(self):
        result = self.succeed("simplify", "torus.off", "-o", "out.off", "-t", "1%", "--quiet")
        self.assertEqual(result.stdout + result.stderr, "")

    def test_no_verify_leaves_the_checks_out(self):
        report = self.report("simplify", "torus.off", "-o", "out.off", "-t", "1%", "--no-verify")
        self.assertNotIn("distance_check", report["certificate"])
        self.assertNotIn("certificate_check", report["certificate"])
        self.assertNotIn("verify", report["seconds"])

    def test_accumulated_bound_is_checked_too(self):
        report = self.report(
            "simplify", "torus.off", "-o", "out.off", "-t", "2%", "--bound", "accumulated")
        self.assertEqual(report["certificate"]["policy"], "accumulated")
        self.assertTrue(report["certificate"]["distance_check"]["holds"])
        direct = self.report("simplify", "torus.off", "-o", "out.off", "-t", "2%")
        self.assertLess(direct["output"]["faces"], report["output"]["faces"])

    def test_replaces_an_older_output(self):
        self.write("out.off", "something else")
        self.succeed("simplify", "torus.off", "-o", "out.off", "-t", "1%")
        self.assertEqual((self.folder / "out.off").read_text()[:3], "OFF")

    def test_output_has_the_usual_permissions(self):
        self.succeed("simplify", "torus.off", "-o", "out.off", "-t", "1%")
        self.write("reference", "")
        self.assertEqual(
            (self.folder / "out.off").stat().st_mode, (self.folder / "reference").stat().st_mode)

    def test_writes_through_a_symbolic_link(self):
        (self.folder / "elsewhere").mkdir()
        (self.folder / "out.off").symlink_to("elsewhere/real.off")
        self.succeed("simplify", "torus.off", "-o", "out.off", "-t", "1%")
        self.assertTrue((self.folder / "out.off").is_symlink())
        self.assertTrue((self.folder / "elsewhere/real.off").is_file())

    def test_interruption_writes_nothing(self):
        self.write("large.off", off_text(grid(300)))
        before = self.snapshot()
        process = subprocess.Popen(
            [SURETY, "simplify", "large.off", "-o", "out.off", "-t", "0.1%"],
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        _, error = process.communicate(timeout=300)
        if process.returncode == DONE:
            self.skipTest("too fast to be interrupted")
        self.assertEqual(process.returncode, INTERRUPTED, error)
        self.assertIn("nothing was written", error)
        self.assertEqual(self.snapshot(), before)


class Controls(Case):
    """Each control, when changed, changes the result in the sense that it promises."""

    def faces(self, mesh, *arguments):
        self.write("in.off", off_text(mesh))
        report = self.report("simplify", "in.off", "-o", "out.off", *arguments)
        return report["output"]["faces"]

    def ridge_points(self):
        points, _ = read_off(self.folder / "out.off")
        return [p for p in points if abs(p[0] - 0.5) < 1e-12]

    def test_feature_angle_keeps_ridges(self):
        kept = self.faces(folded(), "-t", "20%", "--feature-angle", "40")
        ends = {p[1] for p in self.ridge_points()}
        self.assertLessEqual({0.0, 1.0}, ends, "the ends of the ridge are gone")
        flattened = self.faces(folded(), "-t", "20%", "--feature-angle", "180")
        self.assertLess(flattened, kept)

    def test_corner_angle_keeps_corners(self):
        circle = torus(48, 4)  # four ridges, each a polygon that turns by 7.5 degrees a vertex
        many = self.faces(circle, "-t", "3%", "--feature-angle", "40", "--corner-angle", "5")
        few = self.faces(circle, "-t", "3%", "--feature-angle", "40", "--corner-angle", "60")
        self.assertLess(few, many)

    def test_roughness_angle_limits_tilt(self):
        smooth = self.faces(torus(), "-t", "10%", "--roughness-angle", "25")
        rough = self.faces(torus(), "-t", "10%", "--roughness-angle", "180")
        self.assertLess(rough, smooth)

    def test_shape_floor_and_ratio_limit_slivers(self):
        stretched = [(8 * x, y, z) for x, y, z in grid(16)[0]], grid(16)[1]
        strict = self.faces(stretched, "-t", "1%", "--shape-floor", "1")
        loose = self.faces(stretched, "-t", "1%", "--shape-floor", "100")
        self.assertLess(loose, strict)
        ratio = self.faces(stretched, "-t", "1%", "--shape-floor", "1", "--shape-ratio", "100")
        self.assertLess(ratio, strict)

    def test_flip_rounds_flip(self):
        self.write("in.off", off_text(torus()))
        with_flips = self.report("simplify", "in.off", "-o", "out.off", "-t", "1%")
        without = self.report("simplify", "in.off", "-o", "out.off", "-t", "1%", "--flip-rounds", "0")
        self.assertGreater(with_flips["operations"]["performed"]["flip"], 0)
        self.assertEqual(without["operations"]["performed"]["flip"], 0)

    def test_self_intersections_are_admitted_on_request_only(self):
        # Two sheets so near that either may pass through the other within the tolerance.
        lower = grid(12)
        points = lower[0] + [(x, y, z + 0.01) for x, y, z in lower[0]]
        faces = lower[1] + [tuple(v + len(lower[0]) for v in f) for f in lower[1]]
        self.write("in.off", off_text((points, faces)))
        never = self.report("simplify", "in.off", "-o", "out.off", "-t", "3%")
        self.assertEqual(never["output"]["self_intersections"], 0)
        self.assertGreater(never["operations"]["refused"]["self_intersection"], 0)
        admitted = self.report(
            "simplify", "in.off", "-o", "out.off", "-t", "3%", "--allow-self-intersections")
        self.assertEqual(admitted["operations"]["refused"]["self_intersection"], 0)

    def test_normal_tolerance_is_proven(self):
        self.write("in.off", off_text(torus()))
        faces = []
        for angle in ("12", "40"):
            report = self.report("simplify", "in.off", "-o", "out.off", "-t", "2%",
                                 "--normal-tolerance", angle)
            proven = report["certificate"]["certificate_check"]["largest_normal_deviation"]
            self.assertLessEqual(proven, float(angle))
            self.assertEqual(report["parameters"]["normal_tolerance"], float(angle))
            faces.append(report["output"]["faces"])
        self.assertGreater(faces[0], faces[1])

    def test_smoothing_makes_rounder_faces_and_keeps_their_number(self):
        self.write("in.off", off_text(torus()))
        before, after = (
            self.report("simplify", "in.off", "-o", "out.off", "-t", "2%", "--smoothing", sweeps)
            for sweeps in ("0", "10"))
        self.assertEqual(before["output"]["faces"], after["output"]["faces"])
        self.assertLess(after["output"]["Q_avg"], before["output"]["Q_avg"])
        self.assertEqual(after["parameters"]["smoothing"], 10)

    def test_ridge_tolerance_is_proven(self):
        self.write("in.off", off_text(grid()))
        faces = []
        for tolerance in ("0.01%", "1%"):
            report = self.report("simplify", "in.off", "-o", "out.off", "-t", "1%",
                                 "--ridge-tolerance", tolerance, "--placement", "free")
            proven = report["certificate"]["certificate_check"]["curve_bound"]
            self.assertLessEqual(proven, report["parameters"]["ridge_tolerance"])
            faces.append(report["output"]["faces"])
        self.assertAlmostEqual(report["parameters"]["ridge_tolerance"],
                               report["certificate"]["tolerance"])
        self.assertGreater(faces[0], faces[1])

    def test_tolerance_field_of_vertices_or_faces(self):
        points, triangles = torus()
        everywhere = self.faces((points, triangles), "-t", "2%")
        for number in (len(points), len(triangles)):
            self.write("small.txt", "1e-9\n" * number)
            few = self.faces((points, triangles), "-t", "2%", "--tolerance-field", "small.txt")
            self.assertGreater(few, 0.9 * len(triangles))
            self.assertGreater(few, everywhere)
            self.write("large.txt", "1000 " * number)
            self.assertEqual(everywhere, self.faces((points, triangles), "-t", "2%",
                                                    "--tolerance-field", "large.txt"))

    def test_bad_tolerance_field_is_refused(self):
        self.write("in.off", off_text(torus()))
        number = len(torus()[0])
        for text in ("1 2 3", "1 " * (number - 1) + "0", "1 " * (number - 1) + "x",
                     "1 " * (number - 1) + "-1", ""):
            self.write("bad.txt", text)
            with self.subTest(text[-8:]):
                self.refuse(3, "bad.txt: ", "simplify", "in.off", "-o", "out.off", "-t", "1%",
                            "--tolerance-field", "bad.txt")

    def test_target_faces_needs_no_tolerance(self):
        self.write("in.off", off_text(torus()))
        report = self.report("simplify", "in.off", "-o", "out.off", "--target-faces", "200")
        self.assertLessEqual(report["output"]["faces"], 200)
        self.assertTrue(report["certificate"]["holds"])

    def test_threads_and_stages(self):
        alone = self.faces(torus(), "-t", "2%", "--threads", "1")
        self.assertEqual(alone, self.faces(torus(), "-t", "2%", "--threads", "2"))
        self.assertLess(self.faces(torus(), "-t", "2%", "--stages", "3"), len(torus()[1]))

    def test_effort_fast_keeps_vertices_of_the_input(self):
        self.faces(torus(), "-t", "2%", "--effort", "fast", "--placement", "on-surface")
        points, _ = read_off(self.folder / "out.off")
        self.assertLessEqual(set(points), set(torus()[0]))

    def test_placement_free_leaves_fewer_faces(self):
        for effort in ("fast", "default"):
            with self.subTest(effort):
                on_surface = self.faces(torus(), "-t", "2%", "--effort", effort)
                same = self.faces(torus(), "-t", "2%", "--effort", effort,
                                  "--placement", "on-surface")
                free = self.faces(torus(), "-t", "2%", "--effort", effort, "--placement", "free")
                self.assertEqual(on_surface, same)
                self.assertLess(free, on_surface)

    def test_effort_leaves_fewer_faces(self):
        self.write("in.off", off_text(torus()))
        for placement in ("on-surface", "free"):
            reports = [
                self.report("simplify", "in.off", "-o", "out.off", "-t", "2%", "--effort", effort,
                            "--placement", placement)
                for effort in ("fast", "default", "best")]
            fast, default, best = (report["output"]["faces"] for report in reports)
            self.assertLess(default, fast)
            self.assertLessEqual(best, default)
            relocations = [report["operations"]["performed"]["relocation"] for report in reports]
            self.assertEqual(relocations[0], 0)
            self.assertGreater(relocations[1], 0)
            self.assertGreater(relocations[2], relocations[1])

    def test_target_faces_is_where_it_stops(self):
        self.write("in.off", off_text(torus()))
        fewest = self.report("simplify", "in.off", "-o", "out.off", "-t", "2%")
        report = self.report("simplify", "in.off", "-o", "out.off", "-t", "2%",
                             "--target-faces", "400")
        self.assertLess(fewest["output"]["faces"], 300)
        self.assertIn(report["output"]["faces"], (399, 400))
        self.assertLess(report["certificate"]["bound"], fewest["certificate"]["bound"])
        self.assertEqual(report["parameters"]["target_faces"], 400)

    def test_report_tells_the_parameters(self):
        self.write("in.off", off_text(torus()))
        defaults = self.report("simplify", "in.off", "-o", "out.off", "-t", "2%")["parameters"]
        self.assertEqual(defaults["placement"], "on-surface")
        self.assertEqual(defaults["effort"], "default")
        self.assertEqual(defaults["bound"], "direct")
        self.assertEqual(defaults["target_faces"], 0)
        chosen = self.report("simplify", "in.off", "-o", "out.off", "-t", "2%", "--placement",
                             "free", "--effort", "fast", "--shape-floor", "20")["parameters"]
        self.assertEqual(chosen["placement"], "free")
        self.assertEqual(chosen["effort"], "fast")
        self.assertEqual(chosen["shape_floor"], 20)

    def test_accumulated_bound_does_not_place_freely(self):
        self.write("in.off", off_text(torus()))
        self.refuse(USAGE, "--placement: the accumulated bound", "simplify", "in.off", "-o",
                    "out.off", "-t", "2%", "--bound", "accumulated", "--placement", "free")

    def test_triangulate_splits_polygons(self):
        self.write("in.off", off_text(cube()))
        report = self.report("simplify", "in.off", "-o", "out.off", "-t", "1%", "--triangulate",
                             "--certificate", "out.cert")
        self.assertEqual(report["input"]["faces"], 12)
        self.succeed("verify", "in.off", "out.off", "out.cert", "--triangulate")
        self.succeed("compare", "in.off", "out.off", "--triangulate")
        self.succeed("info", "in.off", "--triangulate")


class Formats(Case):
    def test_every_input_gives_the_same_result(self):
        mesh = single_precision(torus())
        counts = set()
        for name, writer in WRITERS.items():
            with self.subTest(name):
                self.write(name, writer(mesh))
                report = self.report("simplify", name, "-o", "out.off", "-t", "1%",
                                     "--certificate", "out.cert")
                self.assertEqual(report["input"]["vertices"], len(mesh[0]))
                self.succeed("verify", name, "out.off", "out.cert")
                counts.add(report["output"]["faces"])
        self.assertLess(max(counts) - min(counts), 0.05 * max(counts))

    def test_certificates_hold_for_every_output_that_keeps_numbers(self):
        self.write("in.off", off_text(torus()))
        for kind in ("off", "obj", "ply"):
            with self.subTest(kind):
                self.succeed("simplify", "in.off", "-o", f"out.{kind}", "-t", "1%",
                             "--certificate", f"{kind}.cert")
                self.succeed("verify", "in.off", f"out.{kind}", f"{kind}.cert")

    def test_coordinates_survive_every_format(self):
        # Coordinates with all 53 bits, huge and tiny, far from and near the origin.
        for factor in (1 / 3, 1e30 / 7, 1e-30 / 7):
            mesh = scaled(torus(12, 6), factor)
            self.write("in.off", off_text(mesh))
            for kind in ("off", "obj", "ply", "stl"):
                with self.subTest(kind=kind, factor=factor):
                    self.succeed("simplify", "in.off", "-o", f"out.{kind}", "-t", "1e-9%")
                    self.succeed("simplify", f"out.{kind}", "-o", "back.off", "-t", "1e-9%")
                    points, _ = read_off(self.folder / "back.off")
                    self.assertEqual(sorted(points), sorted(mesh[0]))

    def test_stl_is_binary_only_if_that_is_exact(self):
        self.write("in.off", off_text(single_precision(torus())))
        self.succeed("simplify", "in.off", "-o", "out.stl", "-t", "1%")
        self.assertNotEqual((self.folder / "out.stl").read_bytes()[:5], b"solid")
        self.write("in.off", off_text(torus()))
        self.succeed("simplify", "in.off", "-o", "out.stl", "-t", "1%")
        self.assertEqual((self.folder / "out.stl").read_bytes()[:5], b"solid")

    def test_stl_of_moved_vertices_is_certified_as_it_is_stored(self):
        mesh = single_precision(torus())
        self.write("in.off", off_text(mesh))
        self.write("in.stl", stl_bytes(mesh))
        for name in ("in.off", "in.stl"):
            for placement in ("on-surface", "free"):
                with self.subTest(name=name, placement=placement):
                    report = self.report(
                        "simplify", name, "-o", "out.stl", "-t", "1%", "--placement", placement)
                    self.assertGreater(report["operations"]["performed"]["relocation"], 0)
                    data = (self.folder / "out.stl").read_bytes()
                    faces = report["output"]["faces"]
                    self.assertEqual(len(data), 84 + 50 * faces, "not binary STL")
                    tolerance = report["certificate"]["tolerance"]
                    self.succeed("compare", name, "out.stl", "-t", repr(tolerance))
                    # Nothing was rounded when it was written.
                    self.succeed("simplify", "out.stl", "-o", "back.off", "-t", "1e-9%")
                    points, _ = read_off(self.folder / "back.off")
                    self.assertEqual(set(points), set(single_precision((points, []))[0]))
        # In double precision it goes to text, and certificates to formats that number vertices.
        self.write("in.off", off_text(torus()))
        report = self.report("simplify", "in.off", "-o", "out.stl", "-t", "1%")
        self.assertEqual((self.folder / "out.stl").read_bytes()[:5], b"solid")
        self.succeed("compare", "in.off", "out.stl", "-t", repr(report["certificate"]["tolerance"]))

    def test_every_method_is_verified_in_every_format_that_keeps_numbers(self):
        for name, mesh in {"single.off": single_precision(torus()), "double.off": torus()}.items():
            self.write(name, off_text(mesh))
            for kind in ("off", "obj", "ply"):
                for placement, effort in (("on-surface", "fast"), ("on-surface", "default"),
                                          ("free", "fast"), ("free", "default")):
                    with self.subTest(name=name, kind=kind, placement=placement, effort=effort):
                        self.succeed("simplify", name, "-o", f"out.{kind}", "-t", "1%",
                                     "--placement", placement, "--effort", effort,
                                     "--certificate", "out.cert")
                        self.succeed("verify", name, f"out.{kind}", "out.cert")

    def test_ply_and_vtp_carry_the_deviation(self):
        self.write("in.off", off_text(torus()))
        report = self.report("simplify", "in.off", "-o", "out.ply", "-t", "1%")
        header = (self.folder / "out.ply").read_bytes().split(b"end_header")[0].decode()
        for name in ("double deviation", "double quality", "uchar red"):
            self.assertIn("property " + name, header)
        self.succeed("simplify", "in.off", "-o", "out.vtp", "-t", "1%")
        text = (self.folder / "out.vtp").read_text()
        values = re.search(r'Name="deviation"[^>]*>([^<]*)<', text).group(1).split()
        self.assertEqual(len(values), report["output"]["faces"])
        self.assertLessEqual(max(map(float, values)), report["certificate"]["tolerance"])
        self.assertGreaterEqual(min(map(float, values)), 0)
        self.assertIn('Name="quality"', text)
        self.assertIn('Name="connectivity" NumberOfComponents="1"', text)

    def test_dialects(self):
        mesh = torus(12, 6)
        obj, stl = obj_text(mesh), stl_text(single_precision(mesh))
        ply = ply_text(mesh)
        textured = re.sub(r"(\d+)(?= |$)", r"\1/\1/\1", obj.split("f ", 1)[1].replace("f ", ""))
        textured = "".join("f " + line + "\n" for line in textured.splitlines())
        dialects = {
            "comments.off": off_text(mesh).replace("OFF\n", "OFF # a torus\n# sizes\n\n"),
            "windows.off": off_text(mesh).replace("\n", "\r\n"),
            "windows.obj": obj.replace("\n", "\r\n"),
            "windows.stl": stl.replace("\n", "\r\n"),
            "tabs.obj": obj.replace(" ", "\t"),
            "lines.obj": "mtllib x.mtl\no torus\nvn 0 0 1\nvt 0 0\n" + obj + "l 1 2\n",
            "textures.obj": obj.split("f ", 1)[0] + textured,
            "upper.stl": stl.upper(),
            "named.STL": stl_bytes(mesh, b"solid or not"),
            "trailing.stl": stl_bytes(mesh) + b"\0\0\0\0",
            "comment.ply": ply.replace("element vertex", "comment element vertex 5\nelement vertex"),
        }
        for name, content in dialects.items():
            with self.subTest(name):
                self.write(name, content)
                report = self.report("info", name)
                self.assertEqual(report["input"]["faces"], len(mesh[1]))
                self.assertEqual(report["input"]["vertices"], len(mesh[0]))

    def test_unconnected_triangles_are_stitched(self):
        points, faces = torus(12, 6)
        soup = [points[v] for f in faces for v in f], [
            (3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(faces))]
        for name in ("in.off", "in.obj", "in.ply"):
            self.write(name, WRITERS[name](soup))
            report = self.report("info", name)
            self.assertEqual(report["input"]["vertices"], len(points))
            self.assertEqual(report["input"]["border_edges"], 0)

    def test_inconsistent_orientation_is_mended(self):
        points, faces = torus(12, 6)
        turned = [tuple(reversed(f)) if i % 5 == 0 else f for i, f in enumerate(faces)]
        self.write("in.off", off_text((points, turned)))
        report = self.report("simplify", "in.off", "-o", "out.off", "-t", "1%",
                             "--certificate", "out.cert")
        self.assertEqual(report["output"]["genus"], 1)
        self.succeed("verify", "in.off", "out.off", "out.cert")


class Bad_input(Case):
    """Bad files are refused with status 3 and a message that names the element and the remedy."""

    def check(self, name, content, message):
        self.write(name, content)
        for command in (("simplify", name, "-o", "out.off", "-t", "1%", "--report", "out.json"),
                        ("info", name, "--report", "out.json")):
            result = self.refuse(BAD_INPUT, message, *command)
            self.assertIn(name, result.stderr)
            self.assertEqual(result.stdout, "")

    def test_missing_file(self):
        self.refuse(BAD_INPUT, "no such file", "simplify", "no.off", "-o", "out.off", "-t", "1%")

    def test_folder(self):
        (self.folder / "folder.off").mkdir()
        self.refuse(BAD_INPUT, "folder", "simplify", "folder.off", "-o", "out.off", "-t", "1%")

    def test_unknown_format(self):
        self.check("mesh.step", "ISO-10303-21;", "format 'step'")
        self.check("mesh", off_text(torus()), "format ''")

    def test_empty_file(self):
        for kind in ("off", "obj", "ply", "stl"):
            self.check("in." + kind, "", "empty")

    def test_no_faces(self):
        self.check("in.off", "OFF\n0 0 0\n", "no faces")
        self.check("points.off", "OFF\n1 0 0\n0 0 0\n", "no faces")
        self.check("in.stl", "solid a\nendsolid a\n", "no faces")
        self.check("in.ply", ply_text(([], [])), "no faces")
        self.check("in.obj", "# nothing\n", "not a complete OBJ")

    def test_garbage(self):
        noise = bytes((37 * i * i + 11 * i) % 256 for i in range(5000))
        for kind in ("off", "obj", "ply", "stl"):
            self.check("in." + kind, noise, "not a complete|no faces|no such|promises")
            self.check("text." + kind, "Hello, world.\n" * 20, "not a complete")

    def test_wrong_format(self):
        self.check("in.ply", off_text(torus()), "not a complete PLY")
        self.check("in.stl", off_text(torus()), "not a complete STL")
        self.check("in.off", stl_bytes(torus()), "not a complete OFF")

    def test_truncated_files(self):
        mesh = single_precision(torus(12, 6))
        for name, writer in WRITERS.items():
            if name == "in.obj":
                continue  # says nowhere how long it is
            content = writer(mesh)
            content = content.encode() if isinstance(content, str) else content
            for part in (0.1, 0.5, 0.9):
                with self.subTest(name=name, part=part):
                    self.check(name, content[: int(part * len(content))], "not a complete")

    def test_truncated_obj_is_noticed_where_it_shows(self):
        text = obj_text(torus(12, 6))
        self.check("in.obj", text[: text.index("f ") + 5], "corners|isolated")
        self.check("faces.obj", text[text.index("f ") :], "does not exist|not a complete")

    def test_huge_counts(self):
        for vertices, faces in ((4000000000, 12), (8, 4000000000), (10**17, 10**17)):
            self.check("in.off", f"OFF\n{vertices} {faces} 0\n0 0 0\n", "promises")
            header = ply_header(torus(), "ascii").replace("vertex 288", f"vertex {vertices}")
            self.check("in.ply", header.replace("face 576", f"face {faces}") + "0 0 0\n", "promises")
        self.check("overflow.off", "OFF\n99999999999999999999 1 0\n0 0 0\n", "not a complete|hold")
        self.check("corners.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n",
                   "larger than the file|not a complete")
        self.check("in.stl", b" " * 80 + struct.pack("<I", 4000000000) + bytes(50), "not a complete")

    def test_coordinates_that_are_not_finite(self):
        mesh = torus(12, 6)
        for word in ("nan", "-nan", "inf", "-inf", "1e999"):
            for name in ("in.off", "in.obj", "in.ply", "in.stl"):
                text = WRITERS[name](mesh)
                number = repr(mesh[0][5][1])
                with self.subTest(name=name, word=word):
                    self.check(name, text.replace(number, word, 1), rf"line \d+.*{word}.*finite")
        for value in (math.nan, math.inf):
            points = list(mesh[0])
            points[7] = (0, value, 0)
            self.check("binary.ply", ply_bytes((points, mesh[1])), "vertex 7.*not finite")
            self.check("binary.stl", stl_bytes((points, mesh[1])), r"face \d+ are not finite")

    def test_polygons(self):
        self.check("in.off", off_text(cube()), "face 0 has 4 corners.*--triangulate")

    def test_faces_with_too_few_corners(self):
        points, faces = torus(12, 6)
        self.check("in.off", off_text((points, faces[:20] + [(0, 1)] + faces[20:])),
                   "face 20 has 2 corners")

    def test_indices_out_of_range(self):
        points, faces = torus(12, 6)
        broken = (points, faces[:7] + [(0, 1, len(points))] + faces[7:])
        self.check("in.off", off_text(broken), "not a complete|does not exist")
        self.check("in.obj", obj_text(broken), "face 7.*does not exist")
        self.check("in.ply", ply_text(broken), "face 7.*does not exist")
        negative = (points, faces[:7] + [(0, 1, -5)] + faces[7:])
        self.check("negative.off", off_text(negative), "not a complete|does not exist")
        self.check("negative.ply", ply_text(negative), "face 7.*does not exist")
        self.check("zero.obj", obj_text(torus(12, 6)) + "f 0 1 2\n", "does not exist")

    def test_degenerate_faces(self):
        points, faces = torus(12, 6)
        self.check("twice.off", off_text((points, faces + [(3, 3, 4)])),
                   "face 144 is degenerate.*vertex 3")
        flat = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (1, 1, 0)], [(0, 1, 2), (0, 3, 1), (1, 3, 2)]
        self.check("flat.off", off_text(flat), "face 0")
        same = [(0, 0, 0), (1, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 1, 2), (0, 3, 1)]
        self.check("same.off", off_text(same), "face 0")
        self.check("flat.stl", stl_bytes(([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)])), "face 0")

    def test_duplicate_faces(self):
        points, faces = torus(12, 6)
        twice = faces[:9] + [faces[4]] + faces[9:]
        self.check("in.off", off_text((points, twice)), "faces? 4 and face 9 have the same vertices")
        self.check("turned.off", off_text(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (2, 1, 0)])),
                   "face 0 and face 1 have the same vertices")

    def test_non_manifold_edge(self):
        fins = [(0, 0, 0), (0, 0, 1), (1, 0, 0), (0, 1, 0), (-1, -1, 0)], [
            (0, 1, 2), (0, 1, 3), (0, 1, 4)]
        self.check("in.off", off_text(fins),
                   r"vertex 0 \(0 0 0\) to vertex 1 \(0 0 1\) is not manifold: 3 faces")

    def test_non_manifold_vertex(self):
        bow = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 0, 0), (-1, -1, 0)], [(0, 1, 2), (0, 3, 4)]
        self.check("in.off", off_text(bow), r"vertex 0 \(0 0 0\) is not manifold")
        a, b = torus(8, 4), torus(8, 4)
        # Two closed surfaces that share a vertex.
        shifted = [(x + 6, y, z) for x, y, z in b[0]]
        joined = a[0] + shifted, a[1] + [
            tuple(0 if v == 0 else v + len(a[0]) for v in f) for f in b[1]]
        joined[0].pop(len(a[0]))
        faces = [tuple(v if v < len(a[0]) else v - 1 for v in f) for f in joined[1]]
        self.check("tori.off", off_text((joined[0], faces)), "vertex 0 .*is not manifold")

    def test_moebius_strip(self):
        n = 12
        points = []
        for i in range(n):
            u = 2 * math.pi * i / n
            for w in (-0.4, 0.4):
                r = 2 + w * math.cos(u / 2)
                points.append((r * math.cos(u), r * math.sin(u), w * math.sin(u / 2)))
        faces = []
        for i in range(n):
            a, b = 2 * i, 2 * i + 1
            c, d = (2 * i + 2, 2 * i + 3) if i + 1 < n else (1, 0)
            faces += [(a, c, d), (a, d, b)]
        self.check("in.off", off_text((points, faces)), r"one side only.*\(.*\)")

    def test_isolated_vertex(self):
        points, faces = torus(12, 6)
        self.check("in.off", off_text((points + [(1, 2, 3)], faces)),
                   r"vertex 72 \(1 2 3\) is isolated.*remove")


class Hostile_parameters(Case):
    def setUp(self):
        super().setUp()
        self.write("in.off", off_text(torus()))

    def simplify(self, message, *arguments, status=USAGE):
        return self.refuse(status, message, "simplify", "in.off", *arguments)

    def test_tolerances(self):
        for text in ("0", "0%", "-1", "-0.1%", "nan", "nan%", "inf", "-inf", "1e999", "", "%", " ",
                     "0.1%%", "% 0.1", "0.1 %", " 0.1", "0.1 ", "1,5", "0x10", "1e", "1e-400", "abc",
                     "1mm", "--1", "1.2.3", "0.1%1"):
            with self.subTest(text):
                self.simplify("--tolerance|-t", "-o", "out.off", "-t", text)
        self.simplify("more than the whole diagonal", "-o", "out.off", "-t", "200%")
        for text in ("1e308", "100000"):
            self.simplify("longer than the diagonal", "-o", "out.off", "-t", text)

    def test_extreme_tolerances_that_make_sense(self):
        self.succeed("simplify", "in.off", "-o", "out.off", "-t", "100%")
        for text in ("1e-9%", "1e-12"):
            report = self.report("simplify", "in.off", "-o", "out.off", "-t", text)
            self.assertEqual(report["output"]["faces"], report["input"]["faces"])

    def test_missing_and_unknown_arguments(self):
        self.refuse(USAGE, "subcommand")
        self.refuse(USAGE, "subcommand", "nonsense")
        self.refuse(USAGE, "IN", "simplify")
        self.refuse(USAGE, "output", "simplify", "in.off", "-t", "1%")
        self.refuse(USAGE, "tolerance", "simplify", "in.off", "-o", "out.off")
        self.simplify("nonsense", "-o", "out.off", "-t", "1%", "--nonsense")
        self.simplify("extra.off", "extra.off", "-o", "out.off", "-t", "1%")
        self.simplify("placement", "-o", "out.off", "-t", "1%", "--placement", "anywhere")
        self.simplify("bound", "-o", "out.off", "-t", "1%", "--bound", "none")
        for length in ("0", "-1", "nan", "200%", "x"):
            self.simplify("ridge-tolerance", "-o", "out.off", "-t", "1%", "--ridge-tolerance",
                          length)
        self.simplify("ridge-tolerance", "-o", "out.off", "-t", "1%", "--ridge-tolerance", "0.1%",
                      "--bound", "accumulated")

    def test_controls_out_of_range(self):
        for flag, values in {
            "--feature-angle": ("-1", "181", "nan", "abc", "inf"),
            "--corner-angle": ("-1", "181", "nan"),
            "--roughness-angle": ("-1", "0", "181", "nan"),
            "--shape-ratio": ("0", "0.5", "-1", "nan"),
            "--shape-floor": ("0", "0.5", "-1", "nan"),
            "--flip-rounds": ("-1", "1.5", "nan", "99999999999"),
            "--target-faces": ("-1", "1.5", "nan", "inf", "99999999999", "many"),
            "--smoothing": ("-1", "1.5", "nan", "99999999999"),
            "--effort": ("", "standard", "fastest", "1.5"),
        }.items():
            for value in values:
                with self.subTest(flag=flag, value=value):
                    self.simplify(flag, "-o", "out.off", "-t", "1%", flag, value)

    def test_outputs_that_cannot_be_written(self):
        (self.folder / "folder").mkdir()
        (self.folder / "folder.off").mkdir()
        read_only = self.write("read_only.off", "precious")
        read_only.chmod(0o444)
        (self.folder / "link.off").symlink_to("in.off")
        self.simplify("format", "-o", "out.step", "-t", "1%")
        self.simplify("format", "-o", "out", "-t", "1%")
        self.simplify("format", "-o", "", "-t", "1%")
        self.simplify("folder", "-o", "folder.off", "-t", "1%")
        self.simplify("format|folder", "-o", "folder/", "-t", "1%")
        self.simplify("no folder", "-o", "missing/out.off", "-t", "1%")
        self.simplify("write-protected", "-o", "read_only.off", "-t", "1%")
        self.simplify("replace an input", "-o", "in.off", "-t", "1%")
        self.simplify("replace an input", "-o", "./folder/../in.off", "-t", "1%")
        self.simplify("replace an input", "-o", "link.off", "-t", "1%")
        self.simplify("not a regular file", "-o", "out.off", "-t", "1%", "--report", "/dev/null")
        self.simplify("folder", "-o", "out.off", "-t", "1%", "--report", "folder")
        self.simplify("two outputs", "-o", "out.off", "-t", "1%", "--report", "out.off")
        self.simplify("two outputs", "-o", "out.off", "-t", "1%", "--certificate", "x",
                      "--report", "x")
        self.simplify("replace an input", "-o", "out.off", "-t", "1%", "--certificate", "in.off")
        self.simplify("no folder", "-o", "out.off", "-t", "1%", "--certificate", "missing/x")

    def test_folder_that_cannot_be_written_to(self):
        if os.geteuid() == 0:
            self.skipTest("root may write anywhere")
        folder = self.folder / "closed"
        folder.mkdir()
        folder.chmod(0o555)
        self.simplify("cannot be written to", "-o", "closed/out.off", "-t", "1%")
        folder.chmod(0o755)

    def test_certificates_that_cannot_be_written(self):
        for kind in ("stl", "vtp"):
            self.simplify("by number", "-o", "out." + kind, "-t", "1%", "--certificate", "x")
        self.simplify("accumulated", "-o", "out.off", "-t", "1%", "--certificate", "x",
                      "--bound", "accumulated")

    def test_full_disk(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full")
        self.simplify("not a regular file", "-o", "out.off", "-t", "1%", "--report", "/dev/full")


class Verify(Case):
    def setUp(self):
        super().setUp()
        self.write("in.off", off_text(torus()))
        self.succeed("simplify", "in.off", "-o", "out.off", "-t", "1%", "--certificate", "out.cert")

    def test_holds(self):
        result = self.succeed("verify", "in.off", "out.off", "out.cert", "--report", "r.json")
        self.assertIn("holds", result.stdout)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["certificate"]["holds"])
        self.assertLessEqual(report["certificate"]["bound"], report["certificate"]["tolerance"])
        quiet = self.succeed("verify", "in.off", "out.off", "out.cert", "--quiet")
        self.assertEqual(quiet.stdout + quiet.stderr, "")

    def not_held(self, *files):
        result = self.run_surety("verify", *files)
        self.assertEqual(result.returncode, NOT_CERTIFIED, result.stderr + result.stdout)
        self.assertIn("does not hold", result.stdout)

    def test_does_not_hold_for_other_meshes(self):
        points, faces = read_off(self.folder / "out.off")
        moved = [(x, y, z + (0.5 if i == 3 else 0)) for i, (x, y, z) in enumerate(points)]
        self.write("moved.off", off_text((moved, faces)))
        self.not_held("in.off", "moved.off", "out.cert")
        self.write("fewer.off", off_text(torus(8, 4)))
        self.not_held("in.off", "fewer.off", "out.cert")
        self.not_held("out.off", "in.off", "out.cert")
        self.not_held("in.off", "in.off", "out.cert")

    def test_bad_certificate_files(self):
        text = (self.folder / "out.cert").read_text()
        lines = text.splitlines(keepends=True)
        for name, content in {
            "empty": "",
            "garbage": "Hello, world.\n",
            "binary": bytes(range(256)) * 10,
            "truncated": "".join(lines[: len(lines) // 2]),
            "mesh": off_text(torus()),
        }.items():
            with self.subTest(name):
                self.write("bad.cert", content)
                self.refuse(BAD_INPUT, "bad.cert", "verify", "in.off", "out.off", "bad.cert")
        self.refuse(BAD_INPUT, "no.cert", "verify", "in.off", "out.off", "no.cert")
        self.refuse(BAD_INPUT, "no such file", "verify", "in.off", "no.off", "out.cert")
        self.refuse(USAGE, "CERTIFICATE", "verify", "in.off", "out.off")


class Compare(Case):
    def setUp(self):
        super().setUp()
        self.write("a.off", off_text(torus()))
        points, faces = torus()
        self.write("b.off", off_text(([(x, y, z + 0.25) for x, y, z in points], faces)))

    def test_interval_holds_the_distance(self):
        # A plane and its copy at a distance of 0.25: the truth is known.
        flat = grid(8, lambda x, y: 0)
        self.write("a.off", off_text(flat))
        self.write("b.off", off_text(([(x, y, 0.25) for x, y, _ in flat[0]], flat[1])))
        report = self.report("compare", "a.off", "b.off", "--accuracy", "0.01%")
        for way in ("A_to_B", "B_to_A"):
            interval = report["distance"][way]
            self.assertLessEqual(interval["lower"], 0.25)
            self.assertGreaterEqual(interval["upper"], 0.25)
            self.assertLess(interval["upper"] - interval["lower"], 2e-4)
            self.assertEqual(len(interval["witness"]["point"]), 3)
        self.assertIn("Hausdorff distance", self.succeed("compare", "a.off", "b.off").stdout)

    def test_certificate_of_two_meshes_is_checked(self):
        tolerance = ("-t", "0.26", "--certificate", "ab.cert")
        report = self.report("compare", "a.off", "b.off", *tolerance)
        self.assertTrue(report["certificate"]["written"])
        checked = self.report("verify", "a.off", "b.off", "ab.cert")
        self.assertEqual(checked["certificate"]["kind"], "covering")
        self.assertTrue(checked["certificate"]["holds"])
        self.assertLessEqual(checked["certificate"]["bound"], 0.26)
        other = self.run_surety("verify", "a.off", "a.off", "ab.cert")
        self.assertEqual(other.returncode, 4)
        self.assertIn("does not hold", other.stdout)
        (self.folder / "cut.cert").write_text((self.folder / "ab.cert").read_text()[:500])
        self.refuse(BAD_INPUT, "ends too early", "verify", "a.off", "b.off", "cut.cert")

    def test_no_certificate_is_written_of_meshes_too_far_apart(self):
        refuted = self.run_surety("compare", "a.off", "b.off", "-t", "0.2", "--certificate", "c")
        self.assertEqual(refuted.returncode, 4)
        self.assertFalse((self.folder / "c").exists())
        self.refuse(USAGE, "--tolerance", "compare", "a.off", "b.off", "--certificate", "c")
        self.refuse(USAGE, "replace an input", "compare", "a.off", "b.off", "-t", "1",
                    "--certificate", "b.off")

    def test_needle_is_seen_in_one_direction(self):
        flat = grid(8, lambda x, y: 0)
        needle = grid(8, lambda x, y: 1 if (x, y) == (0.5, 0.5) else 0)
        self.write("a.off", off_text(flat))
        self.write("b.off", off_text(needle))
        report = self.report("compare", "a.off", "b.off")
        self.assertAlmostEqual(report["distance"]["B_to_A"]["upper"], 1, delta=1e-3)
        self.assertEqual(report["distance"]["B_to_A"]["witness"]["mesh"], "B")
        self.assertLess(report["distance"]["A_to_B"]["upper"], 0.2)

    def test_takes_triangles_that_are_no_mesh(self):
        # What other programs write need not be a manifold; its distance is defined all the same.
        points, faces = torus()
        for name, extra in {"twice": [faces[0]], "degenerate": [(0, 1, 1)],
                            "fins": [(0, 1, 5), (0, 1, 7)]}.items():
            with self.subTest(name):
                self.write("c.off", off_text((points, faces + extra)))
                report = self.report("compare", "a.off", "c.off", "-t", "50%")
                self.assertTrue(report["certificate"]["holds"])
        self.write("c.off", off_text((points, [(0, 1, 99999)])))
        self.refuse(BAD_INPUT, "not a complete|not exist", "compare", "a.off", "c.off")
        self.write("d.off", off_text(cube()))
        self.refuse(BAD_INPUT, "--triangulate", "compare", "a.off", "d.off")

    def test_tolerance_is_proven_or_refuted(self):
        proven = self.succeed("compare", "a.off", "b.off", "-t", "0.26")
        self.assertIn("proven", proven.stdout)
        refuted = self.run_surety("compare", "a.off", "b.off", "-t", "0.2", "--report", "r.json")
        self.assertEqual(refuted.returncode, NOT_CERTIFIED)
        self.assertIn("refuted", refuted.stdout)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertGreater(report["certificate"]["witness"]["distance_lower_bound"], 0.2)
        same = self.report("compare", "a.off", "a.off", "-t", "1e-6%")
        self.assertTrue(same["certificate"]["holds"])

    def test_hostile_arguments(self):
        for flag in ("-t", "--accuracy"):
            for text in ("0", "-1", "nan", "200%", "1e308"):
                with self.subTest(flag=flag, text=text):
                    self.refuse(USAGE, "tolerance|accuracy", "compare", "a.off", "b.off", flag, text)
        self.refuse(USAGE, "B", "compare", "a.off")
        self.refuse(USAGE, "replace an input", "compare", "a.off", "b.off", "--report", "b.off")


class Info(Case):
    def test_tells_topology_and_features(self):
        self.write("cube.off", off_text(split(cube())))
        report = self.report("info", "cube.off")
        self.assertEqual(report["input"]["genus"], 0)
        self.assertEqual(report["features"]["ridge_edges"], 12)
        self.assertEqual(report["features"]["corners"], 8)
        report = self.report("info", "cube.off", "--feature-angle", "180")
        self.assertEqual(report["features"]["ridge_edges"], 0)
        self.write("open.off", off_text(grid(4)))
        report = self.report("info", "open.off", "--corner-angle", "60")
        self.assertEqual(report["features"]["border_edges"], 16)
        self.assertEqual(report["features"]["corners"], 4)
        report = self.report("info", "open.off", "--corner-angle", "180")
        self.assertEqual(report["features"]["corners"], 0)

    def test_counts_self_intersections(self):
        points, faces = grid(4, lambda x, y: 0)
        crossing = [(x, 0.5 + 0 * y, y - 0.45) for x, y, _ in points]
        offset = len(points)
        both = points + crossing, faces + [tuple(v + offset for v in f) for f in faces]
        self.write("in.off", off_text(both))
        self.assertGreater(self.report("info", "in.off")["input"]["self_intersections"], 0)
        quiet = self.succeed("info", "in.off", "--quiet")
        self.assertEqual(quiet.stdout, "")


class Help(Case):
    def test_every_command_has_an_example(self):
        self.assertIn("Example", self.succeed("--help").stdout)
        for command in ("simplify", "compare", "verify", "info"):
            self.assertIn(f"Example: surety {command}", self.succeed(command, "--help").stdout)

    def test_version_is_the_header_s(self):
        header = Path(__file__).parent.parent / "include/surety/version.h"
        version = re.search(r'VERSION_STRING "([^"]+)"', header.read_text()).group(1)
        self.assertEqual(self.succeed("--version").stdout, f"surety {version}\n")


@unittest.skipUnless(DATA and os.path.isdir(DATA), "SURETY_DATA_DIR is not set")
class Real_models(Case):
    def test_scans_and_parts(self):
        for name in ("fandisk", "elephant", "rotor_small", "holes"):
            with self.subTest(name):
                model = Path(DATA) / f"{name}.off"
                report = self.report("simplify", model, "-o", "out.off", "-t", "0.1%",
                                     "--certificate", "out.cert")
                self.assertLess(report["output"]["faces"], report["input"]["faces"])
                self.assertLessEqual(report["output"]["self_intersections"],
                                     report["input"]["self_intersections"])
                self.succeed("verify", model, "out.off", "out.cert")
                self.succeed("compare", model, "out.off", "-t", "0.1%")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
