"""The struts of a foam as a distance: below zero inside of the union of capsules around edges."""
import numpy

BLOCKS = 10  # along each side of the box: places of one see the edges near it alone


class Struts:
    """From the lines of foam_edges. Distances are right up to a radius from the surface, beyond it at least that."""

    def __init__(self, lines):
        header = lines[0].split()
        self.size, self.radius = numpy.array(header[2:5], float), float(header[6])
        ends = numpy.array([line.split() for line in lines[1:] if line.strip()], float)
        self.start, self.along = ends[:, :3], ends[:, 3:] - ends[:, :3]
        self.square = numpy.maximum((self.along ** 2).sum(1), 1e-300)
        self.low = numpy.minimum(ends[:, :3], ends[:, 3:]) - 2 * self.radius
        self.high = numpy.maximum(ends[:, :3], ends[:, 3:]) + 2 * self.radius

    def _from_nearest_edge(self, places):
        """Vectors from the nearest place of the edges near a block."""
        near = ((self.low < places.max(0)) & (self.high > places.min(0))).all(1)
        if not near.any():
            return numpy.full_like(places, 2 * self.radius)
        offset = places[:, None] - self.start[near]
        share = numpy.clip((offset * self.along[near]).sum(2) / self.square[near], 0, 1)
        offset -= share[:, :, None] * self.along[near]
        return offset[numpy.arange(len(places)), (offset ** 2).sum(2).argmin(1)]

    def distance_and_normal(self, places):
        block = (places / self.size * BLOCKS).astype(int).clip(0, BLOCKS - 1) @ [BLOCKS ** 2, BLOCKS, 1]
        vectors = numpy.empty_like(places)
        order = numpy.argsort(block, kind="stable")
        for members in numpy.split(order, numpy.flatnonzero(numpy.diff(block[order])) + 1):
            vectors[members] = self._from_nearest_edge(places[members])
        lengths = numpy.linalg.norm(vectors, axis=1)
        return lengths - self.radius, vectors / numpy.maximum(lengths, 1e-300)[:, None]

    def distance(self, places):
        return self.distance_and_normal(places)[0]
