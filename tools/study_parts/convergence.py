"""Order of convergence, limit and error bar of a measure f from two or three grids of spacing h: f(h) = f0 + C h^p.

Sources. Grid convergence index: Roache, Perspective: a method for uniform reporting of grid refinement studies, J. Fluids Eng.
116 (1994) 405; Roache, Verification and validation in computational science and engineering, Hermosa, 1998. Ratios of refinement
that differ, differences of changing sign: Celik, Ghia, Roache, Freitas, Coleman & Raad, Procedure for estimation and reporting of
uncertainty due to discretization in CFD applications, J. Fluids Eng. 130 (2008) 078001. Orders that can be trusted: Eça &
Hoekstra, A procedure for the estimation of the numerical uncertainty of CFD calculations, J. Comput. Phys. 262 (2014) 104.
"""
import math
from dataclasses import dataclass

from scipy.optimize import brentq

SAFETY = {2: 3.0, 3: 1.25}  # factors of the index, by the number of grids (Roache)
LOWEST, HIGHEST = 0.5, 2.5  # orders of the asymptotic range: not below half (Eça & Hoekstra), nor half an order above the second
LEAST = 1e-9                # an order that counts as 0
SAME = 1e-8                 # relative: tables have nine digits
GOOD_RATIO = 1.3            # of refinement; below it the observed order is uncertain (Celik et al.)


@dataclass
class Found:
    grids: int                  # number of grids used, the finest ones
    finding: str
    order: float | None = None  # observed
    limit: float | None = None  # f0
    bar: float | None = None    # grid convergence index of the finest grid, in the unit of the measure
    safety: float | None = None

    def percent(self, value):
        return None if self.bar is None or value == 0 else 100 * self.bar / abs(value)


def observed_order(sizes, values):
    """p of the power law through three grids, the finest first, whose differences have one sign; None: none above 0.

    With a = ln(h2/h1), b = ln(h3/h2): (f3 - f2)/(f2 - f1) = exp(p a) (exp(p b) - 1)/(exp(p a) - 1). The right side grows with
    p, from b/a at 0. Celik et al. iterate the same equation as a fixed point, which need not converge for b > 2 a."""
    a, b = math.log(sizes[1] / sizes[0]), math.log(sizes[2] / sizes[1])
    ratio = (values[2] - values[1]) / (values[1] - values[0])

    def excess(p):
        return p * b + math.log(math.expm1(-p * b) / math.expm1(-p * a)) - math.log(ratio)

    if excess(LEAST) >= 0:
        return None
    return brentq(excess, LEAST, 1 + (math.log(ratio) - math.log(min(1, b / a))) / b, xtol=1e-14)


def of_grids(sizes, values, theory):
    """Evaluates the finest three grids, or two; the finest first. `theory`: the order that is assumed for two grids."""
    count = min(len(sizes), 3)
    sizes, values = sizes[:count], values[:count]
    if count < 2:
        return Found(count, "none: no value on two grids")
    scale = SAME * max(map(abs, values))
    if max(values) - min(values) <= scale:
        return Found(count, "none: no difference between the grids")
    if count == 2:
        bar = SAFETY[2] * abs(values[1] - values[0]) / ((sizes[1] / sizes[0])**theory - 1)
        return Found(2, f"two grids, order {theory:g} assumed", bar=bar, safety=SAFETY[2])
    return of_three(sizes, values, scale, max(HIGHEST, theory + 0.5))


def of_three(sizes, values, scale, highest):
    fine, coarse = values[1] - values[0], values[2] - values[1]
    if abs(fine) <= scale:
        return Found(3, "none: out of the asymptotic range (no difference between the two finest grids)")
    if abs(coarse) <= scale:
        return Found(3, "none: diverging (no difference between the two coarsest grids)")
    if fine * coarse < 0:
        return Found(3, "none: oscillating")
    order = observed_order(sizes, values)
    if order is None:
        return Found(3, "none: diverging")
    if not LOWEST <= order <= highest:
        return Found(3, f"none: out of the asymptotic range (an order of {order:.2g}, expected {LOWEST:g} to {highest:g})")
    step = fine / ((sizes[1] / sizes[0])**order - 1)
    return Found(3, "converging", order, values[0] - step, SAFETY[3] * abs(step), SAFETY[3])
