# SPDX-License-Identifier: GPL-3.0-or-later
#
# The documentation says what the program does: programs are quoted word for word from the
# examples that are compiled and run, every flag is in the manual, every link leads somewhere.
import os
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

DATA = os.environ.get("SURETY_DATA_DIR", "")
ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "doc/manual").glob("*.md"))]
QUOTE = re.compile(r"<!-- (doc/examples/\S+) -->\n```cpp\n(.*?)```", re.DOTALL)
COMMANDS = ("simplify", "remesh", "compare", "verify", "info", "hierarchy", "adapt", "enrich")


def without_header(source):
    """A source without the licence and the comment that opens it."""
    lines = source.splitlines(keepends=True)
    while lines and lines[0].startswith("//"):
        lines.pop(0)
    return "".join(lines)


def flags(text):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", text))


class Documentation(unittest.TestCase):
    def test_programs_are_quoted_from_disk(self):
        quotes = 0
        for page in PAGES:
            for name, text in QUOTE.findall(page.read_text()):
                quotes += 1
                with self.subTest(page=page.name, example=name):
                    self.assertEqual(text, without_header((ROOT / name).read_text()))
        self.assertGreater(quotes, 0)

    @unittest.skipUnless(os.path.exists(f"{DATA}/fandisk.off"), "the model is not there")
    def test_the_commands_of_the_tutorial_work_as_printed(self):
        text = (ROOT / "doc/manual/tutorial.md").read_text()
        commands = re.findall(r"^\$ surety (.*)$", text, re.MULTILINE)
        self.assertGreater(len(commands), 8)
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(f"{DATA}/fandisk.off", folder)
            for command in commands:
                with self.subTest(command=command):
                    done = subprocess.run(
                        [os.environ.get("SURETY", "surety"), *shlex.split(command)], cwd=folder,
                        capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, done.stderr)

    def test_links_lead_somewhere(self):
        for page in PAGES:
            prose = re.sub(r"```.*?```", "", page.read_text(), flags=re.DOTALL)
            for link in re.findall(r"\]\(([^)#]+)[^)]*\)", prose):
                if "://" not in link:
                    with self.subTest(page=page.name, link=link):
                        self.assertTrue((page.parent / link).exists())

    def test_the_text_of_a_link_is_on_one_line(self):
        # Doxygen loses its way otherwise, without a warning.
        for page in PAGES:
            with self.subTest(page=page.name):
                prose = re.sub(r"```.*?```", "", page.read_text(), flags=re.DOTALL)
                self.assertEqual(re.findall(r"\[[^\]\[]*\n[^\]\[]*\]\(", prose), [])

    def test_every_public_header_and_page_is_in_the_reference(self):
        # What Doxygen does not know, it does not miss.
        reference = (ROOT / "doc/reference.dox").read_text()
        for header in (ROOT / "include/surety").glob("*.h"):
            self.assertIn(f"\\file surety/{header.name}\n", reference)
        index = (ROOT / "doc/manual/index.md").read_text()
        for page in (ROOT / "doc/manual").glob("*.md"):
            if page.name != "index.md":
                self.assertIn(f"({page.name})", index)

    def test_the_manual_and_the_help_agree_about_flags(self):
        surety = os.environ.get("SURETY", "surety")
        manual = (ROOT / "doc/manual/command_line.md").read_text()
        helps = [
            subprocess.run([surety, *command, "--help"], capture_output=True, text=True,
                           check=True).stdout
            for command in ((), *((name,) for name in COMMANDS))
        ]
        known = flags("\n".join(helps))
        self.assertEqual(flags(manual), known)
        for name in ("tutorial", "choosing_parameters", "coming_from", "troubleshooting"):
            with self.subTest(page=name):
                text = (ROOT / f"doc/manual/{name}.md").read_text()
                self.assertLessEqual(flags(text), known)


if __name__ == "__main__":
    unittest.main()
