"""Finds solid voxels, and selects those to keep. Arrays are (z, y, x), edges of a voxel (x, y, z) in m."""
import numpy as np
from scipy import ndimage
from scipy.optimize import brentq

from strut_tools import fail

NEIGHBORS = [(z, y, x) for z in (-1, 0, 1) for y in (-1, 0, 1) for x in (-1, 0, 1) if (z, y, x) != (0, 0, 0)]


# Grey values to solid


def histogram(values):
    """Counts and their values: each value for a small range of integers, else 4096 classes."""
    low, high = values.min(), values.max()
    whole = np.issubdtype(values.dtype, np.integer) and int(high) - int(low) < 2**20
    if not whole:
        counts, edges = np.histogram(values, 4096, (float(low), float(high)))
        return counts, edges[1:]
    counts = sum(np.bincount(layer.reshape(-1).astype(np.int64) - int(low), minlength=int(high) - int(low) + 1)
                 for layer in values)  # layer by layer, because a copy with eight bytes per voxel would be large
    return counts, np.arange(int(low), int(high) + 1)


def otsu(counts, levels):
    """Otsu 1979: the threshold with the largest variance between the classes; the middle one of several."""
    levels = levels.astype(float)
    below = np.cumsum(counts)[:-1].astype(float)
    above = counts.sum() - below
    sums = np.cumsum(counts * levels)
    mean_below = sums[:-1] / np.maximum(below, 1)
    mean_above = (sums[-1] - sums[:-1]) / np.maximum(above, 1)
    between = np.where((below > 0) & (above > 0), below * above * (mean_above - mean_below)**2, 0)
    best = np.flatnonzero(between >= between.max() * (1 - 1e-12))
    return levels[best[len(best) // 2]]


def padding_told(values, threshold, counts, levels):
    """Words on a value that only the surroundings of the image have, in columns through all of it, where Otsu's threshold
    differs without it; else nothing."""
    there = values == values[0, 0, 0]
    through = max((there.all(axis) for axis in range(3)), key=np.mean)
    share = through.mean()
    if not 0.01 < share < 1 or there.mean() - share > 0.01 * (1 - share):  # the void has it, too
        return ""
    without = otsu(np.where(np.arange(len(levels)) == np.searchsorted(levels, values[0, 0, 0]), 0, counts), levels)
    parts = np.count_nonzero((values > without) & ~there), np.count_nonzero((values > threshold) & ~there)
    if abs(parts[0] - parts[1]) <= 0.02 * max(parts):
        return ""
    return (f"; WARNING: {100 * share:.3g} % of the voxels, in columns through all of the image, have the value {values[0, 0, 0]:g}, and few "
            f"others: if they are outside of the field of view, expected --threshold {without:g}, Otsu's without them")


def two_valued(values):
    low, high = values.min(), values.max()
    return all(((layer == low) | (layer == high)).all() for layer in values)


def check_finite(path, values):
    if not np.isfinite(values).all():
        fail(f"{path}: {np.count_nonzero(~np.isfinite(values))} voxels are not finite")


def solid_of(path, values, threshold, invert, may_fill=False):
    """Solid or not, and a sentence about the method. threshold None: Otsu's if there are more than two values. may_fill: all may be solid."""
    if values.dtype == bool:
        if threshold is not None or invert:
            fail(f"{path} says itself which voxels are solid: --threshold, --otsu and --invert do not apply")
        return values, "none needed: the list says what is solid"
    if not np.issubdtype(values.dtype, np.number) or np.iscomplexobj(values):
        fail(f"{path} has values of type {values.dtype}, expected numbers")
    check_finite(path, values)
    low, high = values.min(), values.max()
    if low == high and not may_fill:
        fail(f"{path}: all voxels have the value {low:g}, so that nothing tells solid from void")
    how, told = "as given", ""
    if threshold is None and two_valued(values):
        threshold, how = low, f"none needed: two values, {low:g} and {high:g}"
    elif threshold is None or threshold == "otsu":
        found = histogram(values)
        threshold, how = otsu(*found), "by Otsu's method"
        told = padding_told(values, threshold, *found)
    solid = values <= threshold if invert else values > threshold
    if not solid.any() or solid.all() and not may_fill:
        fail(f"{path}: at the threshold {threshold:g} every voxel is {'solid' if solid.any() else 'void'}; "
             f"the values go from {low:g} to {high:g}")
    if how.startswith("none"):
        return solid, f"{how}; solid is {low if invert else high:g}"
    return solid, f"{threshold:g}, {how}; solid is {'<=' if invert else '>'} it{told}"


def materials_of(path, values, ranges):
    """The number of each voxel's material, 1, 2, …; 0: void. ranges: (name, low, high), for low < value <= high."""
    if values.dtype == bool:
        fail(f"{path} says itself which voxels are solid: --material does not apply")
    check_finite(path, values)
    out = np.zeros(values.shape, np.uint8)
    for number, (name, low, high) in enumerate(ranges, 1):
        there = (values > low) & (values <= high)
        if not there.any():
            fail(f"{path}: no voxel is of the material '{name}', from {low:g} to {high:g}; the values go from "
                 f"{values.min():g} to {values.max():g}")
        out[there] = number
    return out


# Grey values to the solid fraction of a voxel


def levels_of(values, solid, cell):
    """The levels of void and of solid: the median of the void, and that of the centers of thick parts, which the blur
    of an image affects least. Means on both sides of the threshold would include half-filled voxels, and give thin
    struts a fifth or more of excess mass. Thick parts are the half by thickness cubed, so that specks do not count."""
    void = np.concatenate([layer[~there] for layer, there in zip(values, solid)])
    places, distance, ridge = ridge_of(solid, cell)
    values, distance = values[places][ridge], distance[ridge].astype(float)
    order = np.argsort(-distance, kind="stable")
    share = np.cumsum(distance[order]**3)
    thick = distance >= distance[order][np.searchsorted(share, 0.5 * share[-1])]
    return float(np.median(void)), float(np.median(values[thick]))


def level_for(values, void, solid, dropped, count):
    """The level of solid at which the kept voxels and their rims sum up to `count` whole voxels."""
    sign = 1 if values[solid].mean() > void else -1
    above = sign * (values - np.float32(void))
    above = above[with_rims(solid, dropped, above)].astype(float)
    if not len(above) > count:
        fail(f"--density: kept voxels and their rims are {len(above):,}, fewer than the {count:.0f} that are wanted")
    most = 2 * above.sum() / count  # no voxel is more than full, and the sum is half of what is wanted
    level = brentq(lambda level: np.minimum(above / level, 1).sum() - count, above.min(), most, xtol=1e-12 * most)
    return void + sign * level


def threshold_for(values, invert, count, kept):
    """The threshold at which kept(solid or not) has the number of voxels nearest to count: the loss by pieces and spurs
    is compensated by iteration."""
    counts, levels = histogram(values)
    above = np.cumsum(counts[::1 if invert else -1])
    wanted, best = count, None
    for _ in range(12):
        at = int(np.argmin(np.abs(above - wanted)))
        threshold = float(levels[at] if invert else levels[max(len(levels) - 2 - at, 0)])
        solid = values <= threshold if invert else values > threshold
        if not solid.any() or solid.all():
            break
        got = np.count_nonzero(kept(solid))
        if best is None or abs(got - count) < abs(best[1] - count):
            best = threshold, got
        elif got == best[1]:
            break
        if got == 0 or abs(got - count) <= 2e-4 * count:
            break
        wanted *= count / got
    if best is None:
        fail("--density: no threshold gives such a body")
    return best[0]


def without_inner_noise(values, solid):
    """Voxels with 26 solid neighbors get the mean of their layer, the first or all that are deeper: a voxel is at most full, so
    that noise would only take mass away. At a surface it also gives, in the rim (with_rims). Outside of the box is no void."""
    first, deeper = (ndimage.binary_erosion(solid, np.ones((3, 3, 3), bool), n, border_value=1) for n in (1, 2))
    out = values.astype(np.float32)
    for layer in (first & ~deeper, deeper):
        if layer.any():
            out[layer] = out[layer].mean(dtype=float)
    return out


def fills_of(values, void, level):
    """0 at the level of void, 1 at that of solid, linear in between."""
    return np.clip((values.astype(np.float32) - np.float32(void)) / np.float32(level - void), 0, 1)


def with_rims(solid, dropped, fills):
    """The kept voxels and those around them with a solid fraction; without dropped ones."""
    around = ndimage.binary_dilation(solid, np.ones((3, 3, 3), bool))
    return around & ~dropped & (fills > 0)


# Crop, refine, coarsen


def cropped(solid, crop):
    """crop: x0 x1 y0 y1 z0 z1, fractions of the box, rounded to whole voxels."""
    ranges = []
    for axis, n in enumerate(solid.shape[::-1]):
        low, high = (int(np.rint(f * n)) for f in crop[2 * axis:2 * axis + 2])
        if low >= high:
            fail(f"--crop leaves no voxel in {'xyz'[axis]}: {crop[2 * axis]:g} to {crop[2 * axis + 1]:g} of {n}")
        ranges.append(slice(low, high))
    return solid[tuple(ranges[::-1])]


def coarsened(solid, n):
    """n x n x n -> 1, solid if at least half is. The remainder at the upper faces is cut off."""
    counts = [size // n for size in solid.shape]
    if 0 in counts:
        fail(f"--coarsen {n}: the image has only {' x '.join(map(str, solid.shape[::-1]))} voxels")
    return 2 * blockwise(solid, counts, n).sum(axis=(1, 3, 5), dtype=np.int64) >= n**3


def blockwise(values, counts, n):
    """A view of the first n^3 voxels in each of the counts: [z, n, y, n, x, n]."""
    cut = values[tuple(slice(n * count) for count in counts)]
    return cut.reshape([size for count in counts for size in (count, n)])


def coarsened_materials(materials, n):
    """The most frequent material of the n x n x n voxels that are solid; 0 where coarsened() has void."""
    solid = coarsened(materials > 0, n)
    best, out = np.zeros(solid.shape, np.int64), np.zeros(solid.shape, np.uint8)
    for number in range(1, int(materials.max()) + 1):
        counts = blockwise(materials == number, solid.shape, n).sum(axis=(1, 3, 5))
        out[counts > best] = number
        best = np.maximum(best, counts)
    return np.where(solid, out, 0).astype(np.uint8)


def resampled(solid, cell, edge):
    """Cubes of this edge; each gets the voxel that contains its center. The box becomes a whole number of cubes."""
    out = solid
    for axis, length in enumerate(cell):
        size = solid.shape[2 - axis]
        count = int(np.rint(size * length / edge))
        if count < 1:
            fail(f"--spacing {edge:g} m is more than twice the box in {'xyz'[axis]}: {size * length:g} m")
        places = np.minimum(((np.arange(count) + 0.5) * edge / length).astype(np.int64), size - 1)
        out = out.take(places, 2 - axis)
    return out


# Pieces and spurs


def largest_pieces(solid, keep):
    """The `keep` largest pieces connected through faces (0: all), and the sizes of all, largest first."""
    labels, count = ndimage.label(solid)
    sizes = np.bincount(labels[solid], minlength=count + 1)
    order = np.argsort(-sizes[1:], kind="stable") + 1
    if keep and keep < count:
        kept = np.zeros(count + 1, bool)
        kept[order[:keep]] = True
        solid = kept[labels]
    return solid, sizes[order]


def without_spurs(solid, least):
    """Repeatedly removes voxels with fewer than `least` of the 26 neighbors; also returns how many had so few at first.
    Voxels outside the box count as void."""
    padded = np.pad(solid, 1)
    flat, counts = padded.reshape(-1), padded.astype(np.uint8)
    for axis in range(3):  # the padding is void: nothing comes around
        counts = sum(np.roll(counts, shift, axis) for shift in (-1, 0, 1))
    counts = (counts - padded).reshape(-1)
    steps = np.array(NEIGHBORS) @ [padded.shape[1] * padded.shape[2], padded.shape[2], 1]
    few = np.flatnonzero(flat & (counts < least))
    at_first = len(few)
    while len(few):
        flat[few] = False
        around = (few[:, None] + steps).reshape(-1)
        around = around[flat[around]]
        np.subtract.at(counts, around, 1)
        around = np.unique(around)
        few = around[counts[around] < least]
    return padded[1:-1, 1:-1, 1:-1], at_first


def kept_of(solid, pieces, spurs, least):
    """Removes pieces and spurs until neither changes. Returns the solid and a sentence about each."""
    voxels = np.count_nonzero(solid)
    solid, sizes = largest_pieces(solid, pieces)
    kept = np.count_nonzero(solid)
    others = ", ".join(f"{s:,}" for s in sizes[pieces:pieces + 5]) + (", ..." if len(sizes) > pieces + 5 else "")
    if kept == voxels:
        about = f"{len(sizes):,}, all kept: {kept:,} voxels"
    else:
        about = (f"{len(sizes):,}, the {f'{pieces} ' if pieces > 1 else ''}largest kept: {kept:,} of {voxels:,} voxels "
                 f"({100 * kept / voxels:.2f} %); the others have {others}")
    stripped, few = without_spurs(solid, least)
    gone = kept - np.count_nonzero(stripped)
    text = f"{few:,} voxels have fewer than {least} of 26 neighbors"
    if spurs == "report":
        return solid, about, text + (f"; --spurs drop would take {gone:,}" if few else "")
    while stripped.any():
        solid, now = largest_pieces(stripped, pieces)
        stripped, few = without_spurs(solid, least)
        if not few and np.count_nonzero(solid) == np.count_nonzero(stripped):
            break
    if not stripped.any():
        fail(f"--spurs drop with --min-neighbors {least} leaves nothing")
    lost = kept - np.count_nonzero(stripped)
    apart = f", {lost - gone:,} more with what they held" if lost > gone else ""
    return stripped, about, f"{text}; {gone:,} dropped, one after the other{apart}"


# Properties


def faces_touched(solid):
    return [f"{letter}{side}" for axis, letter in ((2, "x"), (1, "y"), (0, "z"))
            for end, side in ((0, "min"), (-1, "max")) if solid.take(end, axis).any()]


def thickness(solid, cell):
    """Mean and largest local thickness, m, or None without void: twice the distance to the center of the nearest void
    voxel, at voxels where none of the 26 neighbors has a larger one (the ridge). The mean is weighted by the section,
    thickness squared, because steps of a surface, which are small ridges too, would dominate it otherwise. It is close
    to the mean over the volume: for the CT foam 192 um where spheres fitted into the solid at every voxel give 180 um,
    and 187 to 202 um for the same foam at half to twice the resolution. A plate along the axes of an odd number of
    voxels gets one too many. Outside of the box is no void: a strut cut by it is not thinner there."""
    if solid.all():
        return None
    _, there, ridge = ridge_of(solid, cell)
    local = 2 * there[ridge].astype(float)
    return float((local**3).sum() / (local**2).sum()), float(local.max())


def ridge_of(solid, cell):
    """The positions of the solid voxels; the distance of each from the center of the nearest void one, m; and True if
    none of its 26 neighbors has a larger one."""
    places = np.nonzero(solid)
    # Indices only: scipy's distances take eight times as much memory.
    nearest = ndimage.distance_transform_edt(solid, cell[::-1], return_distances=False, return_indices=True)
    squared = sum(((nearest[a][places] - places[a]) * cell[2 - a])**2 for a in range(3))
    del nearest
    distance = np.zeros(solid.shape, np.float32)
    distance[places] = np.sqrt(squared)
    there = distance[places]
    return places, there, there >= ndimage.maximum_filter(distance, 3)[places]
