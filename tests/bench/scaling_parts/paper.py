"""Extrapolation of the measured runs to many more points and ranks."""
import os

import numpy as np
from scaling_parts import measured

POINTS, RANKS = 10**8, 1024
REACH = 2  # spacings, of ghosts around a rank's cube: the horizon, rounded up

# Limits of a job: memory of a core in bytes; start, a frame, a checkpoint in s.
MEMORY, START, FRAME, CHECKPOINT = 2e9, 600, 60, 180


def fitted(columns, values):
    """Least squares of relative errors, no coefficient below zero: those that would be are left out. And the largest error."""
    columns, values = np.array(columns, dtype=float), np.array(values, dtype=float)
    kept = list(range(columns.shape[1]))
    while True:
        weighted = columns[:, kept] / values[:, None]
        found = np.linalg.lstsq(weighted, np.ones(len(values)), rcond=None)[0]
        if min(found) >= 0 or len(kept) == 1:
            break
        del kept[int(np.argmin(found))]
    coefficients = np.zeros(columns.shape[1])
    coefficients[kept] = found
    return coefficients, np.abs(columns @ coefficients / values - 1).max()


def share(row):
    """Points of a rank, with its ghosts."""
    return row["points"] / row["ranks"] + row["ghosts"]


def far_share():
    edge = (POINTS / RANKS) ** (1 / 3)
    return (edge + 2 * REACH) ** 3


def memory(rows, who):
    here = [row for row in rows if row[who] is not None]
    return fitted([(1, share(row), row["points"]) for row in here], [row[who] for row in here])


def seconds(rows, phases):
    """b n/p + c n, the sum over some phases; by ranks that have cores of their own."""
    here = [row for row in rows if row["ranks"] <= os.cpu_count()]
    columns = [(row["points"] / row["ranks"], row["points"]) for row in here]
    coefficients = sum(fitted(columns, [max(row[phase], 1e-3) for row in here])[0] for phase in phases)
    total = [sum(row[phase] for phase in phases) for row in here]
    return coefficients, np.abs(np.array(columns) @ coefficients / total - 1).max()


def page(found):
    rows, reductions = found
    lines = ["| 10⁸ points, 1024 ranks | | of it for all points on one rank | of the limit | by | fits within |", "|---|---|---|---|---|---|"]
    strains = {}

    def add(name, text, whole, limit, formula, error):
        strains[name] = limit
        lines.append(f"| {name} | {text} | {whole:.0%} | {limit:.2g} | {formula} | {error:.0%} |")

    for name, who in (("memory of rank 0", "root"), ("memory of the others, most", "others")):
        (base, each, whole), error = memory(rows, who)
        total = base + each * far_share() + whole * POINTS
        add(name, f"{total / 1e9:.2f} GB", whole * POINTS / total, total / MEMORY,
            f"{base / 1e6:.0f} MB + {each:.0f} B (n/p + ghosts) + {whole:.1f} B n", error)
    for name, what, most in (("seconds at the start", measured.START, START), ("seconds a frame", ("frame",), FRAME),
                             ("seconds a checkpoint", ("checkpoint",), CHECKPOINT)):
        (each, whole), error = seconds(rows, what)
        total = each * POINTS / RANKS + whole * POINTS
        add(name, f"{total:.3g} s", whole * POINTS / total, total / most, f"{1e6 * each:.2f} µs n/p + {1e6 * whole:.3f} µs n", error)
    for name in ("frame bytes", "checkpoint bytes"):
        a_point = rows[-1][name] / rows[-1]["points"]
        lines.append(f"| {name} | {a_point * POINTS / 1e9:.1f} GB | | | {a_point:.0f} B n | |")
    lines.append(f"| reductions a step | {reductions:.2f} | | | any number of ranks | |")
    worst = max(strains, key=strains.get)
    lines += ["", f"Tightest limit: {worst}, at {strains[worst]:.2g} of it."]
    print("\n".join(lines))
    return "\n".join(lines)
