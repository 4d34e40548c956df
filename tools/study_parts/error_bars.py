"""The measures of a study over its grids: order, limit and error bar of each, as a table (CSV) and as text."""
import math

from . import collect, convergence

NUMBERS = ("order", "limit", "error_bar", "error_bar_percent", "safety_factor", "spread_percent")


def rows_of(study, name, kinds, rows, units, theory):
    """A row for each kind of run and measure; grids without a value are ignored. The finest grid comes first."""
    row_of = {tuple(row[n] for names, _ in study.vary for n in names): row for row in rows}
    varied = {n for names, _ in study.vary for n in names}
    measures = [n for n in dict.fromkeys(n for row in rows for n in row) if n not in varied | {"error", *collect.OF_LOGS}]
    return [row_of_measure(name, kind, measure, [row_of[tuple(case.values.values())].get(measure) for case in kind.cases],
                           units.get(measure, ""), theory) for kind in kinds for measure in measures]


def row_of_measure(name, kind, measure, values, unit, theory):
    pairs = [(size, value) for size, value in zip(kind.sizes, values) if isinstance(value, float) and math.isfinite(value)][:3]
    sizes, known = zip(*pairs) if pairs else ((), ())
    found = convergence.of_grids(sizes, known, theory)
    row = {**kind.values, "measure": measure, "unit": unit}
    for n in range(3):
        row[f"{name}_{n + 1}"], row[f"value_{n + 1}"] = pairs[n] if n < len(pairs) else (None, None)
    spread = 100 * (max(known) - min(known)) / abs(known[0]) if len(known) > 1 and known[0] != 0 else None
    numbers = (found.order, found.limit, found.bar, found.percent(known[0]) if known else None, found.safety, spread)
    return {**row, **dict(zip(NUMBERS, numbers)), "finding": found.finding}


def text(name, kinds, rows, theory):
    """The same as text, with the method."""
    parts = []
    for kind in kinds:
        own = [row for row in rows if all(row[k] == v for k, v in kind.values.items())]
        parts.append((f"{kind.said()}\n" if kind.values else "") + table(own))
    ratios = [b / a for kind in kinds for a, b in list(zip(kind.sizes, kind.sizes[1:]))[:2]]
    parts.append(f"Values from the coarsest of up to three grids to the finest, {name} as meshed. Error bar: grid convergence index "
                 f"of the finest (Roache), {convergence.SAFETY[3]:g} times the distance to the limit by the observed order of three "
                 f"grids, {convergence.SAFETY[2]:g} times that by order {theory:g} of two.")
    if min(ratios) < convergence.GOOD_RATIO:
        parts.append(f"The grids are refined by {min(ratios):.3g} only: below {convergence.GOOD_RATIO} orders are uncertain "
                     "(Celik et al. 2008).")
    return "\n\n".join(parts) + "\n"


def table(rows):
    lines = ["| measure | coarse to fine | spread | order | limit | error bar |", "|---|---|---|---|---|---|"]
    for row in (row for row in rows if row["value_2"] is not None):
        measure = row["measure"] + (f", {row['unit']}" if row["unit"] else "")
        values = ", ".join(f"{row[f'value_{n}']:.5g}" for n in (3, 2, 1) if row[f"value_{n}"] is not None)
        order = f"{row['order']:.2f}" if row["order"] is not None else row["finding"]
        bar = "-" if row["error_bar"] is None else f"± {row['error_bar']:.2g}"
        bar += "" if row["error_bar_percent"] is None else f" ({short(row['error_bar_percent'], ' %')})"
        lines.append(f"| {measure} | {values} | {short(row['spread_percent'], ' %')} | {order} | {shown(row['limit'])} | {bar} |")
    missing = [row["measure"] for row in rows if row["value_2"] is None]
    if missing:
        lines += ["", f"No value on two grids (what tools/curve says of it lies beside each run): {', '.join(missing)}."]
    return "\n".join(lines)


def short(value, unit):
    return "-" if value is None else f"{float(f'{value:.2g}'):g}{unit}"


def shown(value):
    return "-" if value is None else f"{value:.5g}"
