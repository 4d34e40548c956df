"""The three-dimensional picture of a result: a row per variable, a column per time."""
import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np
from strut_tools import fail, save_picture

from . import painter, rigid
from .result import Result, clock_of, stem, title, unit_of
from .surface import joined, surface_of

USUAL = ("Equivalent_Plastic_Strain", "Von_Mises_Stress")
GREY = np.array([0.72, 0.73, 0.75])
# Turbo without its darkest ends, which could be mistaken for shadow.
SCALE = matplotlib.colors.ListedColormap(plt.get_cmap("turbo")(np.linspace(0.1, 0.95, 256)))
PANEL = 760, 620  # pixels at most
DPI = 100


class Wanted:
    """The options of the command line."""

    def __init__(self, variables=None, view=(1, -2.2, 0.6), zoom=1, times=None, frames=None, blocks=None, clip=None,
                 glass=None, limits=None, hide=None, tools=()):
        self.variables, self.view, self.zoom, self.times, self.frames = variables, view, zoom, times, frames
        self.blocks, self.clip, self.glass, self.limits, self.hide = blocks, clip, glass, limits, hide
        self.tools = tools  # from rigid.tools_of


def variables_of(result, wanted):
    if wanted.variables:
        return wanted.variables
    there = [name for name in USUAL if result.has(name)]
    return there or ["Displacement"]


def frames_of(result, wanted):
    if wanted.times:
        for t in wanted.times:
            if not result.times[0] - 1e-12 <= t <= result.times[-1] * (1 + 1e-6):
                fail(f"{result.path} has times from {result.times[0]:.6g} s to {result.times[-1]:.6g} s; found {t:g}")
        return [int(np.abs(result.times - t).argmin()) for t in wanted.times]
    count = min(wanted.frames or 2, len(result.times))
    return [int(f) for f in np.rint(np.linspace(0, len(result.times) - 1, count))] if count > 1 else [len(result.times) - 1]


def blocks_of(result, names):
    """The named blocks, or all that have points."""
    known = {block.name: block for block in result.blocks}
    for name in names or ():
        if name not in known:
            fail(f"{result.path} has no block '{name}'; it has {', '.join(known)}")
    return [block for block in result.blocks if len(block.nodes) and (not names or block.name in names)]


def kept(result, block, clip, towards):
    """Nodes of the block, without those on the eye's side of the plane at a fraction of the box."""
    if not clip:
        return block.nodes
    axis, fraction = clip
    x = result.reference[:, axis]
    plane = x.min() + fraction * np.ptp(x)
    here = x[block.nodes]
    return block.nodes[here <= plane if towards[axis] > 0 else here >= plane]


def hidden_points(result, frame, hide):
    """For all points, True if a variable exceeds a value there; for instance damage, to look into cracks."""
    if not hide:
        return np.zeros(len(result.reference), bool)
    name, most = hide
    return np.nan_to_num(result.values(name, frame)) > most


def surface_of_blocks(result, blocks, wanted, frame):
    parts, hidden = [], hidden_points(result, frame, wanted.hide)
    for block in blocks:
        nodes = kept(result, block, wanted.clip, wanted.view)
        nodes = nodes[~hidden[nodes]]
        if len(nodes):
            volumes = block.volumes[np.isin(block.nodes, nodes)] if block.volumes is not None else None
            parts.append(surface_of(result.reference[nodes], volumes, nodes))
    return joined(parts) if parts else None


# Colors


class Row:
    """A variable: its values in the frames, and the scale."""

    def __init__(self, result, name, frames):
        # The last entry belongs to no point, but to rigid tools.
        self.name, self.values = name, [np.append(result.values(name, f), np.nan) for f in frames]
        self.grey = np.zeros(len(result.reference) + 1, bool)

    def idle(self, blocks):
        """Blocks in which it stays zero, such as plastic strain in an elastic plate; empty if it does in all blocks."""
        names = [b.name for b in blocks if not any(np.nan_to_num(v[b.nodes]).any() for v in self.values)]
        return names if len(names) < len(blocks) else []

    def scale(self, blocks, glass, limits):
        idle = self.idle(blocks)
        for block in blocks:
            self.grey[block.nodes] = block.name in glass or block.name in idle
        nodes = np.concatenate([b.nodes for b in blocks])
        nodes = nodes[~self.grey[nodes]]
        found = [v[nodes][np.isfinite(v[nodes])] for v in self.values]
        self.least, self.most = (f([f(v) for v in found if len(v)] or [0]) for f in (min, max))
        self.low, self.high = limits or self._usual_limits([v for v in found if len(v)])
        mega = unit_of(self.name) == "Pa"
        self.factor, self.label = (1e-6, title(self.name)[:-2] + "MPa") if mega else (1, title(self.name))

    def _usual_limits(self, found):
        """Limits without the last 0.2 % of the points at each end, which would take the colors from the others."""
        low = min([np.quantile(v, 0.002) for v in found] or [0])
        high = max([np.quantile(v, 0.998) for v in found] or [0])
        low = 0 if 0 <= self.least and low < 0.3 * high else low
        return (self.least, self.most) if high - low > 0.85 * (self.most - self.least) else (low, high)

    def colors(self, column, points):
        value = self.values[column][points]
        span = self.high - self.low
        color = SCALE((value - self.low) / (span if span > 0 else 1))[:, :3]
        color[self.grey[points] | ~np.isfinite(value)] = GREY
        return color

    def extend(self):
        below, above = self.least < self.low - 1e-9 * abs(self.low), self.most > self.high * (1 + 1e-9)
        return ("both" if below else "max") if above else ("min" if below else "neither")


class Drawn:
    """One surface in one frame, as the camera sees it: everything but its colors."""

    def __init__(self, surface, corners, camera):
        self.canvas = painter.canvas_of(corners, surface.quads, camera)
        normals = painter.corner_normals(corners, surface.quads)
        self.light, self.facing = painter.brightness(self.canvas, normals, surface.quads, camera)
        self.seen = (self.canvas.quad >= 0).reshape(self.canvas.shape)
        self.point = surface.point[self.canvas.quad].reshape(self.canvas.shape)

    def image(self, row, column):
        """Red, green, blue, alpha of the fine pixels; alpha has multiplied the colors."""
        image = np.zeros((*self.canvas.shape, 4))
        image[self.seen, :3] = row.colors(column, self.point[self.seen]) * self.light[self.seen, None]
        image[self.seen, 3] = 1
        return image


def with_glass(image, behind, glass, row, column):
    """Overlays a transparent surface where it is nearer; it is denser where it is seen at a slant."""
    front = glass.canvas.near > (behind.canvas.near if behind else -np.inf)
    share = np.where(front.reshape(glass.seen.shape), 0.22 + 0.5 * (1 - glass.facing)**2, 0)[..., None]
    over = glass.image(row, column)
    return share * over + (1 - share * over[..., 3:]) * image


# The figure


class Scene:
    """The variables and times, the camera, and its view at each time."""

    def __init__(self, result, wanted):
        self.name, self.frames = stem(result.path), frames_of(result, wanted)
        self.times = result.times[self.frames]
        blocks, named = blocks_of(result, wanted.blocks), [b.name for b in blocks_of(result, wanted.glass)]
        self.rows = [Row(result, name, self.frames) for name in variables_of(result, wanted)]
        idle = {name for row in self.rows for name in row.idle(blocks)}
        glass = named if wanted.glass else idle if wanted.glass is None else []
        for row in self.rows:
            row.scale(blocks, glass, wanted.limits)
        self._draw(result, [[b for b in blocks if (b.name in glass) == see_through] for see_through in (0, 1)], wanted)

    def _draw(self, result, layers, wanted):
        frames = self.frames if wanted.hide else self.frames[:1] * len(self.frames)
        found = {f: [surface_of_blocks(result, layer, wanted, f) for layer in layers] for f in set(frames)}
        surfaces = [[s and s.torn(result.displacement(now)) for s in found[f]] for f, now in zip(frames, self.frames)]
        if not all(any(both) for both in surfaces):
            fail("nothing is left to draw: " + ("--hide hides all of it" if wanted.hide else
                                                "the plane of --clip cuts all away"))
        self.camera = painter.Camera(wanted.view)
        moved = [[s and self.camera.seen(s.moved(result.displacement(f))) for s in both]
                 for f, both in zip(self.frames, surfaces)]
        corners = np.concatenate([c for layers in moved for c in layers if c is not None])
        tools = [self._tools(t, wanted.tools, corners @ self.camera.axes) for t in self.times]
        framed = np.concatenate([corners, *(near for _, _, near in filter(None, tools))])
        self.camera.frame(framed.min(axis=0), framed.max(axis=0), *PANEL, wanted.zoom)
        self.drawn = [[s and Drawn(s, c, self.camera) for s, c in zip(*pair)] for pair in zip(surfaces, moved)]
        self.tools = [found and Drawn(*found[:2], self.camera) for found in tools]

    def _tools(self, t, tools, places):
        """The surface of rigid tools at a time, its corners in view coordinates, and these corners as far as the
        picture extends: a margin around the positions of the bodies in any frame (places, m)."""
        if not tools:
            return None
        low, high = places.min(axis=0), places.max(axis=0)
        margin = rigid.MARGIN * np.max(high - low)
        offsets = [tool.offset(t) for tool in tools]
        parts = [tool.surface(low - u, high - u) for tool, u in zip(tools, offsets)]
        moved = np.concatenate([part.corners + u for part, u in zip(parts, offsets)])
        return joined(parts), self.camera.seen(moved), self.camera.seen(np.clip(moved, low - margin, high + margin))

    def image(self, row, column):
        solid, glass = self.drawn[column]
        image = solid.image(row, column) if solid else np.zeros((*glass.canvas.shape, 4))
        for layer in filter(None, (glass, self.tools[column])):
            image = with_glass(image, solid, layer, row, column)
        return painter.coarser(image)


def panels(camera, rows, columns):
    """The figure's size and the position of each panel, from the upper left, in pixels."""
    left, top, gap, bar, foot = 20, 66, 16, 120, 56
    pitch = max(camera.width + gap, 120)  # the least for a title
    places = {(r, c): (left + c * pitch + (pitch - gap - camera.width) // 2, top + r * (camera.height + gap))
              for r in range(rows) for c in range(columns)}
    width = left + columns * pitch + bar
    return max(width, 420), top + rows * (camera.height + gap) + foot - gap, places


def nice_length(most):
    """The largest of 1, 2, 5 times a power of ten that is not above `most`."""
    power = 10.0**np.floor(np.log10(most))
    return power * max(f for f in (1, 2, 5) if f * power <= most * (1 + 1e-9))


def add_measure(figure, camera, x, y, size):
    """A scale bar and the directions of the axes, under the first panel."""
    width, height = size
    length = nice_length(0.35 * camera.width * camera.pixel)
    power, unit = next((p, u) for p, u in ((1, "m"), (1e-3, "mm"), (1e-6, "µm"), (0, "m")) if length >= 0.999 * p)
    line = plt.Line2D([x / width, (x + length / camera.pixel) / width], [1 - y / height] * 2, color="0.15", linewidth=2)
    figure.add_artist(line)
    figure.text(x / width, 1 - (y + 6) / height, f"{length / (power or 1):g} {unit}", va="top", fontsize=9, color="0.15")
    x += max(length / camera.pixel, 40) + 45
    for name, axis in zip("xyz", camera.axes.T):
        if np.hypot(*axis[:2]) < 0.05:
            continue
        dx, dy = 24 * axis[0], 24 * axis[1]
        figure.add_artist(plt.Line2D([x / width, (x + dx) / width], [1 - (y + 8) / height, 1 - (y + 8 - dy) / height],
                                     color="0.15", linewidth=1))
        figure.text((x + 1.4 * dx) / width, 1 - (y + 8 - 1.4 * dy) / height, name, ha="center", va="center", fontsize=9)


def add_bar(figure, row, place, camera, size, bar=14):
    x, y = place
    height = min(0.86 * camera.height, 420)
    foot = y + 0.5 * (camera.height + height)
    axes = figure.add_axes([x / size[0], 1 - foot / size[1], bar / size[0], height / size[1]])
    low, high = row.factor * row.low, row.factor * row.high
    norm = matplotlib.colors.Normalize(low, high if high > low else low + 1)
    drawn = figure.colorbar(matplotlib.cm.ScalarMappable(norm, SCALE), cax=axes, extend=row.extend(), extendfrac=0.03)
    drawn.outline.set_visible(False)
    more = f"\n(up to {row.factor * row.most:.3g})" if row.extend() in ("max", "both") else ""
    drawn.set_label(row.label + more)


def figure_of(scene, rows):
    """A figure of some of the scene's rows."""
    camera, clock = scene.camera, clock_of(np.abs(scene.times).max())
    width, height, places = panels(camera, len(rows), len(scene.frames))
    figure = plt.figure(figsize=(width / DPI, height / DPI), dpi=DPI)
    for (r, c), (x, y) in places.items():
        axes = figure.add_axes([x / width, 1 - (y + camera.height) / height, camera.width / width, camera.height / height])
        image = scene.image(rows[r], c)
        axes.imshow(np.clip(image[..., :3] + 1 - image[..., 3:], 0, 1), interpolation="none")
        axes.axis("off")
        if r == 0:
            axes.set_title(f"t = {clock[0] * scene.times[c]:.4g} {clock[1]}", fontsize=11)
        if c == len(scene.frames) - 1:
            add_bar(figure, rows[r], (x + camera.width + 24, y), camera, (width, height))
    add_measure(figure, camera, places[0, 0][0] + 8, height - 40, (width, height))
    figure.suptitle(scene.name, fontsize=12, y=1 - 10 / height, va="top")
    return figure


def save(figure, out):
    save_picture(figure, out, dpi=DPI)
    plt.close(figure)
    return out


def picture(path, out, wanted):
    """One picture, a row for each variable."""
    scene = Scene(Result(path), wanted)
    save(figure_of(scene, scene.rows), out)


def pictures(path, file_of, wanted):
    """A picture for each variable, file_of(its name); yields their names one by one."""
    scene = Scene(Result(path), wanted)
    for row in scene.rows:
        yield save(figure_of(scene, [row]), file_of(row.name))
