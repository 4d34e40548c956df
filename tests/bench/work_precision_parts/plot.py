"""Error against core-seconds, a panel a case; the Pareto front is drawn through."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLORS = {"none": "tab:gray", "Silling": "tab:blue", "Mean": "tab:red", "ordinary": "tab:green", "quadratic": "tab:purple",
           "finite": "tab:orange"}
NAMES = {"Mean": "mean gradient", "finite": "voxel finite elements"}


def panel(axes, case, rows):
    rows = [row for row in rows if row["error"]]
    for row in rows:
        nodes = row["points"] == "nodes"
        axes.plot(row["seconds"], abs(row["error"]), "o" if nodes else "s", mfc="none" if row["horizon"] == "3.015" else None,
                  color=COLORS[row["stabilization"].split()[0]], ms=7)
    front = sorted((row["seconds"], abs(row["error"])) for row in rows if row["front"])
    axes.plot(*zip(*front), "k-", lw=1, zorder=0)
    axes.set(xscale="log", yscale="log", title=case.title, xlabel="core-seconds", ylabel="relative error")
    axes.grid(alpha=0.3, which="both")


def front(cases, path):
    cases = [(case, rows) for case, rows in cases if rows]
    figure, axes = plt.subplots(2, 3, figsize=(15, 9.5))
    figure.subplots_adjust(left=0.05, right=0.98, top=0.96, bottom=0.12, hspace=0.25, wspace=0.2)
    for one, (case, rows) in zip(axes.flat, cases):
        panel(one, case, rows)
    for one in axes.flat[len(cases):]:
        one.axis("off")
    marks = [plt.Line2D([], [], ls="", marker="o", color=color, label=NAMES.get(name, name))
             for name, color in COLORS.items()]
    marks += [plt.Line2D([], [], ls="", marker=m, color="k", mfc=face, label=label) for m, face, label in
              (("o", "k", "points at nodes"), ("s", "k", "points at elements"), ("o", "none", "horizon 3 spacings"))]
    marks.append(plt.Line2D([], [], color="k", lw=1, label="Pareto front"))
    figure.legend(handles=marks, loc="lower center", ncol=5, frameon=False)
    figure.savefig(path, dpi=110)
