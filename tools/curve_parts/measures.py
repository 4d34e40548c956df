"""Measures of a compression curve by ISO 13314:2011 and the literature: nominal stress (Pa) over nominal strain.

Sources. ISO: ISO 13314:2011, Mechanical testing of metals, ductility testing, compression test for porous and cellular
metals. Efficiency: Li, Magkiriadis & Harrigan, Compressive strain at the onset of densification of cellular solids,
J. Cellular Plastics 42 (2006) 371; Tan, Reid, Harrigan, Zou & Li, Dynamic compressive strength properties of aluminium
foams, J. Mech. Phys. Solids 53 (2005) 2174. Equilibrium: Ravichandran & Subhash, Critical appraisal of limiting strain rates for
compression testing of ceramics in a split Hopkinson pressure bar, J. Am. Ceram. Soc. 77 (1994) 263.
"""
from dataclasses import dataclass, replace

import numpy as np
from scipy.integrate import cumulative_trapezoid

PLATEAUS = {"": (0.2, 0.3), "_20_40": (0.2, 0.4)}
END_OF_PLATEAU = 1.3  # times the plateau stress (ISO)
ENERGY_TO = 0.5       # strain up to which energy is given if the plateau does not end before (ISO)
GRADIENT = (0.2, 0.7)  # fractions of the plateau stress between which gradients are taken (ISO: of the loop)
MOST_UNLOADED = 0.5   # largest fraction of its first stress that an unloading may leave
MOST_APART = 0.05     # largest relative difference of both ends' stresses in equilibrium (Ravichandran & Subhash)
OFFSETS = {"": 0.002, "_1": 0.01}  # plastic strains of offset stress and proof strength


@dataclass
class Measure:
    name: str
    value: float | None  # None: the curve does not have it
    unit: str
    meaning: str
    why: str = ""        # reason if there is no value
    over: tuple | None = None  # range of strains; None: independent of equilibrium

    def said(self):
        """The definition, and the reason if there is no value."""
        return self.meaning if self.value is not None or not self.why else f"{self.meaning}; none: {self.why}"


def loading(strain, stress):
    """The rows in which the strain exceeds all previous ones: without unloading loops."""
    before = np.concatenate([[-np.inf], np.maximum.accumulate(strain)[:-1]])
    keep = strain > before
    return strain[keep], stress[keep]


def work(strain, stress, ends):
    """∫ σ dε along loading(): the strains to which it goes, and its values. `ends`: of each row the strain itself, or, if its stress is
    a mean, that at the end of the interval."""
    e, s = loading(ends, stress)
    return e, integral(e, s, loading(ends, strain)[1] != e)


def integral(strain, stress, is_mean):
    """∫ σ dε up to each row, whose stress is that at its strain, or a mean since the row before it."""
    return np.cumsum(np.where(is_mean, stress, midway(stress)) * np.diff(strain, prepend=strain[0]))


def midway(values):
    """Those between each row and the one before it."""
    return 0.5 * (values + np.concatenate([values[:1], values[:-1]]))


def mean_between(strain, stress, low, high):
    """∫ σ dε / ∫ dε with interpolated bounds: the mean at equal intervals of strain. None beyond the curve."""
    if len(strain) < 2 or strain[0] > low or strain[-1] < high:
        return None
    inside = (strain > low) & (strain < high)
    e = np.concatenate([[low], strain[inside], [high]])
    return float(cumulative_trapezoid(np.interp(e, strain, stress), e)[-1] / (high - low))


def crossing(x, y, level):
    """The x from which y stays above a level; None if it does not, or always is."""
    return first_fall(x[::-1], y[::-1] - level) if y[-1] > level else None


def line(strain, stress, low, high):
    """Slope, and strain at zero stress, of the straight line through the rows with stresses from low to high; None for
    fewer than three rows."""
    there = (stress >= low) & (stress <= high)
    if there.sum() < 3 or np.ptp(strain[there]) == 0:
        return None
    slope, at_zero = np.polyfit(strain[there], stress[there], 1)
    return (float(slope), float(-at_zero / slope)) if slope != 0 else None


def quasi_elastic_line(strain, stress, scale):
    """The line through the first rise, between the two fractions of the scale."""
    end = np.flatnonzero(stress > GRADIENT[1] * scale)
    rows = slice(0, end[0] if len(end) else len(stress))
    return line(strain[rows], stress[rows], GRADIENT[0] * scale, GRADIENT[1] * scale)


def first_fall(x, y):
    """The x at which y first falls from above 0 to it, or below; None: never."""
    rows = np.flatnonzero((y[1:] <= 0) & (y[:-1] > 0))
    if len(rows) == 0:
        return None
    i = rows[0]
    return float(x[i] + y[i] / (y[i] - y[i + 1]) * (x[i + 1] - x[i]))


def offset_stress(strain, stress, gradient, foot, offset):
    """The stress at which the curve falls below the line of this gradient, offset from the foot; or None."""
    return first_fall(stress, stress - gradient * (strain - foot - offset))


def elastic_gradient(strain, stress, scale):
    """Gradient of the longest unloading between the two fractions of the scale, and its rows; None if none reaches the
    lower fraction."""
    best = None
    start = 0
    for i in range(1, len(strain) + 1):
        if i < len(strain) and strain[i] < strain[i - 1]:
            continue
        if i - start > 2 and stress[i - 1] < MOST_UNLOADED * stress[start]:
            here = line(strain[start:i], stress[start:i], GRADIENT[0] * scale, GRADIENT[1] * scale)
            if here is not None and (best is None or i - start > best[0]):
                best = (i - start, here[0], slice(start, i))
        start = i
    return best and best[1:]


def densification(strain, stress, W):
    """The strain of the largest efficiency W / σ, W = ∫ σ dε, the last of equal ones, and the efficiency there; None if it is
    largest at the end, where it may still rise."""
    with np.errstate(divide="ignore", invalid="ignore"):
        efficiency = np.where(stress > 0, W / stress, 0)
    # Only beyond the first rise: before it the stress is almost zero, and the efficiency meaningless.
    efficiency[:np.argmax(stress >= 0.5 * np.median(stress))] = 0
    i = len(efficiency) - 1 - int(np.argmax(efficiency[::-1]))
    return None if i == len(efficiency) - 1 else (float(strain[i]), float(efficiency[i]))


def apart(strain, stress, other, low, high):
    """Difference of both ends from low to high, relative to their mean, at equal intervals of strain."""
    low, high = max(low, float(strain[0])), min(high, float(strain[-1]))
    differences = mean_between(strain, np.abs(stress - other), low, high) if high > low else None
    both = mean_between(strain, 0.5 * (np.abs(stress) + np.abs(other)), low, high) if high > low else None
    return differences / both if both else 0.0


def of_curve(strain, stress, other=None, ends=None):
    """All measures of a curve, with or without unloading loops; `other`: the stress at the other end. Where both differ
    too much there is no equilibrium, and no measure of the material. `ends` as in work()."""
    strain, stress = np.asarray(strain, float), np.asarray(stress, float)
    ends = strain if ends is None else ends
    found = of_one_end(strain, stress, ends)
    e, s = loading(strain, stress)
    o = None if other is None else loading(strain, np.asarray(other, float))[1]
    if o is not None:
        found = [in_equilibrium(m, e, s, o) for m in found]
    dense = None if o is None else densification(e, 0.5 * (s + o), np.interp(e, *work(strain, 0.5 * (stress + other), ends)))
    return found + measures_of_ends(e, s, o, dense)


def in_equilibrium(measure, e, s, o):
    """The measure, without its value if both ends differ too much."""
    if measure.value is None or measure.over is None:
        return measure
    by = apart(e, s, o, *measure.over)
    if by <= MOST_APART:
        return measure
    return replace(measure, value=None, why=f"both ends differ by {100 * by:.2g} % there, more than {100 * MOST_APART:g} %: no equilibrium")


def measures_of_ends(e, s, o, dense):
    """Stresses of both ends, in equilibrium or not; `dense`: the densification of their mean."""
    low, high = PLATEAUS[""]
    one_end, ends = "the history has the force at one end only", f"the curve ends at a strain of {e[-1]:.3g}"
    there = e[-1] >= high and e[0] <= low
    between = f"from {100 * low:g} to {100 * high:g} % strain"
    return [
        Measure("mean_stress", mean_between(e, s, low, high), "Pa", f"mean {between} at the end of the curve, in equilibrium or not", ends),
        Measure("mean_stress_other_end", None if o is None else mean_between(e, o, low, high), "Pa", "the same at the other end",
                one_end if o is None else ends),
        Measure("ends_apart", None if o is None or not there else apart(e, s, o, low, high), "1",
                f"difference of both ends over their mean, {between} (in equilibrium up to {MOST_APART:g}, Ravichandran & Subhash 1994)",
                one_end if o is None else ends),
        Measure("densification_of_ends", dense and dense[0], "1", "densification_strain of the mean of both ends, in equilibrium or not",
                one_end if o is None else "energy over stress still rises at the end of the curve"),
    ]


def of_one_end(strain, stress, ends):
    e, s = loading(strain, stress)
    W = work(strain, stress, ends)
    plateau = {key: mean_between(e, s, *between) for key, between in PLATEAUS.items()}
    known = plateau[""] or plateau["_20_40"]
    scale = known or float(s.max())
    of = "plateau stress" if known else "largest stress, as the curve has no plateau yet"
    end = None
    if known:
        beyond = e >= PLATEAUS[""][0]
        end = crossing(e[beyond], s[beyond], END_OF_PLATEAU * known)
    ends = f"the curve ends at a strain of {e[-1]:.3g}"
    rise, unloading = quasi_elastic_line(e, s, scale), elastic_gradient(strain, stress, scale)
    risen = float(e[np.argmax(s > GRADIENT[1] * scale)])  # where that line ends
    unloaded = unloading and (float(strain[unloading[1]].min()), float(strain[unloading[1]].max()))
    unloading = unloading and unloading[0]
    return [
        Measure("quasi_elastic_gradient", rise and rise[0], "Pa", f"slope of the first rise, 20 to 70 % of the {of} (ISO)",
                "fewer than three rows there: a history in shorter intervals has more", (0, risen)),
        Measure("elastic_gradient", unloading, "Pa", f"slope of unloading, 70 to 20 % of the {of} (ISO)",
                "the history does not unload so far, in three rows", unloaded),
        *offset_measures(e, s, rise, unloading),
        *[Measure(f"plateau_stress{key}", value, "Pa", f"mean from {100 * low:g} to {100 * high:g} % strain (ISO)", ends, (low, high))
          for (key, (low, high)), value in zip(PLATEAUS.items(), plateau.values())],
        Measure("plateau_end", end, "1", "strain from which on the stress is above 1.3 times the plateau stress (ISO)",
                "at its end the stress is not" if known else "there is no plateau stress", (PLATEAUS[""][0], end or 0)),
        *energy_measures(e, s, end, W),
        *densification_measures(e, s, np.interp(e, *W)),
        Measure("largest_strain", float(e[-1]), "1", "of the curve"),
        Measure("largest_stress", float(s.max()), "Pa", "of the curve"),
    ]


def offset_measures(e, s, rise, unloading):
    """Offset stresses by both gradients, measured from the foot of the first rise."""
    found = []
    for name, of, gradient in (("offset_stress", "quasi-elastic", rise and rise[0]), ("proof_strength", "elastic", unloading)):
        known = rise is not None and gradient
        for key, offset in OFFSETS.items():
            value = offset_stress(e, s, gradient, rise[1], offset) if known else None
            found.append(Measure(f"{name}{key}", value, "Pa", f"stress at {100 * offset:g} % plastic strain beside the line of "
                                 f"the {of} gradient (ISO)",
                                 "the curve does not cross that line" if known else f"there is no {of} gradient",
                                 (0, value / gradient + rise[1] + offset if value is not None else 0)))
    return found


def energy_measures(e, s, end, work):
    to = min(end if end is not None else ENERGY_TO, ENERGY_TO, float(work[0][-1]))
    largest, W = max(s[e < to].max(initial=0), float(np.interp(to, e, s))), float(np.interp(to, *work))
    whole = to > e[0] and largest > 0
    return [
        Measure("energy_strain", to, "1", "to which energy is taken: the plateau's end, at most 50 % (ISO)"),
        Measure("absorbed_energy", W, "J/m3", "integral of stress over strain to there, per volume of the foam (ISO)", "", (0, to)),
        Measure("absorption_efficiency", W / (largest * (to - e[0])) if whole else None, "1",
                "that over the largest stress to there times the strain (ISO)", "", (0, to)),
    ]


def densification_measures(e, s, W):
    found = densification(e, s, W)
    strain, efficiency = found or (None, None)
    W = None if strain is None else float(np.interp(strain, e, W))
    return [
        Measure("densification_strain", strain, "1", "where energy over stress is largest (Tan et al. 2005, Li et al. 2006)",
                "it still rises at the end of the curve", (0, strain or 0)),
        Measure("largest_efficiency", efficiency, "1", "energy over stress there (Li et al. 2006)", "as densification_strain", (0, strain or 0)),
        Measure("densification_energy", W, "J/m3", "integral of stress over strain to there", "as densification_strain", (0, strain or 0)),
    ]
