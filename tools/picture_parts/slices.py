"""Three slices through the middle of a scan, and of the solid made from it."""
import matplotlib.pyplot as plt
import numpy as np
from strut_tools import save_picture

PLANES = (("z", "x", "y"), ("y", "x", "z"), ("x", "y", "z"))  # across, to the right, up


def slice_of(values, across):
    """A slice through the middle; rows go up."""
    axis = 2 - "xyz".index(across)
    return values.take(values.shape[axis] // 2, axis)


def draw(axes, values, cell, plane, **style):
    across, right, up = plane
    seen = slice_of(values, across)
    extent = [1e3 * n * cell["xyz".index(a)] for a, n in ((right, seen.shape[1]), (up, seen.shape[0]))]
    drawn = axes.imshow(seen.astype(float), origin="lower", extent=(0, extent[0], 0, extent[1]), interpolation="nearest", **style)
    axes.set(xlabel=f"{right}, mm", ylabel=f"{up}, mm")
    return drawn


def picture(path, title, values, cell, how, solid=None, solid_cell=None):
    """values: the scan (z, y, x), with voxel edges cell (m); solid: the kept part, or the numbers of materials."""
    rows = 1 if solid is None else 2
    figure, panels = plt.subplots(rows, 3, figsize=(13, 4.2 * rows), layout="constrained", squeeze=False)
    low, high = (float(f(slice_of(values, a))) for f, a in ((np.min, "z"), (np.max, "z")))
    for axes, plane in zip(panels[0], PLANES):
        drawn = draw(axes, values, cell, plane, cmap="gray", vmin=low, vmax=max(high, low + 1e-300))
        axes.set_title(f"scan, the middle of {plane[0]}", fontsize=10)
    figure.colorbar(drawn, ax=panels[0], shrink=0.8)
    if solid is not None:
        most = max(1, int(solid.max()))
        for axes, plane in zip(panels[1], PLANES):
            drawn = draw(axes, solid, solid_cell, plane, cmap=plt.get_cmap("viridis", most + 1), vmin=-0.5, vmax=most + 0.5)
            axes.set_title("what is kept" if most == 1 else "materials", fontsize=10)
        figure.colorbar(drawn, ax=panels[1], shrink=0.8, ticks=range(most + 1))
    figure.suptitle(f"{title}: {how}", fontsize=11)
    save_picture(figure, path)
