#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes all figures of the manual again, and the tables between markers on its pages:
#
#   xvfb-run -a python3 make_all.py surety adapt_to_front models work_folder
#
# `adapt_to_front` is the example of that name. Names after these, without .py, make those figures
# only. Needs python3-vtk9, and a display, which xvfb-run provides where there is none; the picture
# of a report needs Chromium and is left as it is where that is missing. The plots of performance
# need python3-matplotlib and the benchmarks, in the folder "benchmark" beside surety.
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
MANUAL = HERE.parent / "manual"
MARKED = re.compile(r"(<!-- table: (\w+) -->\n)(.*?)(<!-- end of the table -->)", re.DOTALL)
# Each of these programs runs surety itself. The first five are section 6 of the paper.
WITH_TABLES = ("three_stages", "graded_meshes", "decimation", "enrichment", "adaptation",
               "expected")


class Maker:
    def __init__(self, surety, front, models, folder):
        self.surety, self.front = (str(Path(p).resolve()) for p in (surety, front))
        self.models, self.folder = Path(models), Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def model(self, name):
        return str(self.models / f"{name}.off")

    def made(self, name):
        return str(self.folder / name)

    def run(self, command, given, made, *flags):
        subprocess.run([self.surety, command, given, "-o", self.made(made), *flags], check=True,
                       stdout=subprocess.DEVNULL)
        return self.made(made)

    def draw(self, program, *arguments):
        subprocess.run([sys.executable, str(HERE / f"{program}.py"), *arguments], check=True)

    def with_table(self, program):
        self.draw(program, self.surety, str(self.models), str(self.folder), str(HERE))

    def levels(self):
        shutil.rmtree(self.made("levels"), ignore_errors=True)  # surety wants a new folder
        folder = self.run("hierarchy", self.model("bunny00"), "levels", "--format", "off", "-t",
                          "0.02%,0.1%,0.3%,1%")
        self.draw("levels", folder, picture("levels"), self.made("levels.md"))

    def heat_map(self):
        report = self.made("bunny.json")
        mesh = self.run("simplify", self.model("bunny00"), "bunny.vtp", "-t", "0.1%", "--report",
                        report)
        self.draw("heat_map", self.model("bunny00"), mesh, report, picture("bunny"))

    def curvature(self):
        field = self.run("info", self.model("bunny00"), "curvature.vtp", "--curvature")
        self.draw("curvature", field, picture("curvature"))

    def metric(self):
        flags = ("--curvature", "--metric", "-t", "0.1%")
        part = self.model("fandisk")
        self.draw("metric", self.run("info", part, "round.vtp", *flags, "--metric-kind",
                                     "isotropic"),
                  self.run("info", part, "stretched.vtp", *flags), picture("metric"))

    def gradation(self):
        flags = ("--metric", "-t", "0.1%", "--metric-kind", "isotropic", "--gradation")
        part = self.model("fandisk")
        self.draw("gradation", self.run("info", part, "off.vtp", *flags, "inf"),
                  self.run("info", part, "on.vtp", *flags, "1.3"), picture("gradation"))

    def support(self):
        given = self.model("knot1")
        field = self.run("info", given, "support.vtp", "--support", "-t", "5%", "--subdivisions",
                         "8")
        self.draw("support", given, field, picture("support"))

    def unit_mesh(self):
        part = self.model("fandisk")
        self.draw("unit_mesh", part, self.run("remesh", part, "round.off", "-t", "0.1%"),
                  self.run("remesh", part, "long.off", "-t", "0.1%", "--metric", "anisotropic"),
                  picture("unit_mesh"))

    def report(self):
        if shutil.which("chromium"):
            self.draw("report", self.surety, self.model("bunny00"), picture("report"))
        else:
            print("  left as it is: there is no chromium")

    def performance(self):
        benchmarks = Path(self.surety).parent / "benchmark"
        if (benchmarks / "benchmark_counts").exists():
            self.draw("performance", str(benchmarks), str(self.models), str(self.folder),
                      str(HERE))
        else:
            print("  left as it is: the benchmarks have not been built")

    def solved_front(self):
        """The table that the example prints, with each number as it is there."""
        done = subprocess.run([self.front, "steady", "4"], check=True, capture_output=True,
                              text=True)
        cells = [line.split(", ") for line in done.stdout.splitlines()]
        lines = [cells[0], ["---"] * len(cells[0]), *cells[1:]]
        Path(self.made("solved_front.md")).write_text(
            "".join("| " + " | ".join(line) + " |\n" for line in lines), encoding="utf-8")


def picture(name):
    return str(HERE / f"{name}.png")


def put_tables_in_pages(folder):
    """Replaces what stands between the markers by the tables that have been made."""

    def table(match):
        path = Path(folder) / f"{match[2]}.md"
        made = path.read_text(encoding="utf-8") if path.exists() else match[3]
        return match[1] + made + match[4]

    for page in sorted(MANUAL.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        made = MARKED.sub(table, text)
        if made != text:
            page.write_text(made, encoding="utf-8")


def main(surety, front, models, folder, *wanted):
    maker = Maker(surety, front, models, folder)
    makers = {name: (lambda name=name: maker.with_table(name)) for name in WITH_TABLES}
    for name in ("levels", "solved_front", "heat_map", "curvature", "metric", "gradation",
                 "support", "unit_mesh", "report", "performance"):
        makers[name] = getattr(maker, name)
    unknown = [name for name in wanted if name not in makers]
    if unknown:
        sys.exit(f"make_all.py: no figure {unknown[0]}; there are {', '.join(makers)}")
    for name, make in makers.items():
        if not wanted or name in wanted:
            print(name, flush=True)
            try:
                make()
            except subprocess.CalledProcessError as error:
                sys.exit(f"make_all.py: {name}: {error}")
    put_tables_in_pages(folder)


if __name__ == "__main__":
    if len(sys.argv) < 5:
        sys.exit("usage: make_all.py surety adapt_to_front models work_folder [figure...]")
    main(*sys.argv[1:])
