# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the command line says of itself: the manual page and the completion know every option that
# the help knows, each example of the help works as printed, and help comes at once.
import os
import re
import resource
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from info_runs import sphere

SURETY = os.environ.get("SURETY", "surety")
COMMANDS = ("simplify", "remesh", "compare", "verify", "info", "hierarchy", "adapt",
            "enrich")


def surety(*arguments):
    return subprocess.run([SURETY, *arguments], capture_output=True, text=True, check=True).stdout


def flags(text):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", text))


def stl_text(mesh):
    points, faces = mesh
    lines = ["solid sphere"]
    for face in faces:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex {:.9g} {:.9g} {:.9g}".format(*points[v]) for v in face]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid sphere", ""])


def completions(*words):
    """What bash offers for the last word."""
    script = (
        'eval "$("$SURETY" --bash-completion)"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
        'COMPREPLY=(); _surety; printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run(["bash", "-euc", script, "bash", "surety", *words], capture_output=True,
                          text=True, check=True, env={**os.environ, "SURETY": SURETY})
    return set(done.stdout.split())


class Description(unittest.TestCase):
    def test_the_manual_page_has_every_flag_of_the_help(self):
        page = re.sub(r"\\f.", "", surety("--man-page").replace("\\-", "-"))
        for command in ((), *((name,) for name in COMMANDS)):
            with self.subTest(command=command):
                self.assertLessEqual(flags(surety(*command, "--help")), flags(page))

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_troff_understands_the_manual_page(self):
        done = subprocess.run(["groff", "-man", "-ww", "-Tutf8"], input=surety("--man-page"),
                              capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        self.assertIn("--tolerance", re.sub("\x1b\\[[0-9;]*m|.\b", "", done.stdout)
                      .replace("\N{MINUS SIGN}", "-"))

    @unittest.skipUnless(shutil.which("bash"), "bash is not installed")
    def test_bash_completes_commands_flags_and_values(self):
        self.assertEqual(completions(""), set(COMMANDS))
        self.assertEqual(completions("si"), {"simplify"})
        for command in COMMANDS:
            with self.subTest(command=command):
                self.assertEqual(completions(command, "--"), flags(surety(command, "--help")))
        self.assertEqual(completions("simplify", "in.off", "--placement", ""),
                         {"on-surface", "free"})
        self.assertEqual(completions("hierarchy", "--format", "o"), {"off", "obj"})
        self.assertEqual(completions("simplify", "--stages", ""), set())

    def test_the_examples_of_the_help_work_as_printed(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "part.stl").write_text(stl_text(sphere()))
            for command in ("simplify", "remesh", "compare", "verify", "info", "hierarchy"):
                text = surety(command, "--help")
                examples = re.findall(r"^(?:Example: | +)(surety .*)$", text, re.MULTILINE)
                self.assertGreater(len(examples), 0, text)
                for example in examples:
                    with self.subTest(example=example):
                        done = subprocess.run([SURETY, *shlex.split(example)[1:]], cwd=folder,
                                              capture_output=True, text=True)
                        self.assertEqual(done.returncode, 0, done.stderr)

    def test_help_takes_less_than_20_milliseconds(self):
        # Of the processor, so that the load of the machine does not count; the best of several, for
        # the first one reads the program from disk.
        def seconds():
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            surety("--help")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
        self.assertLess(min(seconds() for _ in range(9)), .02)


if __name__ == "__main__":
    unittest.main()
