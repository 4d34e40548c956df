"""Draws shaded quads with numpy alone: no screen, no graphics library, the same image on every machine.

Each quad is sampled more densely than the pixels, and the sample nearest to the eye determines its pixel. Light only
multiplies a color, so that its hue can be looked up in the scale.
"""
import numpy as np

FINER = 2  # fine pixels per pixel of the picture, along each axis
SAMPLES_AT_ONCE = 2_000_000
TO_LIGHT = np.array([-0.42, 0.55, 0.72])  # right, up, toward the eye: light from the upper left, behind the viewer


class Camera:
    """Parallel projection. `towards` points from the body to the eye; z is up, unless the view is along z."""

    def __init__(self, towards):
        d = np.array(towards, float) / np.linalg.norm(towards)
        up = np.array([0, 0, 1.0]) if abs(d[2]) < 0.999 else np.array([0, 1.0, 0])
        right = np.cross(up, d)
        right /= np.linalg.norm(right)
        self.axes = np.stack([right, np.cross(d, right), d])

    def seen(self, places):
        """Coordinates to the right, up, and toward the eye."""
        return places @ self.axes.T

    def frame(self, low, high, width, height, zoom=1):
        """Fits the box from low to high (in view coordinates) into width x height pixels, then zooms."""
        self.middle, self.depth = 0.5 * (low + high), max(high[2] - low[2], 1e-30)
        size = 1.04 * np.maximum(high - low, 1e-9 * np.max(high - low))[:2]
        fit = max(size[0] / width, size[1] / height)
        self.width, self.height = max(16, int(np.ceil(size[0] / fit))), max(16, int(np.ceil(size[1] / fit)))
        self.pixel = fit / zoom

    def position(self, place):
        """The pixel (column, row) of a position."""
        right, up, _ = (self.seen(np.asarray(place)) - self.middle) / self.pixel
        return 0.5 * self.width + right, 0.5 * self.height - up


class Canvas:
    """Content of each fine pixel: the quad (-1: none), the position on it, and its nearness."""

    def __init__(self, camera):
        self.shape = FINER * camera.height, FINER * camera.width
        count = self.shape[0] * self.shape[1]
        self.quad = np.full(count, -1, np.int32)
        self.near = np.full(count, -np.inf, np.float32)
        self.s, self.t = np.zeros(count, np.float32), np.zeros(count, np.float32)

    def put(self, pixel, near, quad, s, t):
        """If several samples share a pixel the last one is stored: repeats until none is nearer than the stored one."""
        while len(pixel := pixel[wins := near > self.near[pixel]]):
            near, quad, s, t = near[wins], quad[wins], s[wins], t[wins]
            self.near[pixel], self.quad[pixel], self.s[pixel], self.t[pixel] = near, quad, s, t


def corner_weights(s, t):
    return (1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t


def canvas_of(corners, quads, camera):
    """Draws quads; corners are in view coordinates."""
    canvas = Canvas(camera)
    height, width = canvas.shape
    scale = FINER / camera.pixel
    fine = np.empty((len(corners), 3), np.float32)  # column, row, nearness
    fine[:, 0] = 0.5 * width + scale * (corners[:, 0] - camera.middle[0])
    fine[:, 1] = 0.5 * height - scale * (corners[:, 1] - camera.middle[1])
    fine[:, 2] = scale * (corners[:, 2] - camera.middle[2])
    x, y = (fine[:, i][quads.T] for i in (0, 1))
    facing = (x[2] - x[0]) * (y[3] - y[1]) - (x[3] - x[1]) * (y[2] - y[0]) < 0  # rows go down
    within = (x.max(axis=0) > 0) & (x.min(axis=0) < width) & (y.max(axis=0) > 0) & (y.min(axis=0) < height)
    drawn = np.flatnonzero(facing & within)
    x, y = x[:, drawn], y[:, drawn]
    longest = np.sqrt(np.max((np.roll(x, 1, axis=0) - x)**2 + (np.roll(y, 1, axis=0) - y)**2, axis=0))
    counts = np.ceil(1.35 * longest).astype(int) + 1  # samples along an edge: less than a pixel apart
    counts = np.where(counts > 8, 4 * -(-counts // 4), counts)
    for n in np.unique(counts):
        group = drawn[counts == n]
        group = group[np.argsort(-fine[quads[group, 0], 2])]  # the nearest first, which rejects most others at once
        for start in range(0, len(group), max(1, SAMPLES_AT_ONCE // n**2)):
            sample(canvas, fine, quads, group[start:start + max(1, SAMPLES_AT_ONCE // n**2)], n)
    return canvas


def sample(canvas, fine, quads, group, n):
    height, width = canvas.shape
    middle = ((np.arange(n) + 0.5) / n).astype(np.float32)
    s, t = (g.ravel() for g in np.meshgrid(middle, middle))
    at = fine[quads[group]].transpose(0, 2, 1) @ np.stack(corner_weights(s, t))
    column, row = at[:, 0].astype(np.int32).ravel(), at[:, 1].astype(np.int32).ravel()
    inside = np.flatnonzero((at[:, 0].ravel() >= 0) & (column < width) & (at[:, 1].ravel() >= 0) & (row < height))
    which, on = np.divmod(inside, n * n)
    canvas.put(row[inside] * width + column[inside], at[:, 2].ravel()[inside], group[which].astype(np.int32), s[on], t[on])


# Light


def gathered(of_quad, sides, count):
    """Sums at the corners over the adjacent quads; sides is 4 x quads."""
    ids = sides.ravel()
    return np.stack([np.bincount(ids, np.tile(component, 4), count) for component in of_quad.T], axis=1)


def unit(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-30)


def corner_normals(corners, quads, rounds=1):
    """Normals at corners, averaged with those of their neighbors."""
    sides = quads.T
    p = corners[sides]
    of_quad = np.cross(p[2] - p[0], p[3] - p[1])
    for _ in range(1 + rounds):
        of_corner = unit(gathered(of_quad, sides, len(corners)))
        of_quad = unit(of_corner[sides].sum(axis=0))
    return of_corner


def blurred(image, radius):
    """Two box means, by running sums; zero outside."""
    for axis in (0, 1, 0, 1):
        pad = [(0, 0), (0, 0)]
        pad[axis] = (radius + 1, radius)
        sums = np.cumsum(np.pad(image, pad), axis=axis)
        n = image.shape[axis]
        upper, lower = (sums[r:r + n] if axis == 0 else sums[:, r:r + n] for r in (2 * radius + 1, 0))
        image = (upper - lower) / (2 * radius + 1)
    return image


def openness(near, seen):
    """1 where light comes from all sides, less for a pixel behind its surroundings (Luft, Colditz and Deussen 2006), at
    three sizes. At the outline of the body, with surroundings on one side only, it is undetermined."""
    near, seen = (FINER**2 * coarser(a)[..., 0] for a in (np.where(seen, near, 0), 1.0 * seen))
    near, share = near / np.maximum(seen, 1), np.minimum(seen, 1)
    light = np.ones(near.shape)
    for part, strength in ((120, 0.35), (40, 0.4), (14, 0.35)):
        radius = max(1, max(near.shape) // part // 2)
        around = blurred(share, radius)
        behind = blurred(near * share, radius) / np.maximum(around, 1e-9) - near
        light *= 1 - strength * np.clip(behind / (2 * FINER * radius), 0, 1) * np.clip(2 * around - 1, 0, 1)
    return light.repeat(FINER, axis=0).repeat(FINER, axis=1)


def brightness(canvas, normals, quads, camera):
    """Light from the upper left and from everywhere, reduced in hollows and with distance; and how directly each fine
    pixel faces the eye (0 to 1)."""
    seen = (canvas.quad >= 0).reshape(canvas.shape)
    hit = np.flatnonzero(canvas.quad >= 0)
    weights = np.stack(corner_weights(canvas.s[hit], canvas.t[hit]), axis=1)
    normal = unit(np.einsum("pk,pkc->pc", weights, normals[quads[canvas.quad[hit]]]))
    light, facing = np.zeros(canvas.quad.shape), np.zeros(canvas.quad.shape)
    light[hit] = 0.54 + 0.42 * np.maximum(0, normal @ unit(TO_LIGHT)) + 0.06 * normal[:, 1]
    facing[hit] = np.clip(normal[:, 2], 0, 1)
    light, near = light.reshape(canvas.shape), np.where(seen, canvas.near.reshape(canvas.shape), 0)
    light *= openness(near, seen)
    behind = 0.5 - near * camera.pixel / (FINER * camera.depth)
    return light * (1 - 0.22 * np.clip(behind, 0, 1)), facing.reshape(canvas.shape)


def coarser(image):
    """Averages FINER x FINER pixels to one."""
    height, width = image.shape[0] // FINER, image.shape[1] // FINER
    return image.reshape(height, FINER, width, FINER, -1).mean(axis=(1, 3))
