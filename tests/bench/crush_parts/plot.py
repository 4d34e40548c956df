"""Error of the work against core-seconds, a panel a body."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

STYLES = {"quadratic": ("tab:purple", "o-"), "mean gradient, elements": ("tab:red", "s-"), "mean gradient, nodes": ("tab:red", "^--"),
          "Silling, elements": ("tab:blue", "s-"), "voxels, eight points": ("tab:orange", "D-"), "voxels, one point": ("tab:brown", "D--"),
          "tetrahedra, ten nodes": ("tab:green", "v-"), "tetrahedra, four nodes": ("tab:olive", "v--")}


def panel(axes, title, rows):
    for scheme, (color, style) in STYLES.items():
        mine = [row for row in rows if row.scheme == scheme and row.error is not None]
        axes.plot([row.seconds for row in mine], [max(abs(row.error), 1e-3) for row in mine], style, color=color, label=scheme)
        for row in mine:
            axes.annotate(f"{row.cells:g}", (row.seconds, max(abs(row.error), 1e-3)), fontsize=7, xytext=(3, 3), textcoords="offset points")
    axes.axhline(0.05, color="k", lw=0.5)
    axes.set(xscale="log", yscale="log", title=title, xlabel="core-seconds", ylabel="largest error of the work")
    axes.grid(alpha=0.3, which="both")


def draw(parts, path):
    """parts: (title, rows) of each body."""
    figure, panels = plt.subplots(1, len(parts), figsize=(5.5 * len(parts), 5.5), squeeze=False)
    for axes, (title, rows) in zip(panels[0], parts):
        panel(axes, title, rows)
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=4, frameon=False)
    figure.subplots_adjust(left=0.05, right=0.99, top=0.93, bottom=0.22, wspace=0.22)
    figure.savefig(path, dpi=100)
