"""Two results that should be the same thing seen from two frames."""
import numpy as np

# Each field: how it turns, its unit, and a large value in a scene, in spacings, wave speeds and moduli.
FIELDS = {
    "Displacement": ("vector", "m", lambda s: s.h),
    "Velocity": ("vector", "m/s", lambda s: s.speed),
    "Force": ("vector", "N", lambda s: s.modulus * s.h**2),
    "Cauchy_Stress": ("tensor", "Pa", lambda s: s.modulus),
    "Jacobian": ("number", "", lambda s: 1.0),
    "Damage": ("number", "", lambda s: 1.0),
    "Volume": ("number", "m³", lambda s: s.h**3),
    "Density": ("number", "kg/m³", lambda s: 1000.0),
    "Equivalent_Plastic_Strain": ("number", "", lambda s: 0.1),
    "Temperature": ("number", "", lambda s: 300.0),
}
SMALL = 1e-4  # of that: differences are told in parts of what there is, but of no less than this
ENERGIES = ("Kinetic_Energy", "Elastic_Energy", "Plastic_Work", "Stabilization_Energy", "Fracture_Energy", "Heat", "Tool_Kinetic_Energy",
            "Tool_Work", "Contact_Work", "External_Work")


def same_points(base, other, scene, frame):
    """For each point of the one which of the other it is, and why there is none."""
    places = frame.places(base.at)
    if len(places) != len(other.at):
        return None, f"points: {len(base.at)} and {len(other.at)}"
    apart = np.linalg.norm(places[:, None] - other.at[None], axis=2)
    chosen = np.argmin(apart, axis=1)
    if apart[np.arange(len(places)), chosen].max() > 1e-5 * scene.h * frame.length or len(set(chosen)) != len(chosen):
        return None, "points: not at the same places"
    return chosen, None


def steps_differ(base, other, frame, later=0.0):
    """By how much, as a part; None where their number is not the same."""
    one, two = (r.history.get("Step_Size", np.zeros(0)) for r in (base, other))
    if len(one) != len(two):
        return None
    return float(np.max(np.abs(two / frame.time - one) / one)) if len(one) else 0.0


def longest_steps(result):
    """Between what each row's longest step lies. A step is what is left of the run over a whole number: with one less it was too long, and
    of the last one nothing is known but that it was not."""
    time, step = result.history["Time"], result.history["Step_Size"]
    number = np.round((time[-1] - time) / step)
    return step, np.where(number > 1, step * number / np.maximum(number - 1, 1), np.inf)


def longest_steps_differ(base, other, frame):
    """By how much at least, as a part; where runs have other numbers of steps, that of the first ones."""
    rows = len(base.history["Time"]) if len(base.history["Time"]) == len(other.history["Time"]) else 1
    (low, high), (other_low, other_high) = ([part[:rows] for part in longest_steps(r)] for r in (base, other))
    return float(max((low * frame.time / other_high).max(), (other_low / frame.time / high).max()) - 1)


def mass_of(result):
    return float((result.frames[0]["Volume"] * result.frames[0]["Density"]).sum())


def turned(values, kind, frame):
    return {"vector": frame.vectors, "tensor": frame.tensors, "number": lambda v: v}[kind](values)


def fields_differ(base, other, scene, frame, only=None, flight=True):
    """The largest difference of each field, as a part of what there is of it: {field: part}."""
    chosen, problem = same_points(base, other, scene, frame)
    if problem:
        return {problem: np.inf}
    if len(base.frames) != len(other.frames):
        return {f"frames: {len(base.frames)} and {len(other.frames)}": np.inf}
    parts = {}
    for name in base.frames[0]:
        if only and name not in only:
            continue
        kind, unit, much = FIELDS[name]
        scale = max(max(np.abs(f[name]).max() for f in base.frames), SMALL * much(scene))
        worst = 0.0
        for n, (one, two) in enumerate(zip(base.frames, other.frames)):
            expected = turned(one[name], kind, frame)
            if name == "Velocity":
                expected = expected + frame.speed
            if name == "Displacement":
                expected = expected + frame.speed * (base.times[n] - frame.begin)
            got = two[name][chosen] / frame.scale(unit)
            difference = np.abs(got - expected).max()
            worst = max(worst, difference / scale if np.isfinite(difference) else np.inf)
        parts[name] = float(worst)
    return parts


def reaction_sum(result, parts):
    """The sum over all conditions: at a point of two conditions each counts its own change, in their order."""
    total = 0.0
    for name in parts:
        columns = [result.history.get(f"Reaction_{a}({name})") for a in "XYZ"]
        if columns[0] is not None:
            total = total + np.stack(columns, axis=1)
    return total


def histories_differ(base, other, scene, frame, base_parts, other_parts, energies=True, reactions=True):
    one, two = base.history, other.history
    if not one or not two or len(one["Time"]) != len(two["Time"]):
        return {f"rows: {len(one.get('Time', []))} and {len(two.get('Time', []))}": np.inf}
    parts = {}
    mass = mass_of(base)
    energy = sum(np.abs(one[name]).max() for name in ENERGIES if name != "Heat")
    energy = max(energy, SMALL**2 * mass * scene.speed**2)
    for name in ENERGIES if energies else ():
        parts[name] = np.abs(two[name] / frame.scale("J") - one[name]).max() / energy
    momentum = lambda r: np.stack([r[f"Momentum_{a}"] for a in "XYZ"], axis=1)
    scale = max(np.abs(momentum(one)).max(), SMALL * mass * scene.speed, np.sqrt(2 * mass * energy) * 1e-3)
    parts["Momentum"] = np.abs(momentum(two) / frame.scale("N s") - frame.vectors(momentum(one)) - mass * frame.speed).max() / scale
    if reactions and base_parts and other_parts:
        first, second = reaction_sum(base, base_parts), reaction_sum(other, other_parts)
        if not np.isscalar(first) and not np.isscalar(second):
            scale = max(np.abs(first).max(), SMALL * scene.modulus * scene.h**2)
            parts["Reactions"] = np.abs(second / frame.scale("N") - frame.vectors(first)).max() / scale
    for name in one:
        if name.startswith("Contact_Force_X") and name in two:
            first, second = (np.stack([r[name.replace("_X(", f"_{a}(")] for a in "XYZ"], axis=1) for r in (one, two))
            scale = max(np.abs(first).max(), SMALL * scene.modulus * scene.h**2)
            parts[f"Contact_Force{name[15:]}"] = np.abs(second / frame.scale("N") - frame.vectors(first)).max() / scale
    return {name: float(v) if np.isfinite(v) else np.inf for name, v in parts.items()}
