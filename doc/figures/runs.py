# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the programs share that make a table: runs of the command line, and rows of statistics as in
# the tables of the paper, measured by surety and, where its report does not say, from the mesh.
import json
import math
import subprocess
import sys
from pathlib import Path

from measure import qualities, sharp_faces
from scene import corners_and_points, read_vtp

COLUMNS = ("mesh", "np", "ne", "Q worst", "Q mean", "Q <= 2", "tau", "unit edges",
           "proven distance")


class Runs:
    """Runs surety on the models of a folder; results go to another folder."""

    def __init__(self, program, models, folder):
        self.program, self.models, self.folder = program, Path(models), Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def model(self, name):
        return self.models / f"{name}.off"

    def __call__(self, command, given, name, *flags):
        """Runs a command on a file; returns the mesh, VTP unless the name has an extension, and the
        report. Fails where surety does."""
        mesh = self.folder / (name if Path(name).suffix in (".off", ".vtp") else f"{name}.vtp")
        report = self.folder / f"{mesh.name}.json"
        subprocess.run([self.program, command, str(given), "-o", str(mesh), *flags, "--quiet",
                        "--report", str(report)], check=True)
        return str(mesh), json.loads(report.read_text(encoding="utf-8"))


def arguments():
    """What all of these programs are called with: (runs, folder of pictures and tables)."""
    if len(sys.argv) != 5:
        sys.exit(f"usage: {Path(sys.argv[0]).name} surety models work_folder figure_folder")
    program, models, work, figures = sys.argv[1:]
    figures = Path(figures)
    figures.mkdir(parents=True, exist_ok=True)
    return Runs(program, models, work), figures


def worst_quality_elsewhere(path):
    """The worst Q of a VTP file away from corners sharper than SHARP, and their faces' number."""
    corners, points = corners_and_points(read_vtp(path))
    sharp = sharp_faces(corners, points)
    return float(qualities(corners, points)[~sharp].max()), int(sharp.sum())


def number(value, digits):
    return f"{value:,.{digits}f}"


def share(value):
    """Rounded downwards, so that 100 % means all."""
    return f"{math.floor(10 * value) / 10:.1f} %"


def per_cent_above(value, digits):
    """A bound is rounded upwards."""
    return f"{math.ceil(value * 10**digits) / 10**digits:.{digits}f} %"


def worst(value):
    return number(value, 2) if value < 1000 else "> 1,000"


def row(name, statistics, certificate=None, diagonal=None):
    """A line of a table. Only unit meshes have a tau, and only results a distance."""
    of_edges = "efficiency_index" in statistics
    return (
        name, number(statistics["vertices"], 0), number(statistics["faces"], 0),
        worst(statistics["Q_max"]), number(statistics["Q_avg"], 3),
        share(statistics["Q_le_2"]),
        number(statistics["efficiency_index"], 3) if of_edges else "",
        share(statistics["unit_edges"]) if of_edges else "",
        per_cent_above(100 * certificate["bound"] / diagonal, 4) if certificate else "")


def result_row(name, report):
    return row(name, report["output"], report["certificate"], report["input"]["diagonal"])


def judged(text, holds):
    return f"{text}, {'reached' if holds else 'not reached'}"


def write_table(path, rows, columns=COLUMNS):
    lines = [columns, ["---"] * len(columns), *rows]
    text = "".join("| " + " | ".join(line) + " |\n" for line in lines)
    Path(path).write_text(text, encoding="utf-8")
