# SPDX-License-Identifier: GPL-3.0-or-later
#
# What tests of commands share: a folder of their own to run surety in.
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SURETY = os.environ.get("SURETY", "surety")


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def surety(self, *arguments, status=0):
        done = subprocess.run([SURETY, *arguments], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stderr)
        return done
