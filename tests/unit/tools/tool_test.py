"""Shared by tests of the tools that draw: their packages, or the exit status that says they are missing; the places of the
tools; a folder for each test."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import script

try:
    import matplotlib
    import matplotlib.pyplot  # noqa: F401  here rather than in each run of a tool
    import netCDF4  # noqa: F401
    import numpy  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

matplotlib.use("Agg")
TOOLS = pathlib.Path(__file__).resolve().parents[3] / "tools"
sys.path[:0] = [str(TOOLS), str(TOOLS / "shared")]


class InFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        script.begin()

    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.folder = pathlib.Path(keep.name)

    started = set()

    def run_tool(self, name, *words, **environment):
        """In the test's folder: first as a user runs it, then as script.py does."""
        if name in self.started:
            return script.run(TOOLS / name, *words, folder=self.folder, **environment)
        self.started.add(name)
        return subprocess.run([TOOLS / name, *map(str, words)], capture_output=True, text=True, cwd=self.folder,
                              env={**os.environ, **environment})
