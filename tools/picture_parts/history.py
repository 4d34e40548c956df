"""Plots of histories (CSV) in time."""
import csv
import os

import matplotlib.pyplot as plt
import numpy as np
from strut_tools import fail

from .result import stem, title


def history(path):
    """Columns by name."""
    if not os.path.isfile(path):
        fail(f"{path} does not exist")
    try:
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
        table = {name: np.array([float(row[name]) for row in rows]) for name in (rows[0] if rows else {})}
    except (UnicodeDecodeError, ValueError, TypeError, csv.Error) as error:
        fail(f"{path} is not a history: {error}")
    if "Time" not in table:
        fail(f"{path} is not a history: it has no column Time, or no rows")
    return table


def draw(axes, table, name, label):
    if name not in table:
        fail(f"there is no column '{name}'; there are {', '.join(table)}")
    axes.plot(1e3 * table["Time"], table[name], label=label, linewidth=1.4)


def finished(figure, panels, out):
    panels[-1].set_xlabel("t, ms")
    for axes in panels:
        axes.grid(alpha=0.3)
        axes.margins(x=0)
    figure.savefig(out, dpi=110)
    plt.close(figure)
    return out


def energies(path, out):
    """Energies, works and the balance error of one history."""
    table = history(path)
    figure, panels = plt.subplots(2, 1, sharex=True, figsize=(7, 6), height_ratios=(3, 1), layout="constrained")
    for name in [n for n in table if n.endswith(("_Energy", "_Work"))]:
        if np.abs(table[name]).max() > 0:  # a run without contact has no work of it
            draw(panels[0], table, name, name.replace("_", " "))
    panels[0].set_ylabel("J")
    panels[0].set_title(stem(path), fontsize=12)
    draw(panels[1], table, "Balance_Error", None)
    panels[1].set_ylabel("Balance error")
    panels[1].ticklabel_format(axis="y", scilimits=(-2, 2))
    panels[0].legend(frameon=False)
    return finished(figure, panels, out)


def column(paths, name, out):
    """One column of several histories."""
    figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
    for path in paths:
        draw(axes, history(path), name, stem(path))
    axes.set_ylabel(title(name))
    axes.legend(frameon=False)
    return finished(figure, [axes], out)


def extremes_of(table):
    """The columns that the deck asked for."""
    return [name for name in table if name.startswith(("Max_", "Min_"))]


def has_extremes(path):
    return bool(extremes_of(history(path)))


def extremes(path, out):
    """A panel for each column that the deck asked for."""
    table = history(path)
    names = extremes_of(table)
    figure, panels = plt.subplots(len(names), 1, sharex=True, figsize=(7, 1 + 1.7 * len(names)), layout="constrained",
                                  squeeze=False)
    for axes, name in zip(panels[:, 0], names):
        draw(axes, table, name, None)
        axes.set_title(title(name), fontsize=10)
    figure.suptitle(stem(path), fontsize=12)
    return finished(figure, panels[:, 0], out)
