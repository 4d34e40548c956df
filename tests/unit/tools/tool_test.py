"""Shared by tests of the tools that draw: their packages, or the exit status that says they are missing; the places of the
tools; a folder for each test."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import matplotlib
    import netCDF4  # noqa: F401
    import numpy  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

matplotlib.use("Agg")
TOOLS = pathlib.Path(__file__).resolve().parents[3] / "tools"
sys.path[:0] = [str(TOOLS), str(TOOLS / "shared")]


class InFolder(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.folder = pathlib.Path(keep.name)

    def run_tool(self, name, *words):
        """As a user runs it, from the test's folder."""
        return subprocess.run([TOOLS / name, *map(str, words)], capture_output=True, text=True, cwd=self.folder)
