# SPDX-License-Identifier: GPL-3.0-or-later
#
# The HTML report, from outside: one file that needs nothing else, small, with all that the JSON
# report has; a browser shows it without a complaint, and shows the meshes.
import base64
import json
import math
import os
import re
import shutil
import struct
import subprocess
import unittest
import zlib
from html.parser import HTMLParser

from command_runs import Runs
from info_runs import USAGE, off_text, sphere

# Without three.js the program must say so.
HAS_VIEWER = os.environ.get("SURETY_HAS_VIEWER", "1") == "1"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


class Page(HTMLParser):
    """What a page has: addresses, elements of data, and the text of scripts and styles."""

    def __init__(self, text):
        super().__init__()
        self.addresses, self.data, self.code, self.inside = [], {}, "", None
        self.tags = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.tags.append(tag)
        self.addresses += [named[name] for name in ("src", "href", "srcset") if name in named]
        self.inside = named.get("id", tag) if tag in ("script", "style") else None

    def handle_endtag(self, tag):
        self.inside = None

    def handle_data(self, text):
        if self.inside in ("report", "views"):
            self.data[self.inside] = json.loads(text)
        elif self.inside:
            self.code += text


def bumpy(side):
    """A closed torus of 2 * side * side faces that is smooth nowhere."""
    points, faces = [], []
    for i in range(side):
        for j in range(side):
            u, v = 2 * math.pi * i / side, 2 * math.pi * j / side
            r = .4 + .01 * math.sin(40 * u) * math.sin(30 * v)
            points.append(((1 + r * math.cos(v)) * math.cos(u), (1 + r * math.cos(v)) * math.sin(u),
                           r * math.sin(v)))
            a, b = i * side + j, (i + 1) % side * side + j
            c, d = (i + 1) % side * side + (j + 1) % side, i * side + (j + 1) % side
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def pixels(file):
    """Rows of RGB bytes of a PNG as Chromium writes it: 8 bits, not interlaced."""
    raw, data, at = file.read_bytes(), b"", 8
    while at < len(raw):
        size, kind = struct.unpack(">I4s", raw[at:at + 8])
        body = raw[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlace = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and color in (2, 6) and not interlace
        if kind == b"IDAT":
            data += body
        at += size + 12
    step = 3 if color == 2 else 4
    data, rows, before = zlib.decompress(data), [], bytearray(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        row = bytearray(data[start + 1:start + 1 + width * step])
        for x in range(len(row)):
            a = row[x - step] if x >= step else 0
            b, c = before[x], before[x - step] if x >= step else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row[x] = row[x] + (0, a, b, (a + b) // 2, paeth)[data[start]] & 255
        rows.append([tuple(row[x:x + 3]) for x in range(0, len(row), step)])
        before = row
    return rows


def turned(indices):
    """Triangles, each from its least vertex on."""
    result = []
    for i in range(0, len(indices), 3):
        a, b, c = indices[i:i + 3]
        result.append(min((a, b, c), (b, c, a), (c, a, b)))
    return result


class Html_report(Runs):
    def setUp(self):
        super().setUp()
        (self.folder / "in.off").write_text(off_text(sphere()))

    def page(self, command="simplify", *arguments, file="in.off", tolerance="1%"):
        self.surety(command, file, "-o", "out.off", "-t", tolerance, "--report", "r.html",
                    "--quiet", *arguments)
        return Page((self.folder / "r.html").read_text())

    def browse(self, file, *arguments):
        """Chromium on a page, without a network; what it logs."""
        done = subprocess.run(
            [CHROMIUM, "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", f"--user-data-dir={self.folder}/profile",
             "--enable-logging=stderr", "--v=0", "--hide-scrollbars", "--no-first-run",
             "--host-resolver-rules=MAP * ~NOTFOUND", "--window-size=1200,800",
             "--virtual-time-budget=8000", *arguments, f"file://{self.folder}/{file}"],
            cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([line for line in done.stderr.splitlines() if "CONSOLE" in line], [])
        return done.stdout

    @unittest.skipIf(HAS_VIEWER, "three.js was there")
    def test_without_the_viewer_the_program_says_what_is_missing(self):
        done = self.surety("simplify", "in.off", "-o", "out.off", "-t", "1%", "--report", "r.html",
                           status=USAGE)
        self.assertIn("libjs-three", done.stderr)
        self.assertFalse((self.folder / "out.off").exists())

    def test_commands_that_have_nothing_to_show_refuse_a_page(self):
        for command in (("compare", "in.off", "in.off"), ("info", "in.off"),
                        ("verify", "in.off", "in.off", "in.cert"),
                        ("hierarchy", "in.off", "-o", "levels", "-t", "1%")):
            with self.subTest(command=command):
                done = self.surety(*command, "--report", "r.html", status=USAGE)
                self.assertIn("JSON only", done.stderr)
                self.assertFalse((self.folder / "r.html").exists())

    @unittest.skipUnless(HAS_VIEWER, "three.js was not there")
    def test_the_page_needs_nothing_else(self):
        page = self.page()
        self.assertEqual([a for a in page.addresses if a != "data:,"], [])
        self.assertNotRegex(page.code, r"@import|url\(\s*['\"]?http|importScripts\(['\"]http")
        self.assertTrue({"iframe", "object", "embed", "img"}.isdisjoint(page.tags))
        text = (self.folder / "r.html").read_text()
        self.assertIn("default-src 'none'", text)
        self.assertNotRegex(text, r"@(style|report|views|viewer|controls|script)@")

    @unittest.skipUnless(HAS_VIEWER, "three.js was not there")
    def test_the_page_has_what_the_json_has(self):
        points = sphere()[0]
        values = "\n".join(str(math.tanh(9 * p[2])) for p in points)
        (self.folder / "u.sol").write_text(
            f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{len(points)}\n1 1\n{values}\n"
            "End\n")
        field = ("--solution", "u.sol", "--target-vertices", "500")
        for command, flags in (("simplify", ()), ("remesh", ()), ("adapt", field)):
            with self.subTest(command=command):
                page = self.page(command, *flags).data["report"]
                self.surety(command, "in.off", "-o", "out.off", "-t", "1%", "--report", "r.json",
                            *flags)
                report = json.loads((self.folder / "r.json").read_text())
                del page["seconds"], report["seconds"]
                self.assertEqual(page, report)

    @unittest.skipUnless(HAS_VIEWER, "three.js was not there")
    def test_the_meshes_of_the_page_are_those_of_the_files(self):
        views = self.page().data["views"]
        for name, view in zip(("in.off", "out.off"), views):
            numbers = (self.folder / name).read_text().split()[1:]
            vertices, faces = int(numbers[0]), int(numbers[1])
            exact = [float(x) for x in numbers[3:3 + 3 * vertices]]
            positions = base64.b64decode(view["positions"])
            self.assertEqual(len(positions), 6 * vertices)
            for i, (q,) in enumerate(struct.iter_unpack("<H", positions)):
                self.assertAlmostEqual(view["origin"][i % 3] + q * view["step"], exact[i],
                                       delta=.51 * view["step"])
            wanted = [int(x) for i, x in enumerate(numbers[3 + 3 * vertices:]) if i % 4]
            indices = base64.b64decode(view["faces"])
            found = [i for (i,) in struct.iter_unpack("<H", indices)]
            self.assertEqual(turned(found), turned(wanted))
            self.assertEqual(sum(b["number"] for b in view["qualities"]), faces)
            for field in view["fields"]:
                self.assertEqual(len(base64.b64decode(field["values"])), faces)
        deviation = views[1]["fields"][0]
        self.assertEqual(deviation["name"], "deviation")
        self.assertFalse(deviation["is_clamped"])
        self.assertGreater(max(base64.b64decode(deviation["values"])), 0)

    @unittest.skipUnless(HAS_VIEWER, "three.js was not there")
    def test_large_meshes_are_shown_smaller_and_the_page_says_so(self):
        (self.folder / "large.off").write_text(off_text(bumpy(224)))  # 100,352 faces
        # Even if nothing could be left out.
        page = self.page(file="large.off", tolerance="0.0001%")
        self.assertGreater(page.data["report"]["output"]["faces"], 100000)
        self.assertLess((self.folder / "r.html").stat().st_size, 3e6)
        for view, faces in zip(page.data["views"], (
                100352, page.data["report"]["output"]["faces"])):
            self.assertLessEqual(len(base64.b64decode(view["faces"])) / 3 / view["index_bytes"],
                                 30000)
            self.assertIn(f"{faces:,} faces, shown by", view["note"])
            self.assertEqual(sum(b["number"] for b in view["qualities"]), faces)

    @unittest.skipUnless(HAS_VIEWER, "three.js was not there")
    def test_a_result_that_is_not_large_is_shown_with_its_values(self):
        (self.folder / "large.off").write_text(off_text(bumpy(196)))  # 76,832 faces
        page = self.page(file="large.off", tolerance="0.0001%")
        self.assertLess((self.folder / "r.html").stat().st_size, 3e6)
        after = page.data["views"][1]
        faces = page.data["report"]["output"]["faces"]
        self.assertGreater(faces, 70000)
        self.assertEqual(after["note"], f"{faces:,} faces")
        self.assertEqual(len(base64.b64decode(after["fields"][0]["values"])), faces)

    @unittest.skipUnless(HAS_VIEWER, "three.js was not there")
    def test_names_of_files_are_text(self):
        name = "<script>alert(1)<!--&amp;.off"
        shutil.copy(self.folder / "in.off", self.folder / name)
        page = self.page(file=name)
        self.assertEqual(page.data["report"]["input"]["file"], name)
        self.assertNotIn("<script>alert", (self.folder / "r.html").read_text())

    @unittest.skipUnless(HAS_VIEWER and CHROMIUM, "three.js or Chromium is not there")
    def test_a_browser_shows_it_without_a_complaint(self):
        name = "<b id=injected>.off"
        shutil.copy(self.folder / "in.off", self.folder / name)
        for command in ("simplify", "remesh"):
            with self.subTest(command=command):
                self.page(command, file=name)
                document = self.browse("r.html", "--dump-dom")
                self.assertIn('data-ready="yes"', document)
                self.assertNotIn("<b id=", document)
                self.assertIn("certified and checked", document)

    @unittest.skipUnless(HAS_VIEWER and CHROMIUM, "three.js or Chromium is not there")
    def test_the_browser_shows_the_meshes(self):
        self.page()
        self.browse("r.html", "--screenshot=shot.png")
        rows = pixels(self.folder / "shot.png")
        width = len(rows[0])
        # Grey or coloured by theme, a blank pane has few colours; shaded spheres have many.
        for pane in (slice(0, width // 2), slice(width // 2, width)):
            seen = {pixel for row in rows[300:600] for pixel in row[pane]}
            self.assertGreater(len(seen), 500)


if __name__ == "__main__":
    unittest.main()
