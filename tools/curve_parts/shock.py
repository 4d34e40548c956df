"""The front of an impact in a foam, from the mean velocities of its layers (a profile of the history).

All in reference coordinates, from the end that is hit: a layer at the distance X. The front is where the velocity is half
way between those of both ends. Its speed U_s there gives, across it, the jump of strain dv / U_s and of nominal stress
rho_0 U_s dv (Reid & Peng, Dynamic uniaxial crushing of wood, Int. J. Impact Engng 19 (1997) 531; Barnes, Ravi-Chandar,
Kyriakides & Gaitanaros, Dynamic crushing of aluminum foams: Part I, Int. J. Solids Structures 51 (2014) 1631).
"""
from dataclasses import dataclass

import numpy as np

LEAST_LAYERS = 4
LEAST_JUMP = 0.5      # of the usual difference of the velocities of both ends
MEASURES = ("front_speed", "front_scatter", "velocity_jump", "strain_behind", "strain_by_speed", "shock_stress", "stress_jump")
MIDDLE = (0.15, 0.85)  # of the height: where speed, strain and jump are taken, away from both ends


@dataclass
class Front:
    places: np.ndarray    # m, from the hit end: of the layers that it has passed
    arrivals: np.ndarray  # s
    speed: float          # m/s, of the best-fit line through the middle
    scatter: float        # m, root mean square distance from that line
    jump_of_velocity: float  # m/s, magnitude of velocity behind minus velocity ahead
    strain: float         # behind the front, from the positions of layers
    strain_by_speed: float
    behind: float         # s: when it had passed half of the middle


def strains(places):
    """Strain of the gaps between layers: 1 - (z_k+1 - z_k)/(Z_k+1 - Z_k); places: rows x layers, row 0: reference."""
    gaps = np.diff(places, axis=1)
    return 1 - gaps / gaps[0]


def arrivals(times, velocities):
    """Time at which each layer first has the mean of both ends' velocities; NaN: never. The hit end comes first."""
    middle = 0.5 * (velocities[:, 0] + velocities[:, -1])
    sign = np.sign(velocities[0, -1] - velocities[:, 0].mean()) or 1.0
    ahead = sign * (velocities - middle[:, None])  # positive: not yet passed
    found = np.full(velocities.shape[1], np.nan)
    for layer in range(velocities.shape[1]):
        passed = np.flatnonzero((ahead[1:, layer] <= 0) & (ahead[:-1, layer] > 0))
        if len(passed):
            i = passed[0]
            part = ahead[i, layer] / (ahead[i, layer] - ahead[i + 1, layer])
            found[layer] = times[i] + part * (times[i + 1] - times[i])
    return found


def front(times, places, velocities):
    """places, velocities: rows x layers, from the hit end. None if no front has passed the middle."""
    X = np.abs(places[0] - places[0, 0])
    when = arrivals(times, velocities)
    middle = np.isfinite(when) & (X > MIDDLE[0] * X[-1]) & (X < MIDDLE[1] * X[-1])
    if middle.sum() < LEAST_LAYERS:
        return None
    # Fits times over positions: all layers have an exact position, and times scatter.
    inverse, start = np.polyfit(X[middle], when[middle], 1)
    if not inverse > 0:
        return None
    speed = 1 / inverse
    scatter = float(np.sqrt(np.mean((X[middle] - speed * (when[middle] - start))**2)))
    behind = float(np.median(when[middle]))
    apart = np.abs(velocities[:, -1] - velocities[:, 0])
    jump = float(apart[row_at(times, behind)])
    if jump < LEAST_JUMP * np.median(apart):
        return None  # an elastic wave, ahead of crushing that follows later everywhere
    return Front(X[np.isfinite(when)], when[np.isfinite(when)], float(speed), scatter, jump,
                 strain_behind(times, places, X, when, middle), jump / speed, behind)


def row_at(times, t):
    return int(np.argmin(np.abs(times - t)))


def strain_behind(times, places, X, when, middle):
    """Mean over the middle gaps that the front has passed when it leaves the middle, without the last few behind it."""
    row = row_at(times, np.nanmax(when[middle]))
    e = strains(places)[row]
    centers = 0.5 * (X[1:] + X[:-1])
    passed = (centers > MIDDLE[0] * X[-1]) & (centers < (MIDDLE[1] - 0.2) * X[-1])
    return float(e[passed].mean()) if passed.any() else float("nan")
