"""One table (CSV) and one figure of the runs of a study."""
import csv
import os
import re
import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np
from decks import Deck, value_of
from strut_tools import ROOT, fail, history_of, number, save_picture, write_table

from study_parts import bands, logs

FACTS = {"points": r"^([\d,]+) points,", "steps": r"^(\d+) (load )?steps,", "seconds": r"^whole run +([\d.]+)",
         "balance_error": r"balance error ([\d.e+-]+)"}
OF_LOGS = (*FACTS, "warnings")  # columns of the table


def facts_of(case):
    """The facts in the log of a run: the last points and balance error; steps and seconds of all parts, if it was stopped
    and went on. One part tells the seconds of both of its solvers, and the steps of each: those of the last one count."""
    text = logs.text_of(case.log)
    parts = re.split(r"^(?=[\d,]+ points, [\d,]+ bonds)", text, flags=re.M)
    parts = parts[1:] or parts  # the text before the first run is the output of strut-mesh
    found = {name: last_of(name, text) for name in ("points", "balance_error")}
    found["seconds"] = total([last_of("seconds", part) for part in parts])
    steps = [{kind: float(n) for n, kind in re.findall(FACTS["steps"], part, re.M)} for part in parts]
    kind = next(reversed(steps[-1]), "")
    found["steps"] = total([of.get(kind, 0) if of else None for of in steps])
    return {name: found[name] for name in FACTS if found[name] is not None}


def last_of(name, text):
    values = re.findall(FACTS[name], text, re.M)
    return float(values[-1].replace(",", "")) if values else None


def total(numbers):
    """None if a part does not tell its own: it was killed."""
    return None if None in numbers else sum(numbers)


def last_row(case):
    name = Deck(os.path.join(case.folder, case.deck)).get("History", "Filename")
    path = name and os.path.join(case.folder, name)
    if not path or not os.path.isfile(path):
        return {}
    return history_of(path)[-1]


def measures_of(case, options):
    """The measures of tools/curve; its files stay in the folder of the case."""
    command = [sys.executable, os.path.join(ROOT, "tools/curve"), case.deck, *options.split()]
    done = subprocess.run(command, cwd=case.folder, capture_output=True, text=True)
    with open(os.path.join(case.folder, "curve.log"), "w") as file:
        file.write(done.stdout + done.stderr)
    if done.returncode != 0:
        return {}, done.stderr.strip()
    with open(os.path.join(case.folder, os.path.splitext(case.deck)[0] + "-measures.csv"), newline="") as file:
        return {row["Measure"]: (float(row["Value"]) if row["Value"] else None, row["Unit"])
                for row in csv.DictReader(file)}, None


def rows_of(study, cases):
    """For each case, {name: value} of the varied, the run's and the collected values; and the units."""
    rows, units = [], {"seconds": "s"}
    for case in cases:
        error = case.error()
        row = {**case.values, **facts_of(case), "warnings": len(logs.warnings_of(case)), "error": error or ""}
        known = dict(last_row(case)) if not error else {}
        if study.curve is not None and not error:
            found, wrong = measures_of(case, study.curve)
            row["error"] = wrong or ""
            units.update({name: unit for name, (_, unit) in found.items() if unit != "1"})
            row.update({name: value for name, (value, _) in found.items()} if not study.collect else {})
            known.update({name: value for name, (value, _) in found.items()})
        for name in study.collect:
            if known:
                study.expect(name, list(known), "to collect")
            row[name] = known.get(name)
        rows.append(row)
    return rows, units


def write(path, rows, units):
    names = list(dict.fromkeys(name for row in rows for name in row if name != "error")) + ["error"]
    write_table(path, [f"{n} ({units[n]})" if n in units else n for n in names], [[row.get(n) for n in names] for row in rows])


def table(rows, plots, study):
    """The important columns, for reading."""
    names = [n for vary, _ in study.vary for n in vary] + ["points", "seconds"]
    names += study.collect or list(dict.fromkeys(p.y for p in plots)) or ["plateau_stress"]
    lines = [" | ".join(names), " | ".join("---" for _ in names)]
    for row in rows:
        cells = [f"{row[n]:.4g}" if isinstance(row.get(n), float) else str(row.get(n) if row.get(n) is not None else "-") for n in names]
        lines.append(" | ".join(cells) + (f"   {row['error']}" if row["error"] else ""))
    return "\n".join(f"| {line} |" for line in lines)


def figure(path, study, cases, rows, units):
    plots = study.plots
    curves = bands.curves_of(cases, rows, study.band) if study.band else {}
    if not (count := len(plots) + len(curves)):
        return
    columns = min(count, 3)
    rows_of_panels = -(-count // columns)
    drawing = plt.figure(figsize=(5.6 * columns, 4.3 * rows_of_panels), layout="constrained")
    panels = [drawing.add_subplot(rows_of_panels, columns, n + 1) for n in range(count)]
    for axes, plot in zip(panels, plots):
        for name in (plot.x, plot.y, plot.by):
            if name and not any(name in row for row in rows):
                study.expect(name, [n for n in rows[0] if n != "error"], "to plot")
        draw(axes, plot, rows)
        for axis, name in ((axes.set_xlabel, plot.x), (axes.set_ylabel, plot.y)):
            axis(name.replace("_", " ") + (f", {units[name]}" if name in units else ""))
    for axes, column in zip(panels[len(plots):], curves):
        bands.draw(axes, column, curves[column], study.band)
    for axes in panels:
        axes.grid(alpha=0.3)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(frameon=False)
    save_picture(drawing, path)


def draw(axes, plot, rows):
    """For each value of `by`, a line through the means at each x, with their scatter if there are several."""
    for by in dict.fromkeys(row[plot.by] if plot.by else None for row in rows):
        pairs = [(number(r.get(plot.x)), number(r.get(plot.y))) for r in rows if not plot.by or r[plot.by] == by]
        pairs = np.array([p for p in pairs if None not in p]).reshape(-1, 2)
        if not len(pairs):
            continue
        xs = np.unique(pairs[:, 0])
        groups = [pairs[pairs[:, 0] == x, 1] for x in xs]
        deviation = [g.std(ddof=1) if len(g) > 1 else 0 for g in groups]
        line = axes.errorbar(xs, [g.mean() for g in groups], deviation if any(deviation) else None, fmt="-", capsize=3, label=by)
        axes.plot(*pairs.T, ".", color=line[0].get_color())
    if plot.beside:
        draw_beside(axes, plot, rows)


def draw_beside(axes, plot, rows):
    points = []
    for row in rows:
        names = {k: number(v) for k, v in row.items() if number(v) is not None}
        x, y = names.get(plot.x), value_of(plot.beside, names)
        if x is not None and y is not None:
            points.append((x, y))
    if not points:
        fail(f"'beside {plot.beside}' is no number of the columns of the table")
    axes.plot(*np.array(sorted(set(points))).T, "k--", linewidth=1, label=plot.beside)
