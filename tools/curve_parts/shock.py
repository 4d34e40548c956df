"""The front of an impact in a foam, from the mean velocities of its layers (a profile of the history).

All in reference coordinates, from the end that is hit: a layer at the distance X. The front is where half of the velocity of
that end is gained. Its speed U_s there gives, across it, the jump of strain dv / U_s and of nominal stress
rho_0 U_s dv (Reid & Peng, Dynamic uniaxial crushing of wood, Int. J. Impact Engng 19 (1997) 531; Barnes, Ravi-Chandar,
Kyriakides & Gaitanaros, Dynamic crushing of aluminum foams: Part I, Int. J. Solids Structures 51 (2014) 1631). Layers
ahead of it move, too, as the far end yields: dv is relative to them, and the stress ahead is that of the far end and what
accelerates them.
"""
from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid

from .measures import first_fall

LEAST_LAYERS = 4
LEAST_JUMP = 0.5      # of the usual velocity of the hit end
MEASURES = ("front_speed", "front_scatter", "velocity_jump", "strain_behind", "strain_by_speed", "shock_stress", "stress_jump")
MIDDLE = (0.15, 0.85)  # of the height: where speed, strain and jump are taken, away from both ends
LAST = 0.15           # of the height: as far as the front may reach behind its place
AHEAD = 0.25          # of the velocity of the hit end: half of an arrival's velocity


@dataclass
class Front:
    places: np.ndarray    # m, from the hit end: of the layers that it has passed
    arrivals: np.ndarray  # s
    speed: float          # m/s, of the best-fit line through the middle
    start: float          # s: when that line is at the hit end
    scatter: float        # m, root mean square distance from that line
    jump_of_velocity: float  # m/s, magnitude of velocity of the hit end minus velocity ahead
    strain: float         # behind the front, from the positions of layers
    strain_by_speed: float
    ahead: "Ahead"

    def where(self):
        return f"from {1e3 * self.ahead.places[0]:.3g} to {1e3 * self.ahead.places[-1]:.3g} mm"

    def jump_of_stress(self, times, ends, density):
        """Across the front, Pa, from the difference of both ends: slopes over the arrivals, as the speed."""
        given = np.abs(np.interp(self.ahead.arrivals, times, cumulative_trapezoid(ends, times, initial=0)))
        behind = np.polyfit(self.ahead.arrivals, given - density * self.ahead.flow, 1)[0]
        return float(behind - density * self.speed * self.ahead.velocity.mean())


@dataclass
class Ahead:
    """The layers ahead of the front as it arrives at those of its line."""

    places: np.ndarray    # m
    arrivals: np.ndarray  # s
    velocity: np.ndarray  # m/s, their median
    flow: np.ndarray      # m²/s: their velocities times their thickness


def arrivals(times, gained):
    """Time at which each layer first has half of the velocity that the hit end, the first layer, has gained; NaN: never."""
    ahead = 0.5 * gained[:, :1] - gained  # positive: not yet passed
    return np.array([first_fall(times, layer) for layer in ahead.T], float)


def alone_until(times, gained, when):
    """The time from which the layers ahead of the front move, too, because the far end is crushed: later arrivals are no
    front's. Infinite: never."""
    for before, row in zip(times[:-1], gained[1:]):
        ahead = row[~(when <= before)]  # all of them may be set in motion in one row
        if 0 < ahead.size < row.size and np.median(ahead) > AHEAD * row[0]:
            return before
    return np.inf


def front(times, places, velocities):
    """places, velocities: rows x layers, from the hit end. None if no front has passed the middle."""
    X = np.abs(places[0] - places[0, 0])
    gained = velocities - velocities[0, -1]  # by what was at rest, or in flight, as the far end at the start
    gained = gained * (np.sign(gained[:, 0].sum()) or 1.0)
    when = arrivals(times, gained)
    middle = np.isfinite(when) & (X > MIDDLE[0] * X[-1]) & (X < MIDDLE[1] * X[-1])
    middle &= when < alone_until(times, gained, when)
    if middle.sum() < LEAST_LAYERS:
        return None
    # Fits times over positions: all layers have an exact position, and times scatter.
    inverse, start = np.polyfit(X[middle], when[middle], 1)
    if not inverse > 0:
        return None
    speed = 1 / inverse
    scatter = float(np.sqrt(np.mean((X[middle] - speed * (when[middle] - start))**2)))
    ahead, hit = ahead_of(times, X, gained, when, middle)
    jump = float((hit - ahead.velocity).mean())
    if jump < LEAST_JUMP * np.median(gained[:, 0]):
        return None  # an elastic wave, ahead of crushing that follows later everywhere
    passed = np.isfinite(when)
    return Front(X[passed], when[passed], float(speed), float(start), scatter, jump, strain_behind(times, places, X, ahead),
                 jump / speed, ahead)


def ahead_of(times, X, gained, when, middle):
    """The layers ahead at these arrivals, and the velocity of the hit end."""
    order = np.flatnonzero(middle)[np.argsort(when[middle])]
    at = np.array([[np.interp(when[k], times, layer) for layer in gained.T] for k in order])
    left = [row[~(when <= when[k])] for k, row in zip(order, at)]
    thick = X[-1] / (len(X) - 1)
    velocity, flow = (np.array([of(row) for row in left]) for of in (np.median, lambda row: thick * row.sum()))
    return Ahead(X[order], when[order], velocity, flow), at[:, 0]


def strain_behind(times, places, X, ahead):
    """Mean over the gaps on the line as the front arrives at its end, without the last few behind it."""
    gaps = np.diff(places, axis=1)
    e = 1 - gaps[np.argmin(np.abs(times - ahead.arrivals[-1]))] / gaps[0]
    centers = 0.5 * (X[1:] + X[:-1])
    passed = (centers > ahead.places[0]) & (centers < ahead.places[-1] - LAST * X[-1])
    return float(e[passed].mean()) if passed.any() else float("nan")
