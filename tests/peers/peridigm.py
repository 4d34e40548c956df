#!/usr/bin/python3
"""Decks of Peridigm as they are, beside its gold results: which run, which agree, and what the program says of the rest.

    peridigm.py PERIDIGM STRUT [--only WORD] [--seconds 60] [--keep FOLDER]

PERIDIGM is its source folder (with test/ and examples/), STRUT the program. Each deck runs in a copy of its folder, from
the folder that its test runs in, on one thread. A run that takes longer is ended, and its frames are compared so far. A
row a deck:

    deck | runs, refused or where it was ended | agrees, or differs by, or no gold | the error, or the keys that were told

A difference is the largest of a variable over the largest magnitude of its gold values, in all common frames.
"""
import argparse
import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import netCDF4
    import numpy as np
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-netcdf4)")
    sys.exit(77)

AGREES = 1e-5  # of the largest value: equilibria of both programs leave some 1e-6 of the load
NOTHING = 1e-14  # in the deck's units: gold values that are all below are round-off
OF_MODULUS = 1e-13  # of the largest modulus: forces and stresses that are all below are, too


def decks(root):
    """All decks but copies of one another and those of the performance tests, which are those of examples/ again."""
    seen = set()
    for path in sorted(p for kind in ("xml", "yaml", "peridigm") for p in root.glob(f"[te]*/**/*.{kind}")):
        content = hashlib.sha1(path.read_bytes()).digest()
        if content in seen or path.is_symlink() or {"performance", "np1", "np3", "np4"} & set(path.parts):
            continue
        seen.add(content)
        yield path


def gold_of(deck):
    """The gold result that stands beside a deck under its name; one of another name if it is the only one."""
    own = deck.with_name(deck.stem + "_gold.e")
    others = list(deck.parent.glob("*_gold.e"))
    return own if own.exists() else others[0] if len(others) == 1 and len(list(deck.parent.glob("*.xml"))) == 1 else None


def names_of(data, kind):
    key = f"name_{kind}_var"
    if key not in data.variables:
        return []
    return [b"".join(row.compressed() if np.ma.isMaskedArray(row) else row).decode().strip("\0 ") for row in data[key][:]]


def values_at_points(path):
    """{variable: [frame, point]}, times, and the reference positions of the points."""
    with netCDF4.Dataset(path) as data:
        axes = [data["coord" + a][:].filled() for a in "xyz" if "coord" + a in data.variables]
        places = np.stack(axes, 1) if axes else data["coord"][:].filled().T
        blocks = range(1, data.dimensions["num_el_blk"].size + 1)
        counts = [data.dimensions[f"num_el_in_blk{b}"].size if f"connect{b}" in data.variables else 0 for b in blocks]
        joined = [data[f"connect{b}"][:, 0] - 1 for b, n in zip(blocks, counts) if n]
        nodes = np.concatenate(joined) if joined else np.arange(0)
        found = {}
        for n, name in enumerate(names_of(data, "nod"), 1):
            found[name] = np.asarray(data[f"vals_nod_var{n}"][:], float)[:, nodes]
        for n, name in enumerate(names_of(data, "elem"), 1):
            if all(f"vals_elem_var{n}eb{b}" in data.variables for b, count in zip(blocks, counts) if count):
                found[name] = np.concatenate(
                    [np.asarray(data[f"vals_elem_var{n}eb{b}"][:], float) for b, count in zip(blocks, counts) if count], 1)
        times = np.asarray(data["time_whole"][:], float)
    return found, times, places[nodes]


def kind_of(name):
    return re.sub(r"(?<=[a-z])[XYZ]{1,2}$", "", name)


def at_times(values, times, wanted):
    """Values at other times, linearly between frames."""
    after = np.clip(np.searchsorted(times, wanted), 1, len(times) - 1) if len(times) > 1 else np.zeros(len(wanted), int)
    before = np.maximum(after - 1, 0)
    gap = np.where(times[after] > times[before], times[after] - times[before], 1)
    part = np.clip((wanted - times[before]) / gap, 0, 1)[:, None]
    return (1 - part) * values[before] + part * values[after]


def modulus_of(deck):
    """The largest modulus of a deck; 0 without any."""
    given = re.findall(r"""Modulus["']?[^\n]*?(?:value=["']|:\s*)([\d.eE+-]+)""", deck.read_text(errors="replace"))
    return max((float(number) for number in given), default=0.0)


def differences(theirs, mine, modulus):
    """{variable: the largest difference over the largest gold value of all its components}."""
    largest, scales = {}, {}
    for name, values in theirs.items():
        kind = kind_of(name)
        scales[kind] = max(scales.get(kind, 0.0), np.abs(values).max(initial=0))
        if name in mine and kind not in ("ID", "Proc_Num", "ProcessorNumber", "Element_Id"):
            off = np.abs(values - mine[name])
            # max() drops NaN, and a run that blew up would agree.
            worst = off.max(initial=0) if np.isfinite(off).all() else np.inf
            largest[kind] = max(largest.get(kind, 0.0), worst)
    nothing = {kind: OF_MODULUS * modulus if re.search("Force|Stress", kind) else NOTHING for kind in largest}
    return {kind: value / scales[kind] if scales[kind] > nothing[kind] else float(value > nothing[kind])
            for kind, value in largest.items()}


def compare(result, gold, modulus):
    """In words, and the largest difference."""
    mine, my_times, my_places = values_at_points(result)
    theirs, times, places = values_at_points(gold)
    if len(my_places) != len(places):
        return f"has {len(my_places)} points in place of {len(places)}", 1.0
    order = [int(((my_places - place) ** 2).sum(1).argmin()) for place in places]
    mine = {name: values[:, order] for name, values in mine.items()}
    close = 1e-6 * max(abs(times[-1]), 1e-300)
    common = [i for i, t in enumerate(times) if np.abs(my_times - t).min() < close]
    between = len(common) < 2 < len(times)  # steps of another length
    chosen = [i for i, t in enumerate(times) if t <= my_times[-1] + close] if between else common
    chosen = [i for i in chosen if i == 0 or times[i] > times[i - 1]]  # a second solver begins with a frame of zeros
    if not chosen:
        return "no common frame", 1.0
    if between:
        mine = {name: at_times(values, my_times, times[chosen]) for name, values in mine.items()}
    else:
        nearest = [int(np.abs(my_times - times[i]).argmin()) for i in chosen]
        mine = {name: values[nearest] for name, values in mine.items()}
    found = differences({name: values[chosen] for name, values in theirs.items()}, mine, modulus)
    if not found:
        return "no common variable", 1.0
    worst = sorted(((value, name) for name, value in found.items()), reverse=True)
    frames = f"{len(chosen)} of {len(times)} frames" + (", between ours" if between else "")
    if worst[0][0] <= AGREES:
        return f"agrees ({worst[0][0]:.0e}; {frames})", 0.0
    return "differs: " + ", ".join(f"{n} {v:.1e}" for v, n in worst[:4] if v > AGREES) + f" ({frames})", worst[0][0]


def folder_of_test(copy, name):
    """Where a deck's test runs: its paths are relative to that."""
    return next((d for d in (copy / "np1" / name, copy / "np1") if d.is_dir()), copy)


def run(deck, arguments):
    """How the run ended, what it said, and the results that it wrote."""
    copy = arguments.keep / deck.parent.relative_to(arguments.peridigm) / deck.stem
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(deck.parent, copy, ignore_dangling_symlinks=True)
    folder = folder_of_test(copy, deck.stem)
    before = set(folder.iterdir())
    command = [str(arguments.strut.absolute()), os.path.relpath(copy / deck.name, folder)]
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               env={**os.environ, "OMP_NUM_THREADS": "1"})
    try:
        said, _ = process.communicate(timeout=arguments.seconds)
        end = "runs" if process.returncode == 0 else "refused"
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGTERM)
        said, _ = process.communicate()
        reached = re.search(r"goes on from t = (\S+) s", said)
        end = f"ended at t = {reached[1] if reached else 0}"
    (copy / "said.txt").write_text(said)
    if end == "refused" and re.search(r"^(  0 %|step +1 )", said, re.M):
        end = "stopped"
    return end, said, sorted(f for f in set(folder.iterdir()) - before if f.suffix == ".e")


def shortened(text, most=200):
    return text if len(text) <= most else text[:most - 2] + " …"


def reasons(end, said):
    """The errors of a refused deck; else the keys that were told to mean something else."""
    lines = said.strip().splitlines()
    if end in ("refused", "stopped"):
        problems = [line.strip() for line in lines if line.startswith("  ") and ": " in line and "%" not in line[:6]]
        return [shortened("; ".join(problems if end == "refused" and problems else lines[-1:]))]
    told = [re.split(r" (?:is|has|goes|are|have|holds|falls|weighs|counts) ", line)[0].split(" > ", 1)[1]
            for line in lines if re.match(r"[A-Z][\w ]+ > ", line)]
    told += [line.split(";")[0].split(":")[0] for line in lines if re.match(r"Blocks .*Peridigm", line)]
    return list(dict.fromkeys(told))


def row(deck, arguments):
    end, said, results = run(deck, arguments)
    gold = gold_of(deck)
    verdict = ""
    if end == "runs" or end.startswith("ended"):
        found = [compare(result, gold, modulus_of(deck)) for result in results] if gold else []
        verdict = min(found, key=lambda one: one[1])[0] if found else "no gold result" if not gold else "no result"
    return [str(deck.relative_to(arguments.peridigm)), end, verdict, "; ".join(reasons(end, said))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("peridigm", type=Path)
    parser.add_argument("strut", type=Path)
    parser.add_argument("--only", default="", help="decks whose path holds this word")
    parser.add_argument("--seconds", type=float, default=60, help="of a run")
    parser.add_argument("--keep", type=Path, help="folder for the runs, kept")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        arguments.keep = (arguments.keep or Path(folder)).absolute()
        rows = []
        for deck in decks(arguments.peridigm):
            if arguments.only in str(deck):
                rows.append(row(deck, arguments))
                print(" | ".join(rows[-1]), flush=True)
    count = {end: sum(r[1].startswith(end) for r in rows) for end in ("runs", "ended", "stopped", "refused")}
    verdicts = {word: sum(r[2].startswith(word) for r in rows) for word in ("agrees", "differs", "no gold")}
    print(f"{len(rows)} decks, each at most {arguments.seconds:g} s on one thread: " +
          ", ".join(f"{n} {word}" for word, n in {**count, **verdicts}.items()))


if __name__ == "__main__":
    main()
