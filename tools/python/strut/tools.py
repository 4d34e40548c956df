"""The tools' functions (tools/README.md), on rank 0; elsewhere they return None. Options are those of the tools:
smooth=3 is --smooth 3, a list several words, True an option without a value."""
import csv
import os
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as tree
from dataclasses import dataclass

import numpy as np

from . import _core
from .deck import Deck
from .places import TOOLS, part_of_the_tools
from .run import Run

STRESS = "Stress (Pa) of "  # in a table of tools/curve
FILE = "sample"  # stem of the names of files written for a tool
read_files = part_of_the_tools("shared", "read_files")
TEXTS = ("measure", "unit", "finding")  # columns of convergence.csv


@dataclass
class Curve:
    strain: np.ndarray
    stress: dict    # {column of force: Pa}
    time: np.ndarray
    measures: dict  # {name: value}; NaN for those without one
    text: str       # what tools/curve says


def curve(source, out=None, **options):
    """Nominal stress over nominal strain of a run, of its deck's file or its history's, and what is read off it. out: a
    folder for the tables and the figure."""
    def made(folder):
        results = {}
        path = source
        if isinstance(source, Run):
            path, results = deck_of_run(source, folder), {"results": folder}
        to = out or os.path.join(folder, "curve")
        text = tool("curve", path, to, **results, **options)
        stem = os.path.join(to, os.path.splitext(os.path.basename(path))[0])
        head, *rows = rows_of(f"{stem}-curve.csv")
        table = dict(zip(head, np.array(rows, float).T))
        stress = {name.removeprefix(STRESS): values for name, values in table.items() if name.startswith(STRESS)}
        measures = {name: number(value) for name, value, *_ in rows_of(f"{stem}-measures.csv")[1:]}
        return Curve(table["Strain (1)"], stress, table["Time (s)"], measures, text)
    return on_first(made)


def stiffness(deck, mesh, out=None, **options):
    """The apparent elastic stiffness of a sample, Pa, in the order xx yy zz yz zx xy: {"kinematic": 6 x 6, "mixed": …}."""
    def made(folder):
        to = out or os.path.join(folder, "stiffness")
        tool("stiffness", write_deck(deck, mesh, folder), to, **options)
        _, *rows = rows_of(os.path.join(to, "stiffness.csv"))
        return {kind: np.array([row[2:] for row in rows if row[0] == kind], float) for kind in dict.fromkeys(r[0] for r in rows)}
    return on_first(made)


def picture(source, out, **options):
    """A picture of a run, which writes a result (Output), or of files: results (.e) or histories (.csv)."""
    def made(_):
        if isinstance(source, Run):
            file = source.deck.get("Output", {}).get("Output Filename")
            if not file:
                raise _core.Error("picture: the run writes no result; expected Output > Output Filename in its deck")
            sources = [file if os.path.splitext(file)[1] else file + ".e"]
        else:
            sources = [source] if isinstance(source, (str, os.PathLike)) else source
        tool("picture", *sources, out, **options)
        return out
    return on_first(made)


def convergence(study, out, name, **options):
    """Orders, limits and error bars of a study, or of a deck whose recipe is refined, over what tends to 0: a row for each
    measure, as a dictionary."""
    def made(_):
        tool("study", study, out, converge=name, **options)
        head, *rows = rows_of(os.path.join(out, "convergence.csv"))
        return [{key: value if key in TEXTS else number(value) for key, value in zip(head, row)} for row in rows]
    return on_first(made)


def on_first(action):
    """Calls action(folder) on rank 0. Returns its result there, None on other ranks; if it fails, all ranks raise an error."""
    found = error = None
    if _core.rank() == 0:
        try:
            with tempfile.TemporaryDirectory() as folder:
                found = action(folder)
        except BaseException as raised:  # Ctrl-C, too
            error = raised
    if _core.any(error is not None):
        raise error or _core.Error("the tool failed on rank 0, which tells why")
    return found


def tool(name, *words, **options):
    """The output of the tool; raises strut.Error with its message if it fails."""
    command = [sys.executable, os.path.join(TOOLS, name), *map(os.fspath, words)]
    for key, value in options.items():
        if value is None or value is False:
            continue
        several = value if isinstance(value, (list, tuple)) else [] if value is True else [value]
        command += [f"--{key.replace('_', '-')}", *map(str, several)]
    done = subprocess.run(command, env=environment(), capture_output=True, text=True)
    if done.returncode != 0:
        raise _core.Error((done.stderr or done.stdout).strip() or f"tools/{name}: exit status {done.returncode}")
    return done.stdout


def environment():
    """That of a process of its own, which is no rank of this job, and installs nothing."""
    of_job = ("PMIX_", "PMI_", "OMPI_COMM_", "OMPI_MCA_ess", "OMPI_MCA_orte", "OMPI_UNIVERSE", "OMPI_APP", "OMPI_NUM", "OMPI_FIRST")
    kept = {key: value for key, value in os.environ.items() if not key.startswith(of_job)}
    return {**programs(), **kept, "STRUT_TOOLS_INSTALLED": "1"}


def programs():
    """{variable of the tools: program} of the build or the prefix that holds this module."""
    top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(_core.__file__))))
    folders = os.pathsep.join(os.path.join(top, folder) for folder in ("", "tools", "../bin", "../../bin"))
    found = {name: shutil.which(name, path=folders) for name in ("strut", "strut-mesh", "strut-evaluate")}
    return {name.upper().replace("-", "_"): os.path.realpath(path) for name, path in found.items() if path}


def deck_of_run(run, folder):
    """The deck of a run, its mesh and its history as files."""
    if not run.history:
        raise _core.Error("curve: the run has no history; expected a section History with forces in its deck")
    history = {**run.deck["History"], "Filename": FILE + ".csv"}
    path = write_deck(Deck({**run.deck, "History": history}, run.deck.name), run.mesh, folder)  # before it, as of a run
    with open(os.path.join(folder, history["Filename"]), "w") as file:
        units = run.history.units
        file.write(f"# {_core.version()}; units: {','.join(units.values())}\n{','.join(units)}\n")
        np.savetxt(file, np.transpose(list(run.history.values())), "%.17g", ",")
    return path


def write_deck(deck, mesh, folder):
    deck = deck if isinstance(deck, Deck) else Deck(deck)
    here = os.path.dirname(deck.name)
    if mesh is not None:
        mesh.write(os.path.join(folder, FILE + ".g"))
        points = {**deck.get("Discretization", {}), "Type": "Exodus", "Input Mesh File": os.path.abspath(os.path.join(folder, FILE + ".g"))}
        deck = Deck({**deck, "Discretization": points}, deck.name)
    root = tree.fromstring(deck.to_xml())
    read_files.rename(root, lambda path: os.path.abspath(os.path.join(here, path)))
    path = os.path.join(folder, FILE + ".xml")
    tree.ElementTree(root).write(path, encoding="utf-8")
    return path


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


def number(text):
    try:
        return float(text or "nan")
    except ValueError:
        return text
