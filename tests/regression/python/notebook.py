#!/usr/bin/python3
"""Runs the cells of a notebook one after the other in a folder of its own, as Jupyter would, or the blocks ```python of a
page: notebook.py FILE PICTURE, which they draw."""
import json
import os
import re
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
    text = file.read()
if sys.argv[1].endswith(".md"):
    cells = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
else:
    notebook = json.loads(text)
    assert notebook["nbformat"] == 4
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
assert cells
names = {}
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for number, cell in enumerate(cells, 1):
        exec(compile(cell, f"cell {number}", "exec"), names)
    assert os.path.getsize(sys.argv[2]) > 10000
    os.chdir("/")
# The first yield of struts along the load that fill a part of the section: between a tenth and all of that stress.
stress = max(names["curve"].stress["Reaction_Z(top)"])
bound = 193e6 * names["solid"].mean(axis=(0, 1)).min()
assert 0.1 * bound < stress < 10 * bound, (stress, bound)
