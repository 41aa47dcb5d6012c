#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Takes the picture of a report as a page: simplifies a model and opens its report in headless
# Chromium, with WebGL drawn by the processor.
#
#   python3 report.py surety original.off picture.png
import subprocess
import sys
import tempfile
from pathlib import Path

SIZE = (1200, 700)


def main():
    program, model, picture = (str(Path(name).resolve()) for name in sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        name = Path(model).stem
        subprocess.run([program, "simplify", model, "-o", f"{folder}/{name}.ply", "-t", "0.1%",
                        "--report", f"{folder}/report.html", "--quiet"], check=True)
        subprocess.run(
            ["chromium", "--headless", "--no-sandbox", "--use-gl=angle",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
             "--window-size={},{}".format(*SIZE), "--virtual-time-budget=8000",
             f"--user-data-dir={folder}/profile", f"--screenshot={picture}",
             f"file://{folder}/report.html"], check=True, stderr=subprocess.DEVNULL)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: report.py surety original.off picture.png")
    main()
