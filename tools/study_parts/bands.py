"""The curves of a study: for each value of one name, the mean over its runs and the band from the least to the greatest."""
import os

import numpy as np
import strut_tools

STRAIN, STRESS = "Strain (1)", "Stress (Pa)"
EARLY = 0.02  # strain of the spike of an impact, which would hide the rest


def curves_of(cases, rows, name):
    """{force: {value of the name: [(strains, stresses) of each run]}} of the files of tools/curve."""
    found = {}
    for case, row in zip(cases, rows):
        path = os.path.join(case.folder, os.path.splitext(case.deck)[0] + "-curve.csv")
        if row["error"] or not os.path.isfile(path):
            continue
        table = strut_tools.columns(path)
        for column in (c for c in table if c.startswith(STRESS)):
            found.setdefault(column, {}).setdefault(case.values[name], []).append((table[STRAIN], table[column]))
    return found


def draw(axes, column, curves, name):
    """One panel: the curves of one force, to the strain that all runs of a value have reached."""
    for value, runs in curves.items():
        strains = np.linspace(0, min(strain.max() for strain, _ in runs), 400)
        stresses = np.array([np.interp(strains, strain, stress) for strain, stress in runs]) / 1e6
        line = axes.plot(strains, stresses.mean(axis=0), label=f"{name} {value}, {len(runs)} run{'s' * (len(runs) > 1)}")
        axes.fill_between(strains, stresses.min(axis=0), stresses.max(axis=0), color=line[0].get_color(), alpha=0.2, linewidth=0)
    axes.set_xlabel("strain")
    axes.set_ylabel(column.replace("Stress (Pa)", "stress, MPa,"))
    late = [stress[strain >= min(EARLY, strain.max())].max() for runs in curves.values() for strain, stress in runs]
    axes.set_ylim(0, 1.05e-6 * max(late))
