"""The laws of a single run. Each law returns a violation, or None; a scene that it does not apply to raises NotHere with the reason."""
import numpy as np

from compare import ENERGIES
from scenes import MOTIONS, REACTING, evaluated

ROUND_OFF = 1e-9  # of the largest term: sums of some 100 points over some 100 steps, 1e-16 each, and what they amplify


class NotHere(Exception):
    pass


def mass(scene, base, written):
    """The mesh's volumes and the deck's densities."""
    last = base.frames[-1]
    total, expected = (last["Volume"] * last["Density"]).sum(), scene.masses().sum()
    if abs(total - expected) > 1e-12 * expected * len(base.at):  # a sum of so many
        return f"mass: {total!r} kg, the mesh has {expected!r}"


def stable(scene, base, written):
    """The program's own step is one: no energy comes from it. The only law for runs that end with an error."""
    if not scene.explicit and any(np.abs(base.history[name]).max() > 0 for name in ("Contact_Work", "Tool_Work", "Plastic_Work")):
        raise NotHere("contact or flow begins in a load step, whose work is that of the mean of both ends")
    if "Fixed dt" in scene.deck["Solver"].get("Verlet", {}):
        raise NotHere("a fixed step may be too large")
    if base.status == 1 and "balance of energy" in base.error:
        return f"stable: {base.error[7:120]}"


def start(scene, base, written):
    """The first frame is the body at rest in its places with the velocities of the deck."""
    first = base.frames[0]
    if abs(base.times[0] - scene.begin) > 1e-12 * (scene.end - scene.begin):
        return f"start: the first frame is at {base.times[0]!r} s, the initial time {scene.begin!r}"
    if not scene.explicit:
        raise NotHere("equilibria have no velocities")
    free = np.ones(len(base.at), bool)
    velocity = np.zeros((len(base.at), 3))
    sites = scene.mesh.sites()
    apart = np.linalg.norm(base.at[:, None] - sites[None], axis=2)
    number = np.argmin(apart, axis=1)
    if apart.min(axis=1).max() > 1e-6 * scene.h:
        return "start: points are not where the mesh has them"
    for one in scene.conditions.values():
        points = scene.members(one.get("Node Set", "all"))[number]
        if one["Type"] in (*MOTIONS, "Symmetry Plane", "Non-Reflecting End"):
            free &= ~points
        elif one["Type"] == "Initial Velocity":
            for axis in one["Coordinate"]:
                velocity[points, "xyz".index(axis)] += evaluated(one["Value"], sites, scene.begin)[number][points]
    if not free.any():
        raise NotHere("all points are held")
    off = np.abs(first["Velocity"] - velocity)[free].max()
    if off > ROUND_OFF * max(np.abs(velocity).max(), 1e-4 * scene.speed):
        return f"start: velocities in the first frame are off by {off:.3g} m/s, of {np.abs(velocity).max():.3g}"


def end(scene, base, written):
    if abs(base.times[-1] - scene.end) > 1e-9 * (scene.end - scene.begin):
        return f"end: the last frame is at {base.times[-1]!r} s, the final time {scene.end!r}"


def finite(scene, base, written):
    for frame in base.frames:
        for name, values in frame.items():
            if not np.isfinite(values).all():
                return f"finite: {name} is not"
    if not all(np.isfinite(column).all() for column in base.history.values()):
        return "finite: the history is not"


def momentum(scene, base, written):
    """Its change is the impulse of all forces from outside: reactions are means since the row before, loads those of both ends of a step."""
    if not scene.explicit:
        raise NotHere("equilibria have no momentum")
    if scene.has("Non-Reflecting End"):
        raise NotHere("non-reflecting ends have no reaction")
    if scene.is_long:
        raise NotHere("rows are not of each step")
    rows = base.history
    time = rows["Time"]
    impulse = np.zeros((len(time) - 1, 3))
    largest = allowed = 0.0
    for name in [n for made in written.parts.values() for n in made]:
        if f"Reaction_X({name})" in rows:
            force = np.stack([rows[f"Reaction_{a}({name})"] for a in "XYZ"], axis=1)
            impulse += force[1:] * np.diff(time)[:, None]
            largest += np.abs(force).max()
    for one in scene.conditions.values():
        if one["Type"] == "Body Force":
            given, off = impulses_of_load(scene, one, time)
            for axis in one["Coordinate"]:
                impulse[:, "xyz".index(axis)] += given
            largest += np.abs(given / np.diff(time)).max()
            allowed += off if "subcycled" in base.log else 0
    p = np.stack([rows[f"Momentum_{a}"] for a in "XYZ"], axis=1)
    scale = max(np.abs(p).max(), largest * (time[-1] - time[0]), 1e-4 * scene.masses().sum() * scene.speed)
    off = np.abs(p[1:] - p[0] - np.cumsum(impulse, axis=0)).max(axis=1)
    if "subcycled" in base.log and scene.has("Body Force"):
        off = off[:-1]  # a load that changes: the last row has its mean over another time
        off = np.minimum(off[:-1], off[1:])  # where points' steps change, the mean of both velocities is off in one row alone
    off = off.max(initial=0)
    if off > 100 * ROUND_OFF * scale + allowed:
        return f"momentum: off by {off / scale:.2e} of the largest impulse"


def impulses_of_load(scene, one, time):
    """Between rows, by the mean of both ends, and how far they are off in all: substeps lie between these and the integral over time."""
    points = scene.members(one["Node Set"])
    at, volumes = scene.mesh.sites(), scene.mesh.site_volumes()
    parts = 16
    fine = np.concatenate([time[:1], *(np.linspace(a, b, parts + 1)[1:] for a, b in zip(time, time[1:]))])
    forces = np.array([(volumes * evaluated(one["Value"], at, t))[points] for t in fine])
    whole = 0.5 * (forces[:-parts:parts] + forces[parts::parts]) * np.diff(time)[:, None]
    pieces = 0.5 * (forces[:-1] + forces[1:]) * np.diff(fine)[:, None]
    off = np.abs(whole - pieces.reshape(len(time) - 1, parts, -1).sum(axis=1)).sum()
    return whole.sum(axis=1), off


def angular_momentum(scene, base, written):
    """For free bodies: central differences keep Σ m y × v where no force has a moment."""
    if not scene.explicit or scene.has(*REACTING, "Body Force", "Non-Reflecting End", "Periodic Sides"):
        raise NotHere("something acts from outside")
    m = (base.frames[0]["Volume"] * base.frames[0]["Density"])[:, None]
    def of(frame):
        y = base.at + frame["Displacement"]
        y = y - (m * base.at).sum(axis=0) / m.sum()
        return (m * np.cross(y, frame["Velocity"])).sum(axis=0), (m[:, 0] * np.linalg.norm(y, axis=1) * np.linalg.norm(frame["Velocity"], axis=1)).sum()
    values = [of(frame) for frame in base.frames]
    scale = max(max(v[1] for v in values), 1e-4 * m.sum() * scene.speed * scene.h)
    off = max(np.abs(v[0] - values[1][0]).max() for v in values[1:]) / scale
    if off > 100 * ROUND_OFF:
        return f"angular momentum: off by {off:.2e} of Σ m |y| |v|"


def probe(scene, base, written):
    """The history follows the point that stands where the probe is."""
    number = np.argmin(np.linalg.norm(base.at - scene.probed(), axis=1))
    row = np.array([base.history[f"Displacement_{a}(probe)"][-1] for a in "XYZ"])
    shown = base.frames[-1]["Displacement"][number]
    if np.abs(row - shown).max() > 1e-12 * max(np.abs(shown).max(), 1e-12 * scene.h):  # digits of the file
        return f"probe: {row} m, and {shown} in the last frame"


def told(base, *words):
    return any(all(word in line.lower() for word in words) for line in base.warnings)


def has_viscosity(scene):
    return any("Viscosity" in key for m in scene.deck["Materials"].values() for key in m)


def signs(scene, base, written):
    """Energies that cannot be negative are not, and what is dissipated does not come back, to a thousandth of all; or it is told."""
    rows = base.history
    total = max(sum(np.abs(rows[n]).max() for n in ENERGIES), 1e-12 * scene.masses().sum() * scene.speed**2)
    # The viscous pressure of a step is the mean of both ends, as that of the forces: where a point begins to grow, half of the last one
    # gives back, and noise at nearly the critical step does so in every other step: what the step before took, times the ratio of their rates.
    viscous = has_viscosity(scene)
    # Ordinary bonds may give energy where they break under pressure, which is told at the start, and as it happens from a hundredth on.
    parts = {"Plastic_Work": 5e-2 if viscous else 1e-3, "Fracture_Energy": 1e-2 if "under pressure may give some energy" in base.log else 1e-3}
    for name in ("Elastic_Energy", "Stabilization_Energy", "Plastic_Work", "Fracture_Energy"):
        if rows[name].min() < -parts.get(name, 1e-3) * total and not told(base, "energy"):
            return f"signs: {name} falls to {rows[name].min() / total:.2e} of all energy"
    # ½ m v⁻·v⁺ of the highest mode falls to -tan²(asin(ω Δt/2)) of its energy: -1.8 times at a Safety Factor of 0.8, -4.3 at 0.9.
    others = sum(np.abs(rows[n]).max() for n in ENERGIES if "Kinetic" not in n)
    if rows["Kinetic_Energy"].min() < -5 * others - 1e-3 * total and not told(base, "energy"):
        return f"signs: Kinetic_Energy falls to {rows['Kinetic_Energy'].min() / total:.2e} of all energy"
    for name in ("Plastic_Work", "Fracture_Energy"):
        back = (np.maximum.accumulate(rows[name]) - rows[name]).max()
        taken = 1.5 * np.diff(rows[name]).max(initial=0) if viscous and name == "Plastic_Work" else 0
        if back > max(parts[name] * total, taken) and not told(base, "energy"):
            return f"signs: {name} falls by {back / total:.2e} of all energy"


def passive(scene, base, written):
    """Where nothing drives them, bodies and tools hold no more energy than they began with."""
    if not scene.explicit:
        raise NotHere("equilibria are driven")
    for one in scene.conditions.values():
        driven = one["Type"] in ("Body Force", "Prescribed Temperature") or one["Type"] in MOTIONS and one["Value"].factor and one["Value"].text != "0"
        if driven or any(key.startswith(("Travel", "Force", "Stretch")) for key in one):
            raise NotHere("something drives them")
    rows = base.history
    held = sum(rows[n] for n in ("Kinetic_Energy", "Elastic_Energy", "Plastic_Work", "Stabilization_Energy", "Fracture_Energy", "Tool_Kinetic_Energy"))
    # The viscous work of a step is that of the mean of both ends: half of it may belong to the step before, or after.
    known = 0.5 * np.diff(rows["Plastic_Work"]).max(initial=0) if has_viscosity(scene) else 0
    gained = (held[1:].max() - known) / max(held[0], 1e-12 * scene.masses().sum() * scene.speed**2) - 1
    if gained > 1e-2 and not told(base, "energy"):
        return f"passive: energy grows by {gained:.2e} of what it was"


def balance(scene, base, written):
    """Within a hundredth, or told. A thousandth is kept by smooth motions alone; `half the step` asks how the error falls."""
    worst = rows_after_start(base.history["Balance_Error"]).max()
    allowed = 1e-2
    if not scene.explicit:
        # The work of load steps is that of the mean of both ends, right to second order in these: there are two to four, and contact begins in
        # one. Where there are many, what hypoelastic laws take, which differs from ½ σ : C⁻¹ : σ by a part of the order of the strain.
        allowed = max(1 / len(base.history["Time"])**2, min(1e-2, strain(scene, base)))
    if worst > allowed and not told(base, "balance") and not told(base, "energy"):
        return f"balance: off by {worst:.2e}, and nothing is told"


def strain(scene, base):
    """The largest elastic one, by the softest modulus."""
    return max(np.abs(frame["Cauchy_Stress"]).max() for frame in base.frames) / scene.about["softest"]


def rows_after_start(column):
    """The monitor looks from the eleventh row on: before, the largest energy so far is that of some first impulses."""
    return column[10:] if len(column) > 10 else column[-1:]


LAWS = {"stable": stable, "mass": mass, "start": start, "end": end, "finite": finite, "momentum": momentum, "angular momentum": angular_momentum,
        "signs": signs, "passive": passive, "balance": balance, "probe": probe}
