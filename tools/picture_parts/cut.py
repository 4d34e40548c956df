"""A flat cut through the middle of a result, at the start and at the end, for bars."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from strut_tools import save_picture

from .result import Result, clock_of, stem, title
from .surface import edge_of


def mean_edge(result):
    volumes = [block.volumes for block in result.blocks]
    return edge_of(result.reference, None if any(v is None for v in volumes) else np.concatenate(volumes))


def stretched(reference, now, edge):
    """For each point of the cut, the 2 x 2 matrix that best maps the bonds to its nearest points onto their images."""
    count = reference.shape[1]
    maps = np.tile(np.eye(2), (count, 1, 1))
    for i in range(count):
        bonds = reference - reference[:, i:i + 1]
        near = (np.abs(bonds) <= 1.6 * edge).all(axis=0)
        shape = bonds[:, near] @ bonds[:, near].T
        if near.sum() >= 4 and np.linalg.cond(shape) < 100:
            maps[i] = (now[:, near] - now[:, i:i + 1]) @ bonds[:, near].T @ np.linalg.inv(shape)
    return maps


def cells(axes, reference, now, edge, colors, limits):
    """A square of the spacing for each point, deformed with its neighborhood."""
    corners = 0.52 * edge * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    outlines = now.T[:, None, :] + np.einsum("pij,cj->pci", stretched(reference, now, edge), corners)
    collection = PolyCollection(outlines, cmap="turbo", edgecolors="face", linewidths=0.2)
    collection.set_array(colors)
    collection.set_clim(*limits)
    axes.add_collection(collection)
    return collection


def picture(path, out, variable, axis):
    result = Result(path)
    times = result.times
    factor, unit = clock_of(np.abs(times).max())
    across, depth = (0, 1) if axis == "x" else (1, 0)
    reference, now = result.reference.T, (result.reference + result.displacement(-1)).T
    edge = mean_edge(result)
    # The layer of points nearest to the middle, about one spacing thick; the far one if the middle is between two.
    offset = reference[depth] - 0.5 * (reference[depth].min() + reference[depth].max())
    nearest = offset[np.abs(offset).argmin()]
    cut = np.abs(offset - abs(nearest)) <= 0.51 * edge
    before, after = (result.values(variable, frame)[cut] for frame in (0, -1))
    limits = (min(np.nanmin(before), np.nanmin(after)), max(np.nanmax(before), np.nanmax(after)))
    frames = [(reference, before, f"t = {factor * times[0]:.4g} {unit}"), (now, after, f"t = {factor * times[-1]:.4g} {unit}")]
    scale = 1e3  # mm
    half = scale * (0.75 * edge + max(np.abs(p[across][cut] - reference[across][cut].mean()).max() for p, _, _ in frames))
    middle = scale * reference[across][cut].mean()
    low = scale * (min(p[2][cut].min() for p, _, _ in frames) - edge)
    high = scale * (max(p[2][cut].max() for p, _, _ in frames) + edge)
    height = 5.6
    width = height * 0.82 * 2 * half / (high - low)
    figure, both = plt.subplots(1, 2, sharey=True, figsize=(max(4.2, 2 * width + 2.4), height), layout="constrained")
    for axes, (place, colors, text) in zip(both, frames):
        plane = [scale * p[[across, 2]][:, cut] for p in (reference, place)]
        drawn = cells(axes, *plane, scale * edge, colors, limits)
        axes.set_xlim(middle - half, middle + half)
        axes.set_ylim(low, high)
        axes.set_aspect("equal")
        axes.set_title(text, fontsize=11)
        axes.set_xlabel(f"{'xy'[across]}, mm")
        axes.spines[["top", "right"]].set_visible(False)
    both[0].set_ylabel("z, mm")
    figure.colorbar(drawn, ax=both, label=title(variable), shrink=0.8, aspect=30)
    figure.suptitle(stem(path), fontsize=12)
    save_picture(figure, out, dpi=110)
    plt.close(figure)
    return out
