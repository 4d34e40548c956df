"""Force and shortening from a deck and its history; the options that name them."""
import glob
import itertools
import os
import re

import numpy as np
import strut_tools
from decks import Deck, in_xml, integrals, list_in, value_at, value_in
from strut_tools import Parser, fail, nearest

from . import extent

INSTANT = "Instant_"
FORCES = re.compile(rf"(?:{INSTANT})?(Reaction|Contact_Force)_([XYZ])\((.+)\)")
LAYERS = re.compile(r"Mean_(Velocity|Coordinate)_([XYZ])\((.+) (\d+)\)")


def parser_of(about, kind=Parser):
    """The options of tools/curve, which a study may also set in a line."""
    parser = kind(prog="tools/curve", description=about)
    add = parser.add_argument
    add("deck", help="the deck of the run, or its history (.csv)")
    add("out", nargs="?", default=".", help="folder to write to (default: this one)")
    add("--results", default=".", metavar="FOLDER", help="that the run was started from (default: this one)")
    add("--force", metavar="COLUMN", help="of the history, N (default: its first reaction or contact force along the axis)")
    add("--other", metavar="COLUMN", help="the force at the other end, N (default: the next one along the axis)")
    add("--shortening", metavar="COLUMN|EXPRESSION", help="m (default: mean displacements, layers or the deck's motion)")
    add("--axis", choices=("x", "y", "z"), help="of compression (default: that of the force)")
    add("--block", metavar="NAME", help="that is crushed")
    add("--layers", metavar="NAME", help="profile of the history, for the front (default: the first one)")
    parser.add_numbers("--area", 1, above=0, metavar="A", help="m2, of the section (default: from the recipe or the result)")
    parser.add_numbers("--height", 1, above=0, metavar="H", help="m (default: likewise)")
    parser.add_numbers("--density", 1, above=0, metavar="RHO", help="kg/m3, of the foam (default: likewise)")
    parser.add_numbers("--smooth", 1, kind=int, above=0, metavar="N", default=1, help="mean over N rows of stress (default 1: none)")
    return parser


def history(path):
    """Columns by name, in their order. An incomplete last line, which a run may be writing, is ignored."""
    if not os.path.isfile(path):
        fail(f"{path} does not exist: --results names the folder that the run was started from")
    table = strut_tools.history(path, growing=True)
    times = table["Time"]
    if len(times) < 2:
        fail(f"{path} has not yet two rows")
    back = np.flatnonzero(~(np.diff(times) > 0))
    if len(back):
        fail(f"{path}: its times do not rise from row to row, from {times[back[0]]:g} to {times[back[0] + 1]:g} s (two runs in one file?)")
    return table


def column(table, name, option):
    if name not in table:
        fail(f"{option}: there is no column '{name}' in the history{nearest(name, list(table))}; there are {', '.join(table)}")
    return table[name]


def forces(table, words):
    """The names of the force columns along the axis: that of the curve, that of the other end, then the rest; and the axis,
    0 to 2."""
    named = [name for name in (words.force, words.other) if name]
    for name in named:
        column(table, name, "--force")
    known = {name: found for name in table if (found := FORCES.fullmatch(name))}
    axis = words.axis
    if axis is None:
        axes = [known[name][2] for name in named if name in known] or [m[2] for m in known.values()]
        axis = "z" if "Z" in axes or not axes else axes[0].lower()
    along = with_the_chosen(words, [name for name, m in known.items() if m[2].lower() == axis])
    if not along:
        fail(f"the history has no force along {axis}: add e.g. Reaction_{axis.upper()}(top) or "
             f"Contact_Force_{axis.upper()}(foam:plate) to History > Variables, or name a column by --force")
    if words.force and words.force == words.other:
        fail(f"--force and --other are one column, '{words.force}': expected the two ends")
    for name in along[:2]:
        if not np.isfinite(table[name]).all():
            fail(f"the column '{name}' of the history is no number at t = {table['Time'][~np.isfinite(table[name])][0]:g} s")
    return along, "xyz".index(axis)


def with_the_chosen(words, along):
    """The forces along the axis, with --force as the first and --other as the second. A force that is given twice, at its
    instant and as a mean, is one end."""
    rest = [name for name in along if name not in (words.force, words.other)]
    first = words.force or next(iter(rest), words.other)
    ends = [words.other] if words.other and words.other != first else []
    ends += [name for name in rest if name.removeprefix(INSTANT) != first.removeprefix(INSTANT)]
    ends.sort(key=lambda name: name != words.other and name.startswith(INSTANT) != first.startswith(INSTANT))
    return [first, *ends] if first else []


def is_equilibrium(deck):
    """True if the run consists of load steps, each an equilibrium."""
    return deck is not None and deck.section("Solver", "QuasiStatic") is not None


def rows_of_means(path, name, deck, times):
    """True for each row in which a force column has the mean since the previous row: all rows according to the first line
    of the history, or those of explicit steps that follow equilibria (Solver 2)."""
    units = []
    with open(path, newline="") as file:
        while (line := file.readline().strip()).startswith("#"):
            units = re.split(r"units: *", line)[-1].split(",")
    names = line.split(",")
    if len(units) == len(names) and name in names and units[names.index(name)].strip() == "N (mean)":
        return np.full(len(times), True)
    steps_follow = is_equilibrium(deck) and deck.section("Solver 2") is not None and not name.startswith(INSTANT)
    end = value_at(deck.get("Solver", "Final Time", default=""), 0) if steps_follow else None
    return times > (np.inf if end is None else end)


def signed(values):
    """Makes compression positive: the value of largest magnitude decides the sign."""
    values = np.asarray(values, float)
    return values if values.max() + values.min() >= 0 else -values


# Shortening


def motion_of(deck, axis, times):
    """{condition: its displacement along the axis at these times}, for conditions with a prescribed motion, {tool: words on where it
    begins}, and the names of those whose motion is not known."""
    letter, moves, begins, unknown = "xyz"[axis], {}, {}, []
    goes_on = deck.section("Start From") is not None
    for name, keys in deck.sections("Boundary Conditions").items():
        kind, value = value_in(keys, "Type"), value_in(keys, "Value")
        if kind == "Prescribed Velocity" and letter in value_in(keys, "Coordinate"):
            way = integrals(value, times[0] if goes_on else initial_time(deck), times)
        elif kind == "Prescribed Displacement" and letter in value_in(keys, "Coordinate"):
            way = [value_at(value, t) for t in times]
        elif kind and kind.startswith("Rigid ") and value_in(keys, f"Travel {letter.upper()}"):
            way = [value_at(value_in(keys, f"Travel {letter.upper()}"), t) for t in times]
        else:
            continue
        if way is None or None in way:
            unknown.append(name)
            continue
        moves[name] = np.array(way)
        if kind == "Prescribed Displacement":
            moves[name] = moves[name] - taken_off(deck, value)
        elif kind == "Prescribed Velocity":
            begins[name] = " since the start of this run (the strain before it, by Start From, is not counted)" if goes_on else ""
        elif goes_on:
            begins[name] = " as its Travel has it (a strain before this run, by Start From, is not counted, a gap is)"
        else:
            moves[name], begins[name] = from_the_touch(moves[name], apart_at_first(deck, keys, axis, moves[name][0]))
    return moves, begins, unknown


def initial_time(deck):
    return strut_tools.number(deck.get("Solver", "Initial Time")) or 0


def about_history(deck, path, times, results):
    """Words on a history that may be of another deck, or lacks the beginning or end of its run; None where it is whole."""
    ends = (of_another(deck, path, results), late_begin(deck, times), early_end(deck, times)) if deck else ()
    return "; ".join(words for words in (*ends, cut_row(path)) if words)


def of_another(deck, path, results):
    """Words on a history whose run read another deck, by its checkpoint, or is older than deck or mesh; None of others."""
    ran, mesh = deck_that_ran(deck, path, results), deck.file("Discretization", "Input Mesh File")
    read = [name for name in (None if ran else deck.path, mesh) if name and os.path.isfile(name)]
    newer = [name for name in read if os.path.getmtime(name) > os.path.getmtime(path)]
    changed = ran and ", ".join(deck.changed_from(ran, ("Output", "History", "Restart", "Watch")))
    why = f"older than {' and '.join(newer)}, if changed since" if newer else None
    if changed and ran.path == checkpoint_of(deck, results):
        why = f"{deck.path} has been changed since the run, in {changed}"
    elif changed:
        why = f"of the run that left {ran.path}, whose deck differs in {changed}"
    return why and f"WARNING: {why}: motion and size here may not be those of its forces; run it again"


def checkpoint_of(deck, results):
    return os.path.join(results, deck.get("Restart", "Filename") or os.path.splitext(os.path.basename(deck.path))[0] + ".restart")


def deck_that_ran(deck, path, results):
    """The deck of the run, by the newest checkpoint that is as new as its history and names it; None without one."""
    import netCDF4

    found = {checkpoint_of(deck, results), *glob.glob(os.path.join(glob.escape(results), "*.restart"))}
    ages = {name: os.path.getmtime(path) - os.path.getmtime(name) for name in found if os.path.isfile(name)}
    for checkpoint in sorted((name for name in ages if ages[name] < 1), key=ages.get):  # s; others are of runs before
        try:
            with netCDF4.Dataset(checkpoint) as file:
                ran = Deck.of(checkpoint, in_xml(checkpoint, file.deck))
        except (OSError, AttributeError, SyntaxError):  # damaged, or of an older program
            continue
        if ran.get("History", "Filename") == deck.get("History", "Filename"):
            return ran
    return None


def late_begin(deck, times):
    """Words on a history that lacks the beginning of its run; None if it has it."""
    if deck.section("Start From") is not None or times[0] - initial_time(deck) <= 1e-9 * (times[-1] - times[0]):
        return None
    return f"begins at t = {times[0]:g} s, later than the run, at {initial_time(deck):g} s: the energy that the sample absorbed between the two is left out"


def early_end(deck, times):
    """Words on a history that ends before the end of its run; None if it does not, or nothing says when."""
    ends = [value_at(deck.get(solver, "Final Time", default=""), 0) for solver in ("Solver", "Solver 2")]
    begin, end = initial_time(deck), max((end for end in ends if end is not None), default=times[-1])
    part = (times[-1] - begin) / (end - begin) if end > begin else 1
    return f"ends at t = {times[-1]:g} s, {100 * part:.0f} % of the run to {end:g} s: measures are of this part" if part < 0.99 else None


def cut_row(path):
    """Words on a last line that is not whole."""
    with open(path, "rb") as file:
        file.seek(-1, os.SEEK_END)
        return None if file.read() == b"\n" else "its last row is not whole, and left out"


def taken_off(deck, value):
    """The value at the initial time that decks of Peridigm, and explicit steps, subtract from a prescribed displacement
    that depends on time; 0 if a checkpoint or an initial displacement has moved the points so far already."""
    others = [value_in(keys, "Type") for keys in deck.sections("Boundary Conditions").values()]
    whole = deck.root.get("name") != "Peridigm" and deck.section("Solver", "Verlet") is None
    if whole or "Initial Displacement" in others or deck.section("Start From") is not None:
        return 0
    start = initial_time(deck)
    first, later = value_at(value, start), value_at(value, start + 1)
    return 0 if first is None or first == later else first


def from_the_touch(way, apart):
    """Displacement of a tool after it has moved by `apart` (m; None: unknown) to the body, and words on it."""
    way = way - way[0]  # where it stands at the start, bodies are taken as cut off
    if apart is None:
        return way, " from where it stands at the start (a gap there counts as strain)"
    if apart == 0:
        return way, ""
    toward = -np.sign(apart)
    return toward * np.maximum(toward * way - abs(apart), 0), f" less {abs(apart):.6g} m, by which it stands apart at the start"


def apart_at_first(deck, keys, axis, travel):
    """Where a tool stands beyond the face of the bodies that it meets, m along the axis; 0 where it touches or cuts them off,
    None where that is not known."""
    tool, mesh, of = flat_tool(keys, axis), deck.file("Discretization", "Input Mesh File"), value_in(keys, "Node Set")
    boxes = [tool and mesh and extent.box_in(mesh, None if of in (None, "all") else of, whole) for whole in (True, False)]
    if not all(boxes):
        return None
    cells, material = ((box[0][axis] - travel, box[1][axis] - travel) for box in boxes)
    none = 1e-6 * (cells[1] - cells[0])  # where cells end, also partly filled ones, nothing is apart
    return tool[0] - material[1] if tool[0] - cells[1] > none else tool[1] - material[0] if tool[1] - cells[0] < -none else 0


def flat_tool(keys, axis):
    """From where to where a plane across the axis, or a box, reaches along it, m; None of other tools."""
    names = {"Rigid Plane": ("Point", "Normal"), "Rigid Box": ("Lower Corner", "Upper Corner")}.get(value_in(keys, "Type"), ())
    numbers = [numbers_in(keys, name) for name in names]
    if not numbers or None in numbers:
        return None
    one, other = numbers
    if value_in(keys, "Type") == "Rigid Box":
        return one[axis], other[axis]
    if not is_across(other, axis):
        return None
    return (one[axis], np.inf) if other[axis] < 0 else (-np.inf, one[axis])


def numbers_in(keys, name):
    """The three numbers of a key; None if it has others."""
    row = [strut_tools.number(word) for word in list_in(keys, name)]
    return None if len(row) != 3 or None in row else row


def is_across(normal, axis):
    return normal is not None and abs(normal[axis]) >= (1 - 1e-6) * np.linalg.norm(normal)


def stretch_of_sides(deck, axis, times):
    """The name of the periodic sides across the axis, and how far they come nearer (m); None without such sides that move."""
    for name, keys in deck.sections("Boundary Conditions").items():
        if value_in(keys, "Type") != "Periodic Sides" or value_in(keys, "Coordinate") != "xyz"[axis]:
            continue
        period = float(value_in(keys, "Upper")) - float(value_in(keys, "Lower"))
        stretches = [value_at(value_in(keys, "Stretch") or "1", t) for t in times]
        if None not in stretches and np.ptp(stretches) > 0:
            return name, period * (1 - np.array(stretches))
    return None


def shortening(deck, table, axis, words):
    """The shortening in m, positive, and how it was found."""
    letter, times = "XYZ"[axis], table["Time"]
    if words.shortening:
        if words.shortening in table:
            return signed(table[words.shortening]), words.shortening
        way = [value_at(words.shortening, t) for t in times]
        if None in way:
            column(table, words.shortening, "--shortening")
        return signed(way), words.shortening
    sides = deck and stretch_of_sides(deck, axis, times)
    if sides:  # displacements of points do not show the motion of the sides
        return signed(sides[1]), f"the stretch of the periodic sides `{sides[0]}`"
    means = [n for n in table if re.fullmatch(rf"Mean_Displacement_{letter}\([^ ]+\)", n)]
    if len(means) in (1, 2):
        return signed(table[means[0]] - (table[means[1]] if len(means) == 2 else 0)), " less ".join(means)
    moves, begins, unknown = motion_of(deck, axis, times) if deck else ({}, {}, [])
    ways = list(moves.values())
    if any(np.ptp(way) > 0 for way in ways):  # a fixed rim gives no shortening
        pairs = list(itertools.combinations(ways, 2)) or [(ways[0], np.zeros(len(times)))]
        ends = max(pairs, key=lambda pair: np.abs(pair[0] - pair[1]).max())  # which may return to where they began
        named = ", ".join(f"`{name}`" + begins.get(name, "") for name in moves)
        left_out = f"; left out: {', '.join(f'`{name}`' for name in unknown)}, not a number of the time alone" if unknown else ""
        return signed(ends[0] - ends[1]), f"the motion of {named}{left_out}"
    places = layers(table, axis, words.layers)
    if places is not None:
        apart = np.abs(places[0][:, -1] - places[0][:, 0])
        return (apart[0] - apart) * places[2] / (places[2] - 1), "the distance of the outer layers"
    fail(f"nothing says how far the sample is shortened: add Mean_Displacement_{letter}(top) and "
         f"Mean_Displacement_{letter}(foot) to History > Variables, of a body that flies onto another one layers "
         f"(History > Profiles), or name a column or an expression of t by --shortening")


def unstrained(deck, block, axis, height, how):
    """Words on the part of the height that a motion of outer points leaves unstrained; None if it moves nodes, or sides. The distance
    of layers is corrected for it. By virtual work the force on the outer points, over the area, exceeds the mean stress by the
    height over the strained part of it."""
    if not how.startswith(("Mean_Displacement", "the motion")) or (deck and deck.get("Discretization", "Points") == "Nodes"):
        return None
    edges = extent.edges_of(deck and deck.file("Discretization", "Input Mesh File"), block)
    planes = [keys for keys in deck.sections("Boundary Conditions").values() if value_in(keys, "Type") == "Symmetry Plane"] if deck else []
    is_mirrored = " less " not in how and any(is_across(numbers_in(plane, "Normal"), axis) for plane in planes)
    ends, where = (1, "at the end without a symmetry plane") if is_mirrored else (2, "at each end")
    part = f", {50 * ends * edges[axis] / height:.3g} % of the height in all" if edges is not None else ""
    return f"half a spacing {where}{part}: the outer points are the middles of cells, so that strain is too small by that, and stress too large"


def layers(table, axis, wanted=None):
    """Positions and velocities (rows x layers) of a profile of the history, and the number of layers; or None."""
    found = {}
    for name in table:
        match = LAYERS.fullmatch(name)
        if match and "XYZ".index(match[2]) == axis:
            found.setdefault(match[3], {}).setdefault(match[1], []).append((int(match[4]), name))
    whole = {name: kinds for name, kinds in found.items() if len(kinds) == 2}
    if wanted and wanted not in whole:
        fail(f"--layers: the history has no layers '{wanted}'{nearest(wanted, list(whole))}: it needs "
             f"Mean_Coordinate_{'XYZ'[axis]}({wanted}) and Mean_Velocity_{'XYZ'[axis]}({wanted})")
    if not whole:
        return None
    kinds = whole[wanted or next(iter(whole))]
    places, velocities = (np.stack([table[name] for _, name in sorted(kinds[kind])], axis=1)
                          for kind in ("Coordinate", "Velocity"))
    return places, velocities, places.shape[1]
