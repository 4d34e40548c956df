"""strut from Python: a deck as a dictionary, meshes and voxels as arrays of NumPy, a run, its fields and its history.

    import numpy as np, strut
    block = strut.voxels(np.ones((8, 8, 16), bool), 1e-4)
    deck = strut.Deck({"Discretization": {}, "Materials": {...}, ...})   # names as in inputs/KEYS.md
    run = strut.run(deck, block)
    run.fields["Cauchy_Stress"], run.history["Time"]

curve, stiffness, picture and convergence are the tools of the same names (convergence: study; tools/README.md): smooth=3
is their option --smooth 3, a list several words, True an option without a value. They return None but on rank 0.

On several ranks: mpirun -n 4 python3 study.py, with or without mpi4py. All ranks make the calls that take a deck or a run,
and those of the tools. An exception that one rank alone does not catch ends the job.
"""
import atexit
import sys

from . import _core
from ._core import Error, set_threads, version
from .deck import Deck
from .mesh import mesh, recipe, voxels
from .run import Run, check, close_all, run
from .tools import convergence, curve, picture, stiffness

__all__ = ["Deck", "Error", "Run", "check", "convergence", "curve", "mesh", "picture", "recipe", "run", "set_threads",
           "stiffness", "version", "voxels"]


Error.__module__ = "strut"
Error.__doc__ = "What is wrong with a deck, a mesh, a run or the words of a call, where, and what was expected; on all ranks."
Error.problems = property(lambda error: [line.strip() for line in str(error).split("\n")[1:] if line.startswith("  ")],
                          doc="of a deck, all of them: path, value, what was expected")

# Kokkos, and MPI where strut has started it, end before the interpreter does.
atexit.register(_core.finish)
atexit.register(close_all)  # called before it
atexit.register(lambda: hasattr(sys, "last_value") and _core.end_job())  # called first
