"""The bodies that are crushed, and of what: round struts that meet in a node, ideally plastic aluminium."""
import dataclasses
import math

import numpy as np

YOUNG, POISSON, DENSITY, YIELD = 70e9, 0.33, 2700.0, 200e6  # Pa, –, kg/m³, Pa
WAVE = math.sqrt(YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)) / DENSITY)  # m/s, of dilatation


@dataclasses.dataclass(frozen=True)
class Placement:
    """How a body lies in the lattice."""
    turn: float     # degrees about z
    offset: tuple   # along x and y, in spacings


PLACEMENTS = (Placement(17, (0.3, 0.7)), Placement(40, (0.1, 0.45)))


@dataclasses.dataclass(frozen=True)
class Body:
    """Both ends, planes across z, stick to plates that move at half the speed each, in opposite directions."""
    name: str
    title: str
    diameter: float    # of the struts, m
    height: float      # from end to end, m
    shear: bool        # the plates move along the turned x axis, or towards each other
    ball: float        # radius of a ball about the node, m
    core: float        # points so near to the middle are held, m; 0: none
    strain: float      # displacement of the ends over the height, at the end
    speed: float       # over the wave's
    cells: tuple       # a strut, such that the height is a whole number of spacings
    work: float        # J, by finite elements (crush_precision reference)

    def reach(self):
        """Half of the width along x and y, m."""
        return math.sqrt(2) * self.height / 2 + 2 * self.diameter

    def directions(self, turn):
        """Unit vectors; a strut goes from the node along each."""
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        if self.shear:
            up = 1 / math.sqrt(2)
            struts = [(c, s, up), (-c, -s, up), (-s, c, -up), (s, -c, -up)]
        else:
            struts = [(x * c - y * s, x * s + y * c, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)]
        return np.array(struts) / np.linalg.norm(struts[0])

    def solid(self, places, turn):
        square = (places ** 2).sum(1)
        inside = square < self.ball ** 2
        for direction in self.directions(turn):
            along = places @ direction
            inside |= (along > 0) & (square - along ** 2 < self.diameter ** 2 / 4)
        return inside

    def volume(self):
        """m³, from the random places that are inside."""
        far = self.reach()
        places = (2 * np.random.default_rng(1).random((2_000_000, 3)) - 1) * [far, far, self.height / 2]
        return self.solid(places, 0).mean() * 4 * far * far * self.height

    def plate_speed(self):
        """Speed of the ends relative to each other, m/s."""
        return self.speed * WAVE

    def plate_velocity(self, turn):
        """Velocity of the upper end, m/s; the lower one has the opposite."""
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        return self.plate_speed() / 2 * np.array([c, s, 0] if self.shear else [0, 0, -1])

    def duration(self):
        return self.strain * self.height / self.plate_speed()


MM = 1e-3
BODIES = {body.name: body for body in (
    Body("slender", "eight struts, L/d 4.3, crushed", 0.2 * MM, MM, False, 0, 0.08 * MM, 0.3, 1 / 500, (2, 3, 4, 6), 3.790e-3),
    Body("stubby", "eight struts, L/d 2.9, crushed", 0.3 * MM, MM, False, 0, 0.12 * MM, 0.3, 1 / 500, (2.1, 3, 3.9, 6), 10.37e-3),
    Body("sheared", "four struts in a node, sheared", MM, 4 * MM, True, 0.51 * MM, 0, 0.1, 1 / 1000, (2, 3, 4, 6), 24.72e-3))}
