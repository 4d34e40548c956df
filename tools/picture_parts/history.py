"""Plots of histories (CSV) in time."""
import matplotlib.pyplot as plt
import numpy as np
from strut_tools import fail, history, save_picture

from .result import clock_of, stem, title


def draw(axes, table, name, label, clock):
    if name not in table:
        fail(f"there is no column '{name}'; there are {', '.join(table)}")
    axes.plot(clock[0] * table["Time"], table[name], label=label, linewidth=1.4)


def finished(figure, panels, clock, out):
    panels[-1].set_xlabel(f"t, {clock[1]}")
    for axes in panels:
        axes.grid(alpha=0.3)
        axes.margins(x=0)
    return save_picture(figure, out)


def energies(path, out):
    """Energies, works and the balance error of one history."""
    table = history(path)
    clock = clock_of(np.abs(table["Time"]).max())
    figure, panels = plt.subplots(2, 1, sharex=True, figsize=(7, 6), height_ratios=(3, 1), layout="constrained")
    for name in [n for n in table if n.endswith(("_Energy", "_Work"))]:
        if np.abs(table[name]).max() > 0:  # a run without contact has no work of it
            draw(panels[0], table, name, name.replace("_", " "), clock)
    panels[0].set_ylabel("J")
    panels[0].set_title(stem(path), fontsize=12)
    draw(panels[1], table, "Balance_Error", None, clock)
    panels[1].set_ylabel("Balance error")
    panels[1].ticklabel_format(axis="y", scilimits=(-2, 2))
    panels[0].legend(frameon=False)
    return finished(figure, panels, clock, out)


def columns(paths, names, out):
    """A panel for each column: of several histories with a legend, of one with its name above."""
    tables = [history(path) for path in paths]
    clock = clock_of(max(np.abs(table["Time"]).max() for table in tables))
    figure, panels = plt.subplots(len(names), 1, sharex=True, figsize=(7, max(4.2, 1 + 1.7 * len(names))), layout="constrained",
                                  squeeze=False)
    for axes, name in zip(panels[:, 0], names):
        for path, table in zip(paths, tables):
            draw(axes, table, name, stem(path), clock)
        axes.set_title(title(name), fontsize=10)
    if len(paths) > 1:
        panels[0, 0].legend(frameon=False)
    else:
        figure.suptitle(stem(paths[0]), fontsize=12)
    return finished(figure, panels[:, 0], clock, out)
