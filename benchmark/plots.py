#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the tables of the benchmarks, as SVG or whatever the name of the output says.

    benchmark_counts > counts.csv && plots.py counts.csv -o counts.svg
    benchmark_scaling > scaling.csv && plots.py scaling.csv -o scaling.svg

The kind of plot follows from the columns. Needs Debian's python3-matplotlib.
"""
import argparse
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# So that the same table gives the same file.
matplotlib.rcParams["svg.hashsalt"] = "surety"


def groups(rows, column):
    """The rows by the value of a column, in order of appearance."""
    result = {}
    for row in rows:
        result.setdefault(row[column], []).append(row)
    return result


def counts(rows, axes):
    """Faces, as a fraction of the input, a group of bars a model; methods that leave the tolerance
    are hatched, with the distance in tolerances on top."""
    models = list(groups(rows, "model"))
    methods = groups([row for row in rows if row["faces"]], "method")
    width = 0.8 / len(methods)
    for i, (method, results) in enumerate(methods.items()):
        for row in results:
            x = models.index(row["model"]) + (i - len(methods) / 2) * width
            is_out = row["within_tolerance"] != "yes"
            height = int(row["faces"]) / int(row["input_faces"])
            axes.bar(
                x, height, width, align="edge", color=f"C{i}", alpha=0.35 if is_out else 1,
                hatch="////" if is_out else None, label=method if row is results[0] else None)
            if is_out and row["distance_upper_over_tolerance"]:
                text = f"{float(row['distance_upper_over_tolerance']):.2g}"
                axes.text(x + width / 2, height, text, ha="center", va="bottom", fontsize=5)
    axes.set_yscale("log")
    axes.set_xticks(range(len(models)), models, rotation=20)
    axes.set_ylabel("faces of the result / faces of the input")
    axes.set_title(
        f"Faces at {rows[0]['tolerance_per_cent']} % of the diagonal; hatched: beyond the "
        "tolerance, by the factor on top")
    axes.legend(fontsize=6)


def scaling(rows, axes):
    """CPU seconds over faces, with a straight line of slope one to compare."""
    rows = [row for row in rows if row["seconds"]]
    for model, results in groups(rows, "model").items():
        faces = [int(row["input_faces"]) for row in results]
        seconds = [float(row["seconds"]) for row in results]
        exponent = results[-1]["exponent_so_far"]
        axes.loglog(faces, seconds, "o-", label=f"{model}, exponent {exponent}")
        axes.loglog(faces, [seconds[0] * n / faces[0] for n in faces], "k:", linewidth=0.8)
    axes.set_xlabel("faces of the input")
    axes.set_ylabel("CPU seconds")
    axes.set_title("Time; dotted: linear")
    axes.legend()


def speed(rows, axes):
    """CPU seconds of ours and of the peers."""
    methods = {"Surety, certified": "seconds", "Lindstrom-Turk": "lindstrom_turk_seconds",
               "Garland-Heckbert": "garland_heckbert_seconds"}
    for i, (name, column) in enumerate(methods.items()):
        x = [j + (i - 1.5) * 0.25 for j in range(len(rows))]
        axes.bar(x, [float(row[column]) for row in rows], 0.25, align="edge", label=name)
    axes.set_xticks(range(len(rows)), [row["model"] for row in rows])
    axes.set_ylabel("CPU seconds")
    axes.set_title(f"Time to the same number of faces, {rows[0]['tolerance_per_cent']} %")
    axes.legend()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("table", help="CSV of benchmark_counts, benchmark_scaling or "
                                      "benchmark_speed")
    parser.add_argument("-o", "--output", required=True, help="the picture")
    options = parser.parse_args()
    with open(options.table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    kinds = {"method": counts, "exponent_so_far": scaling, "over_lindstrom_turk": speed}
    kind = next((kinds[column] for column in kinds if rows and column in rows[0]), None)
    if kind is None:
        sys.exit(f"{options.table}: not a table of a benchmark that this script knows")
    figure, axes = plt.subplots(figsize=(9, 5), layout="constrained")
    kind(rows, axes)
    figure.savefig(options.output, metadata={"Date": None} if options.output.endswith("svg") else None)


if __name__ == "__main__":
    main()
