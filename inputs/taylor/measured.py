"""Copper bars that were measured, cold and hot, beside three laws with constants from the literature; none is fitted."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/shared"))
from exodus import field_in  # noqa: E402
from strut_tools import history_of, install_missing, percent, run_deck, seconds_of_phase  # noqa: E402

install_missing("numpy", "netCDF4", "matplotlib")
import netCDF4  # noqa: E402
import numpy as np  # noqa: E402

HERE = ROOT / "inputs/taylor"

# The deck that has the law, and what it is called.
LAWS = {"Johnson-Cook": "taylor-190", "Zerilli-Armstrong": "taylor-190-zerilli", "threshold": "taylor-hot"}

# OFHC copper, 295 K (Johnson & Cook 1983; Zerilli & Armstrong 1987): m/s: length, foot, width at 0.2 of the first length, mm.
COLD = {130: (19.56, 9.91, 8.92), 190: (16.21, 13.56, 10.10)}
# Copper (Gust 1982): K, m/s, last length over first.
HOT = ((295, 138, 0.730), (295, 165, 0.705), (295, 180, 0.667), (713, 138, 0.688), (733, 185, 0.574), (1235, 157, 0.425))
# Outlines of recovered bars: radius, height, mm (collected by B. Banerjee).
OUTLINES = {
    ("cold", 295, 130): ((4.765, 0), (4.593, 2.067), (4.464, 4.099), (4.455, 6.037), (4.446, 8.181), (4.360, 10.075),
                         (4.266, 12.012), (4.214, 13.993), (4.077, 15.818), (3.819, 17.755), (3.810, 19.649)),
    ("cold", 295, 190): ((6.842, 0), (6.408, 0.584), (6.012, 1.137), (5.615, 1.657), (5.396, 2.014), (5.107, 3.214),
                         (5.074, 4.061), (5.000, 5.782), (4.892, 7.536), (4.748, 8.639), (4.529, 9.970),
                         (4.314, 11.464), (4.099, 12.797), (3.917, 13.868), (3.880, 15.005), (3.810, 16.205)),
    ("hot", 718, 188): ((5.436, 0), (4.712, 0.853), (4.612, 2.041), (4.582, 3.229), (4.615, 4.141), (4.585, 4.981),
                        (4.449, 6.176), (4.313, 7.223), (4.073, 8.344), (3.870, 9.465), (3.598, 10.868),
                        (3.388, 11.707), (3.219, 12.902), (3.152, 13.949), (2.983, 15.071), (2.953, 16.675))}
LENGTH, RADIUS = {"cold": 25.4, "hot": 30.0}, {"cold": 3.81, "hot": 3.0}  # mm
DEFAULT_SPACING = "0.00035"  # m
MESH = {"cold": "bar-190", "hot": "bar-hot"}


class Bar:
    """One bar by one law, run in a folder; lengths in mm."""

    def __init__(self, work, law, kind, kelvin, speed, spacing=DEFAULT_SPACING):
        self.kind, self.law = kind, law
        name = f"{kind}-{kelvin}-{speed}-{law}-{spacing}"
        mesh = f"{kind}-{spacing}"
        recipe = (HERE / f"{MESH[kind]}.recipe").read_text()
        (work / f"{mesh}.recipe").write_text(recipe.replace("0.0005", spacing))
        deck = (HERE / f"{LAWS[law]}.xml").read_text()
        deck = re.sub(r'"bar-\w+\.g"', f'"{mesh}.g"', deck).replace(f"{LAWS[law]}.", f"{name}.")
        for key, value in (("Value", -speed), ("Initial Temperature", kelvin)):
            deck = re.sub(rf'(name="{key}" type="\w+" value=)"[^"]*"', rf'\1"{value}"', deck)
        deck = re.sub(r'(name="Final Time".*?value=)"[^"]*"', r'\1"%s"' % {"cold": "80e-6", "hot": "120e-6"}[kind], deck)
        (work / f"{name}.xml").write_text(deck)
        run_deck(work / f"{name}.xml", work, ranks=2)
        self.report = (work / f"{name}.log").read_text()
        self.last = history_of(work / f"{name}.csv")[-1]
        self.radius, self.height = self.outline(work / f"{name}.e")
        self.length = 1e3 * (float(self.last["Max_Coordinate_Z"]) - float(self.last["Min_Coordinate_Z"]))
        self.foot = 2e3 * float(self.last["Max_Radial_Distance(bar_zmin)"])
        self.width = 2 * float(np.interp(0.2 * LENGTH[kind], self.height, self.radius))

    def outline(self, path):
        """The side of the bar at the end: mean radius and height over the foot of each ring of points, rising."""
        with netCDF4.Dataset(path) as file:
            start = np.stack([file[f"coord{c}"][:] for c in "xyz"], axis=1)
            moved = [field_in(file, "Displacement" + c)[-1] for c in "XYZ"]
        now = start + np.stack(moved, axis=1)
        side = np.hypot(start[:, 0], start[:, 1]) > (1 - 1e-6) * np.hypot(start[:, 0], start[:, 1]).max()
        layers = np.round(1e9 * start[side, 2]).astype(int)
        at = [layers == layer for layer in np.unique(layers)]
        radius = [1e3 * np.hypot(now[side][a, 0], now[side][a, 1]).mean() for a in at]
        height = [1e3 * (now[side][a, 2].mean() - now[:, 2].min()) for a in at]
        return np.array(radius), np.array(height)

    def misses_outline(self, measured):
        """Mean distance in radius from the measured outline below the bar's end, mm."""
        within = [(r, h) for r, h in measured if h <= self.height[-1]]
        return float(np.mean([abs(np.interp(h, self.height, self.radius) - r) for r, h in within]))


def cold(work):
    lines = ["| law | m/s | L_f, mm | D_f | W | mean error, both | outline, mm | hottest, K | balance error |",
             "|---|---|---|---|---|---|---|---|---|"]
    bars = {}
    for law in LAWS:
        errors, rows = [], []
        for speed, known in COLD.items():
            bar = bars[law, "cold", 295, speed] = Bar(work, law, "cold", 295, speed)
            pairs = list(zip((bar.length, bar.foot, bar.width), known))
            errors += [100 * abs(value / right - 1) for value, right in pairs]
            cells = [f"{value:.2f} ({percent(value, right)})" for value, right in pairs]
            rows.append([law, str(speed), *cells, "", f"{bar.misses_outline(OUTLINES['cold', 295, speed]):.2f}",
                         f"{float(bar.last['Max_Temperature']):.0f}", f"{float(bar.last['Balance_Error']):.1e}"])
        rows[-1][5] = f"{np.mean(errors):.1f} %"
        lines += ["| " + " | ".join(row) + " |" for row in rows]
    return lines, bars


def hot(work):
    head = " | ".join(f"{kelvin} K, {speed} m/s" for kelvin, speed, _ in HOT)
    lines = [f"| law | {head} |", "|---" * (len(HOT) + 1) + "|",
             "| measured L_f/L₀ | " + " | ".join(f"{known:.3f}" for *_, known in HOT) + " |"]
    for law in LAWS:
        cells = []
        for kelvin, speed, known in HOT:
            bar = Bar(work, law, "hot", kelvin, speed, "0.0005")
            kept = bar.length / LENGTH["hot"]
            cells.append(f"{kept:.3f} ({percent(kept, known)})")
        lines.append(f"| {law} | " + " | ".join(cells) + " |")
    return lines


def spacings(work, bars):
    lines = ["| spacing, mm | points | L_f | D_f | W | steps | 2 ranks |", "|---|---|---|---|---|---|---|"]
    of_cold = bars["Zerilli-Armstrong", "cold", 295, 190]
    for spacing in ("0.0008", "0.0005", DEFAULT_SPACING, "0.00025"):
        bar = of_cold if spacing == DEFAULT_SPACING else Bar(work, "Zerilli-Armstrong", "cold", 295, 190, spacing)
        points = re.search(r"(\d+) points, \d+ bonds", bar.report).group(1)
        steps = re.search(r"(\d+) steps,", bar.report).group(1)
        seconds = seconds_of_phase(bar.report, "whole run")
        lines.append(f"| {1e3 * float(spacing):g} | {points} | {bar.length:.2f} | {bar.foot:.2f} | {bar.width:.2f} | "
                     f"{steps} | {seconds:.0f} s |")
    return lines


def draw(work, bars, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    bars = dict(bars)
    for law in LAWS:
        bars[law, "hot", 718, 188] = Bar(work, law, "hot", 718, 188)
    figure, panels = plt.subplots(1, len(OUTLINES), figsize=(11, 5), sharey=True)
    for axes, ((kind, kelvin, speed), measured) in zip(panels, OUTLINES.items()):
        for law in LAWS:
            bar = bars[law, kind, kelvin, speed]
            axes.plot(bar.radius, bar.height, label=law)
        axes.plot(*zip(*measured), "k.", label="measured")
        axes.set_title(f"{kelvin} K, {speed} m/s")
        axes.set_xlabel("radius, mm")
    panels[0].set_ylabel("height, mm")
    panels[0].legend()
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def tables(work):
    lines, bars = cold(work)
    draw(work, bars, ROOT / "docs/taylor-measured.png")
    return "\n".join([*lines, "", *hot(work), "", *spacings(work, bars)])
