#!/usr/bin/python3
"""Runs the cells of a notebook one after the other in a folder of its own, as Jupyter would: notebook.py FILE."""
import json
import os
import sys
import tempfile

try:
    import matplotlib
    import netCDF4  # noqa: F401
    import strut  # noqa: F401
    import vtkmodules  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

matplotlib.use("Agg")
with open(sys.argv[1]) as file:
    notebook = json.load(file)
assert notebook["nbformat"] == 4
names = {}
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for number, cell in enumerate(notebook["cells"], 1):
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"cell {number}", "exec"), names)
    assert os.path.getsize("foam.png") > 10000
    os.chdir("/")
# The first yield of struts along the load that fill a part of the section: between a tenth and all of that stress.
stress = max(names["curve"].stress["Reaction_Z(top)"])
bound = 193e6 * names["solid"].mean(axis=(0, 1)).min()
assert 0.1 * bound < stress < 10 * bound, (stress, bound)
