#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The plots and tables of doc/manual/performance.md, from what the benchmarks measure.
#
#   python3 performance.py benchmark_folder models work_folder figure_folder
#
# Leaves the tables of the benchmarks, as CSV, in the work folder; with --draw as a last argument it
# draws those that are there instead of measuring again. Needs python3-matplotlib and, for
# true figures, an idle machine.
import csv
import os
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from runs import number, write_table  # noqa: E402

SIZES = ("elephant", "fandisk")
MODELS = ("fandisk", "bear", "elephant")
REMESHED = ("fandisk", "elephant")
TOLERANCES = "0.01,0.03,0.1,0.3,1"
METHODS = {"surety": "Surety", "surety_free": "Surety, free placement",
           "cgal_lindstrom_turk": "CGAL, Lindstrom-Turk",
           "cgal_garland_heckbert": "CGAL, Garland-Heckbert", "openmesh_hausdorff": "OpenMesh",
           "meshoptimizer": "meshoptimizer"}


class Benchmarks:
    def __init__(self, folder, models, work, measures=True):
        self.folder, self.models, self.work = Path(folder), models, Path(work)
        self.measures = measures
        self.work.mkdir(parents=True, exist_ok=True)

    def __call__(self, name, *arguments):
        """The rows of a table; those without a result are left out, with a message."""
        made = self.work / f"performance_{name}.csv"
        if self.measures:
            print(f"  benchmark_{name} {' '.join(arguments)}", flush=True)
            with made.open("w", encoding="utf-8") as file:
                subprocess.run([self.folder / f"benchmark_{name}", *arguments, "--data",
                                self.models], check=True, stdout=file)
        with made.open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        for row in rows:
            if row.get("message"):
                print(f"  no result: {row}", file=sys.stderr)
        return [row for row in rows if not row.get("message")]


def groups(rows, column):
    """The rows by the value of a column, in order of appearance."""
    result = {}
    for row in rows:
        result.setdefault(row[column], []).append(row)
    return result


def values(rows, column):
    return [float(row[column]) for row in rows]


def plot_time(rows, path):
    """Time and memory over the number of faces."""
    figure, (time, memory) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
    for i, (model, sizes) in enumerate(groups(rows, "model").items()):
        faces, seconds = values(sizes, "input_faces"), values(sizes, "seconds")
        theirs = [n * 1e-6 * t for n, t in zip(
            faces, values(sizes, "lindstrom_turk_microseconds_a_face"))]
        time.loglog(faces, seconds, "o-", color=f"C{i}", label=f"{model}, Surety, certified")
        time.loglog(faces, theirs, "s--", color=f"C{i}", label=f"{model}, CGAL to as many faces")
        if i == 0:
            time.loglog(faces, [seconds[0] * n / faces[0] for n in faces], "k:", linewidth=.8,
                        label="linear")
        memory.semilogx(faces, values(sizes, "bytes_a_face"), "o-", color=f"C{i}",
                        label=f"{model}, allocated")
        memory.semilogx(faces, values(sizes, "resident_bytes_a_face"), "s--", color=f"C{i}",
                        label=f"{model}, resident")
    time.set(xlabel="faces of the input", ylabel="CPU seconds")
    memory.set(xlabel="faces of the input", ylabel="bytes a face, beside the mesh")
    memory.set_ylim(bottom=0)
    for axes in (time, memory):
        axes.legend(fontsize=7)
        axes.grid(alpha=.3)
    save(figure, path)


def plot_faces(rows, names, path):
    """Faces over the distance: ours over the tolerance that is proven, those of others over the
    distance that they turned out to have."""
    models = groups(rows, "model")
    figure, all_axes = plt.subplots(1, len(models), figsize=(10.5, 3.8), layout="constrained",
                                    squeeze=False)
    for axes, (model, results) in zip(all_axes[0], models.items()):
        for i, (method, made) in enumerate(groups(results, "method").items()):
            is_ours = method.startswith("surety")
            tolerance = values(made, "tolerance_per_cent")
            share = [1] * len(made) if is_ours else values(made, "distance_upper_over_tolerance")
            axes.loglog([t * s for t, s in zip(tolerance, share)], values(made, "faces"),
                        "o-" if is_ours else "s--", color=f"C{i}", markersize=4,
                        label=names[method])
        axes.axhline(float(results[0]["input_faces"]), color="k", linewidth=.8, linestyle=":")
        axes.set(title=model, xlabel="distance, % of the diagonal")
        axes.grid(alpha=.3)
    all_axes[0][0].set_ylabel("faces; dotted: the input")
    all_axes[0][0].legend(fontsize=7)
    save(figure, path)


def save(figure, path):
    # Without the versions of programs, the same figures give the same file.
    figure.savefig(path, dpi=90, metadata={"Software": None})
    plt.close(figure)


def machine(path):
    """What the system says of itself."""
    told = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    model = next((line.split(":", 1)[1].strip() for line in told.splitlines()
                  if line.startswith(("model name", "Model"))), "unknown")
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    write_table(path, [(model, str(os.cpu_count()), f"{memory:.0f} GiB")],
                ("processor", "threads", "memory"))


def scaling_table(rows, path):
    write_table(
        path, [(row["model"], number(float(row["input_faces"]), 0), number(float(row["faces"]), 0),
                number(float(row["seconds"]), 2), number(float(row["microseconds_a_face"]), 1),
                number(float(row["lindstrom_turk_microseconds_a_face"]), 1),
                number(float(row["bytes_a_face"]), 0),
                row["exponent_from_last"] and number(float(row["exponent_from_last"]), 2))
               for row in rows],
        ("model", "faces", "faces after", "CPU seconds", "microseconds a face",
         "CGAL's, to as many faces", "bytes a face", "exponent from the last size"))


def faces_table(rows, names, path):
    """At a tenth of a per cent."""
    write_table(
        path, [(row["model"], names[row["method"]],
                number(float(row["faces"]), 0), number(float(row["seconds"]), 3),
                number(float(row["distance_upper_over_tolerance"]), 2), row["within_tolerance"])
               for row in rows if float(row["tolerance_per_cent"]) == .1],
        ("model", "method", "faces", "CPU seconds", "true distance / tolerance", "within it"))


REMESHERS = {"surety": "Surety remesh", "surety_fewest": "Surety remesh --fewest",
             "surety_anisotropic": "Surety remesh --metric anisotropic",
             "cgal_isotropic_remeshing": "CGAL isotropic_remeshing"}


def main(benchmarks, figures):
    machine(benchmarks.work / "performance_machine.md")
    sizes = benchmarks("scaling", *SIZES, "--largest", "500000", "--peer")
    plot_time(sizes, figures / "performance_time.png")
    scaling_table(sizes, benchmarks.work / "performance_scaling.md")
    counts = benchmarks("counts", *MODELS, "-t", TOLERANCES, "--skip-slow", "--methods",
                        ",".join(METHODS))
    plot_faces(counts, METHODS, figures / "performance_simplify.png")
    faces_table(counts, METHODS, benchmarks.work / "performance_simplify.md")
    remeshed = benchmarks("remeshing", *REMESHED, "-t", TOLERANCES.split(",", 1)[1])
    plot_faces(remeshed, REMESHERS, figures / "performance_remesh.png")
    faces_table(remeshed, REMESHERS, benchmarks.work / "performance_remesh.md")


if __name__ == "__main__":
    if len(sys.argv) not in (5, 6) or sys.argv[5:] not in ([], ["--draw"]):
        sys.exit("usage: performance.py benchmark_folder models work_folder figure_folder [--draw]")
    main(Benchmarks(*sys.argv[1:4], measures=len(sys.argv) == 5), Path(sys.argv[4]))
