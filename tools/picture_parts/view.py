"""The three-dimensional picture of a result: a row per variable, a column per time."""
import dataclasses

import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image
from strut_tools import fail, save_picture

from . import rigid
from .painter import MOST_POINTS, Camera, Glass, Painter, Solid, coarser
from .result import Result, clock_of, stem, title, unit_of
from .surface import joined, places_of, polydata, surface_of

USUAL = ("Equivalent_Plastic_Strain", "Von_Mises_Stress")
GREY = np.array([0.72, 0.73, 0.75])
# Turbo without its darkest ends, which could be mistaken for shadow.
SCALE = matplotlib.colors.ListedColormap(plt.get_cmap("turbo")(np.linspace(0.1, 0.95, 256)))
PANEL = 760, 620  # pixels at most
DPI = 100
PAUSE = 60  # ms between the pictures of a movie


@dataclasses.dataclass
class Wanted:
    """The request of the command line."""
    variables: list = None
    view: tuple = (1, -2.2, 0.6)
    zoom: float = 1
    times: list = None
    frames: int = None
    blocks: list = None
    clip: tuple = None
    glass: list = None
    limits: list = None
    hide: tuple = None
    tools: tuple = ()  # of rigid.tools_of


def frames_of(result, wanted):
    if wanted.times:
        for t in wanted.times:
            if not result.times[0] - 1e-12 <= t <= result.times[-1] * (1 + 1e-6):
                fail(f"{result.path} has times from {result.times[0]:.6g} s to {result.times[-1]:.6g} s; found {t:g}")
        return [int(np.abs(result.times - t).argmin()) for t in wanted.times]
    count = min(wanted.frames or 2, len(result.times))
    return [int(f) for f in np.rint(np.linspace(0, len(result.times) - 1, count))] if count > 1 else [len(result.times) - 1]


def kept(result, block, clip, towards):
    """Nodes of the block, less those on the eye's side of the plane at a fraction of the box."""
    if not clip:
        return block.nodes
    axis, fraction = clip
    x = result.reference[:, axis]
    plane = x.min() + fraction * np.ptp(x)
    here = x[block.nodes]
    return block.nodes[here <= plane if towards[axis] > 0 else here >= plane]


def surface_of_blocks(result, blocks, wanted, frame):
    parts, hidden = [], np.zeros(len(result.reference), bool)
    if wanted.hide:  # points at which a variable exceeds a value: damage, for example, to see into cracks
        name, most = wanted.hide
        hidden = np.nan_to_num(result.values(name, frame)) > most
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
        self.result, self.name, self.frames = result, name, frames
        self.grey = np.zeros(len(result.reference), bool)

    def values(self, column):
        return self.result.values(self.name, self.frames[column])

    def idle(self, blocks):
        """Blocks in which it stays zero, as plastic strain does in an elastic plate; none where it does so in all."""
        columns = [self.values(column) for column in range(len(self.frames))]
        names = [b.name for b in blocks if not any(np.nan_to_num(v[b.nodes]).any() for v in columns)]
        return names if len(names) < len(blocks) else []

    def scale(self, blocks, glass, limits):
        idle = self.idle(blocks)
        for block in blocks:
            self.grey[block.nodes] = block.name in glass or block.name in idle
        nodes = np.concatenate([b.nodes for b in blocks])
        nodes = nodes[~self.grey[nodes]]
        found = [v[np.isfinite(v)] for v in (self.values(column)[nodes] for column in range(len(self.frames)))]
        self.least, self.most = (f([f(v) for v in found if len(v)] or [0]) for f in (min, max))
        self.low, self.high = limits or self._usual_limits([v for v in found if len(v)])
        mega = unit_of(self.name) == "Pa"
        self.factor, self.label = (1e-6, title(self.name)[:-2] + "MPa") if mega else (1, title(self.name))

    def _usual_limits(self, found):
        """All but the last 0.2 % of the points at each end, which would take the colors from the others."""
        low = min([np.quantile(v, 0.002) for v in found] or [0])
        high = max([np.quantile(v, 0.998) for v in found] or [0])
        low = 0 if 0 <= self.least and low < 0.3 * high else low
        return (self.least, self.most) if high - low > 0.85 * (self.most - self.least) else (low, high)

    def colors(self, column):
        """Colors of all points."""
        value, span = self.values(column), self.high - self.low
        color = SCALE((value - self.low) / (span if span > 0 else 1))[:, :3]
        color[self.grey | ~np.isfinite(value)] = GREY
        return color

    def extend(self):
        below, above = self.least < self.low - 1e-9 * abs(self.low), self.most > self.high * (1 + 1e-9)
        return ("both" if below else "max") if above else ("min" if below else "neither")


# The figure


class Scene:
    """The variables and times, the camera, and what it sees."""

    def __init__(self, result, wanted):
        self.result, self.wanted, self.name, self.frames = result, wanted, stem(result.path), frames_of(result, wanted)
        self.times = result.times[self.frames]
        if len(result.reference) > MOST_POINTS:
            fail(f"{result.path} has {len(result.reference)} points, of which {MOST_POINTS} can be drawn")
        blocks = [b for b in result.blocks_of(wanted.blocks) if len(b.nodes)]
        named = [b.name for b in result.blocks_of(wanted.glass)]
        variables = wanted.variables or [name for name in USUAL if result.has(name)] or ["Displacement"]
        self.rows = [Row(result, name, self.frames) for name in variables]
        idle = {name: row.name for row in self.rows for name in row.idle(blocks)} if wanted.glass is None else {}
        glass = named if wanted.glass else idle
        for block, name in idle.items():
            print(f"block '{block}' is grey glass for all variables, as {name} stays 0 in it; --glass without a name draws it solid", flush=True)
        for row in self.rows:
            row.scale(blocks, glass, wanted.limits)
        self.layers = [[b for b in blocks if (b.name in glass) == see_through] for see_through in (False, True)]
        self.camera, self.painter, self.surfaces = Camera(wanted.view), Painter(), {}
        self._frame()

    def moved(self, column):
        """Corners and quads at that time of the solid blocks and of those of glass, and their points; None where there is none."""
        frame = self.frames[column if self.wanted.hide else 0]
        if frame not in self.surfaces:
            self.surfaces = {frame: [surface_of_blocks(self.result, layer, self.wanted, frame) for layer in self.layers]}
        if not any(self.surfaces[frame]):
            fail("nothing is left to draw: " + ("--hide hides all of it" if self.wanted.hide else
                                                "the plane of --clip cuts all away"))
        u = self.result.displacement(self.frames[column])
        return [s and (*s.moved(u), s.point) for s in self.surfaces[frame]]

    def tools(self, column):
        """Surfaces of the rigid tools at that time."""
        for tool in self.wanted.tools:
            offset = tool.offset(self.times[column])
            surface = tool.surface(self.low - offset, self.high - offset)
            places_of(surface)[:] += offset
            yield surface

    def _frame(self):
        """Frames the bodies at all times, and the parts of tools within a margin around them."""
        low, high, columns = np.full(6, np.inf), np.full(6, -np.inf), range(len(self.frames))
        for column in columns:
            corners = np.concatenate([corners for corners, *_ in filter(None, self.moved(column))])
            both = np.hstack([corners, self.camera.seen(corners)])
            low, high = np.minimum(low, both.min(axis=0)), np.maximum(high, both.max(axis=0))
        self.low, self.high = low[:3], high[:3]
        margin = rigid.MARGIN * np.max(self.high - self.low)
        near = [np.clip(places_of(tool), self.low - margin, self.high + margin) for column in columns for tool in self.tools(column)]
        framed = np.concatenate([low[None, 3:], high[None, 3:], *map(self.camera.seen, near)])
        self.camera.frame(framed.min(axis=0), framed.max(axis=0), *PANEL, self.wanted.zoom)

    def images(self, columns):
        """By row and column."""
        return {(row, column): image for column in columns for row, image in enumerate(self._column(column))}

    def _column(self, column):
        solid, glass = self.moved(column)
        solid = solid and Solid(self.painter, polydata(*solid[:2]), solid[2], self.camera)
        see_through = [polydata(*glass[:2])] if glass else []
        see_through = [Glass(self.painter, data, GREY, self.camera) for data in (*see_through, *self.tools(column))]
        return [coarser(self._image(row, column, solid, see_through)) for row in self.rows]

    def _image(self, row, column, solid, see_through):
        image = solid.image(row.colors(column)) if solid else np.zeros((*self.painter.shape, 4))
        for glass in see_through:
            image = glass.over(image, solid.near if solid else -np.inf)
        return image


def add_measure(panel, camera):
    """A length and the directions of the axes, under a panel, whose coordinates are pixels."""
    most, y = 0.35 * camera.width * camera.pixel, camera.height + 14
    power = 10.0**np.floor(np.log10(most))
    length = power * max(f for f in (1, 2, 5) if f * power <= most * (1 + 1e-9))
    size, unit = next((p, u) for p, u in ((1, "m"), (1e-3, "mm"), (1e-6, "µm"), (0, "m")) if length >= 0.999 * p)
    style, end = {"color": "0.15", "clip_on": False}, length / camera.pixel
    panel.plot([0, end], [y, y], linewidth=2, **style)
    panel.text(0, y + 6, f"{length / (size or 1):g} {unit}", va="top", fontsize=9, **style)
    for name, (right, up) in zip("xyz", camera.axes[:2].T):
        if np.hypot(right, up) > 0.05:
            panel.plot([end + 60, end + 60 + 24 * right], [y + 12, y + 12 - 24 * up], linewidth=1, **style)
            panel.text(end + 60 + 34 * right, y + 12 - 34 * up, name, ha="center", va="center", fontsize=9, **style)


def add_bar(figure, row, panels):
    low, high = row.factor * row.low, row.factor * row.high
    norm = matplotlib.colors.Normalize(low, high if high > low else low + 1)
    more = f"\n(up to {row.factor * row.most:.3g})" if row.extend() in ("max", "both") else ""
    bar = figure.colorbar(matplotlib.cm.ScalarMappable(norm, SCALE), ax=list(panels), extend=row.extend(), extendfrac=0.03,
                          shrink=0.85, aspect=30, label=row.label + more)
    bar.outline.set_visible(False)


def figure_of(scene, images, rows, columns):
    """A figure of some of the scene's rows and columns; images: by row and column."""
    camera, clock = scene.camera, clock_of(np.abs(scene.times).max())
    size = max(len(columns) * camera.width, 240) + 160, len(rows) * camera.height + 110
    figure, panels = plt.subplots(len(rows), len(columns), squeeze=False, layout="constrained", figsize=np.array(size) / DPI, dpi=DPI)
    for (r, c), panel in np.ndenumerate(panels):
        image = images[rows[r], columns[c]]
        panel.imshow(np.clip(image[..., :3] + 1 - image[..., 3:], 0, 1))
        panel.set(frame_on=False, xticks=[], yticks=[], autoscale_on=False)
    for panel, column in zip(panels[0], columns):
        panel.set_title(f"t = {clock[0] * scene.times[column]:.4g} {clock[1]}", fontsize=11)
    for row, beside in zip(rows, panels):
        add_bar(figure, scene.rows[row], beside)
    add_measure(panels[-1, 0], camera)
    figure.suptitle(scene.name, fontsize=12)
    return figure


def pictures(path, file_of, wanted, one=False):
    """One picture, or one for each variable, file_of(its name); gives their names one by one."""
    scene = Scene(Result(path), wanted)
    columns, rows = range(len(scene.frames)), range(len(scene.rows))
    images = scene.images(columns)
    for part in [rows] if one else [[row] for row in rows]:
        yield save_picture(figure_of(scene, images, part, columns), file_of(scene.rows[part[0]].name), DPI)


def movie(path, out, wanted):
    """A picture after the other, of all frames unless some are wanted."""
    scene = Scene(Result(path), wanted)

    def drawn():
        for column in range(len(scene.frames)):
            figure = figure_of(scene, scene.images([column]), range(len(scene.rows)), [column])
            figure.canvas.draw()
            yield Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3])
            plt.close(figure)
    first, *others = drawn()
    first.save(out, save_all=True, append_images=others, duration=PAUSE, loop=0)
