"""The cost of each scheme at a given error: power laws through its rows."""
import math


def powers(rows):
    """Exponents with which errors and core-seconds go with the spacing: least squares of the logarithms."""
    x = [math.log(row["spacing"]) for row in rows]
    mean = sum(x) / len(x)
    weight = sum((a - mean) ** 2 for a in x)
    return [sum((a - mean) * math.log(abs(row[key])) for a, row in zip(x, rows)) / weight for key in ("error", "seconds")]


def seconds_at(rows, aim, count):
    """Between the two rows around the error where there are such, else by the `count` finest; rows from coarse to fine."""
    for before, after in reversed(list(zip(rows, rows[1:]))):
        if abs(before["error"]) > aim >= abs(after["error"]):
            error, seconds = powers([before, after])
            return after["seconds"] * (aim / abs(after["error"])) ** (seconds / error), "between rows"
    if abs(rows[-1]["error"]) <= aim:
        return rows[0]["seconds"], "already the coarsest"
    error, seconds = powers(rows[-count:])
    if error <= 0:
        return math.inf, "does not converge"
    return rows[-1]["seconds"] * (aim / abs(rows[-1]["error"])) ** (seconds / error), "beyond the finest"


def table(rows, aim):
    lines = [f"| points at | scheme | powers of the spacing: error, core-s | core-s at {100 * aim:g} %: by two finest rows | by three | |",
             "|---|---|---|---|---|---|"]
    schemes = dict.fromkeys((row["points"], row["stabilization"], row["horizon"]) for row in rows)
    for scheme in schemes:
        own = [row for row in rows if (row["points"], row["stabilization"], row["horizon"]) == scheme and row["error"]]
        own.sort(key=lambda row: -row["spacing"])
        if len(own) < 3:
            continue
        error, cost = powers(own[-2:])
        (two, how), (three, _) = seconds_at(own, aim, 2), seconds_at(own, aim, 3)
        lines.append(f"| {scheme[0]} | {scheme[1]} | {error:.2f}, {cost:.1f} | {two:.2g} | {three:.2g} | {how} |")
    return "\n".join(lines)
