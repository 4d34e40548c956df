#!/usr/bin/python3
"""A net for meetings of features that each work alone.

  meetings.py [--scenes N] [--seed S] [--only NAME,NAME] [--all] [--jobs J] [--keep FOLDER] run_many strut mpirun [its options]

Draws scenes at random from the deck's own schema (`strut --keys`): small bodies, their materials, damage, contact, tools, loads,
steps. Each is run (run_many.cpp, some milliseconds), held against laws that every run must keep (laws.py), and run again in
another way that must give the same (relations.py): moved, turned, mirrored, in other units, in another order, on more ranks and
threads, broken off and continued, cut into blocks, halved by a symmetry plane, …. Of these each scene gets some at random; with
--all, all of them.

What fails is shrunk (shrink.py) to a small deck that fails in the same way, and kept in FOLDER (meetings-failures) with its mesh and a
page that names seed, relation and what differed. To see it again:

  meetings.py --seed SEED --scenes 1 --only "RELATION" …

SEED is the scene's own, which is printed: scene n of a run has the seed S + n. New keys and choices of the schema are drawn by
themselves; keys need a range in values.py, and the test fails without. A choice that no scene has had fails it, too.
"""
import argparse
import collections
import os
import shutil
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing.util import Finalize
from pathlib import Path

try:
    import netCDF4  # noqa: F401
    import numpy as np
except ImportError as missing:
    print(f"left out: {missing} (Debian: python3-netcdf4, python3-numpy)")
    sys.exit(77)

sys.path.append(str(Path(__file__).resolve().parents[2] / "tools" / "shared"))
from known import known  # noqa: E402
from laws import LAWS, NotHere  # noqa: E402
from relations import RELATIONS, Case  # noqa: E402
from runs import Runner  # noqa: E402
from scenes import drawn, written, without_a_range  # noqa: E402
from schema import schema_of  # noqa: E402
from shrink import shrunk  # noqa: E402

RELATIONS_A_SCENE = 5  # in the short run
VERBOSE = bool(os.environ.get("MEETINGS_VERBOSE"))
ATTEMPTS = 40  # to draw a scene that is not refused


def failure_of(case, name):
    """The violation of a law or relation, or None; and the reason why it was not checked."""
    try:
        if name in LAWS:
            if case.base.status == 1 and name != "stable":
                raise NotHere("the run ends with an error")
            problem = LAWS[name](case.scene, case.base, case.written)
            return (case.signs_in_shorter_steps() if problem and "Fracture_Energy" in problem else problem), None
        if case.base.status == 1 and not case.scene.explicit:
            raise NotHere("there is no equilibrium, which takes long to find out")
        if case.scene.is_long:
            raise NotHere("some thousand steps amplify what others would see")
        return RELATIONS[name](case), None
    except NotHere as reason:
        return None, str(reason)


class Worker:
    def __init__(self, options):
        self.options = options
        self.schema = schema_of(options.strut)
        self.folder = Path(tempfile.mkdtemp(prefix="meetings-", dir="/dev/shm" if os.path.isdir("/dev/shm") else None))
        self.runner = Runner(options.run_many, options.mpirun, self.folder)

    def close(self):
        self.runner.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def case(self, seed):
        """The first scene from this seed on that the program does not refuse, and what it said of the others."""
        refusals = []
        for attempt in range(ATTEMPTS):
            case = Case(drawn(self.schema, seed + 1000003 * attempt), self.runner, seed)
            slow = case.base.status == "hang" and not case.scene.explicit
            if not case.base.refused and not slow:
                return case, refusals
            refusals.append("an equilibrium is hard to find" if slow else case.base.error)
        raise SystemExit(f"seed {seed}: {ATTEMPTS} scenes were refused, the last with: {refusals[-1]}")

    def scene(self, seed):
        case, refusals = self.case(seed)
        report = {"seed": seed, "refusals": refusals, "asked": [], "left out": [], "known": [], "failures": [], "seen": choices_of(case.scene), "error": case.base.error, "about": case.scene.summary()}
        if case.base.status in ("crash", "hang"):
            report["failures"].append((case.base.status, case.base.log[-300:], None))
            return report
        names = [*LAWS, *RELATIONS]
        if self.options.only:
            names = self.options.only
        elif not self.options.all:
            rng = np.random.default_rng([seed, 1])
            names = [*LAWS, *rng.choice(list(RELATIONS), RELATIONS_A_SCENE, replace=False)]
        for name in names:
            problem, reason = failure_of(case, name)
            (report["asked"] if reason is None else report["left out"]).append((name, reason))
            if problem and known(case, name, problem):
                report["known"].append((known(case, name, problem), name, problem))
            elif problem:
                report["failures"].append((name, problem, self.kept(case, name, problem)))
        return report

    def kept(self, case, name, problem):
        """Shrunk, where it is wanted, and in the folder of failures."""
        folder = Path(self.options.keep).resolve() / f"{case.seed}-{name.replace(' ', '-')}"
        shutil.rmtree(folder, ignore_errors=True)
        scene = case.scene
        if self.options.shrink and problem != "hang":  # which takes minutes each time
            scene, problem = shrunk(case, name, problem, lambda one: Case(one, self.runner, case.seed), failure_of)
        written(scene).write(folder)
        (folder / "README").write_text(f"seed {case.seed}, {name}: {problem}\n{len(scene.mesh.sites())} points; the whole scene is in `whole`\n")
        written(case.scene).write(folder / "whole")
        return str(folder)


def choices_of(scene):
    """Every choice of the schema that the scene has made: Hardening > Type = Voce."""
    found = set()

    def walk(section, path):
        for key, value in section.items():
            if isinstance(value, dict):
                walk(value, key)
            elif isinstance(value, str):
                found.add((key, value))
    walk(scene.deck, "")
    return found


def never_drawn(schema, seen):
    """Choices of the schema that no scene had, but for those of what is not drawn."""
    from values import NOT_DRAWN
    missing = set()
    for section in schema.within():
        if any((section.path + " >").startswith(path + " >") for path in NOT_DRAWN):
            continue
        for key in section.keys.values():
            path = f"{section.path} > {key.name}"
            if key.kind == "choice" and not key.without_effect and path not in NOT_DRAWN:
                missing |= {(key.name, choice) for choice in key.choices if (key.name, choice) not in seen}
    return sorted(missing)


WORKER = None


def begin(options):
    global WORKER
    WORKER = Worker(options)
    Finalize(None, WORKER.close, exitpriority=1)  # also at the end of a process of a pool, where atexit has no part


def work(seed):
    return WORKER.scene(seed)


def reports_of(options):
    seeds = range(options.seed, options.seed + options.scenes)
    if options.jobs == 1:
        begin(options)
        yield from map(work, seeds)
        return
    with ProcessPoolExecutor(options.jobs, initializer=begin, initargs=(options,)) as pool:
        yield from pool.map(work, seeds)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=lambda text: text.split(","), metavar="NAME,NAME", help=f"of {', '.join([*LAWS, *RELATIONS])}")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", default="meetings-failures")
    parser.add_argument("--no-shrink", dest="shrink", action="store_false")
    parser.add_argument("run_many")
    parser.add_argument("strut")
    parser.add_argument("mpirun", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    unknown = [name for name in options.only or () if name not in {*LAWS, *RELATIONS}]
    if unknown:
        parser.error(f"--only {','.join(unknown)}: expected some of {', '.join([*LAWS, *RELATIONS])}")
    schema = schema_of(options.strut)
    problems = [f"values.py has no range for {key}" for key in without_a_range(schema)]
    began, seen, asked, left, refusals, faults, failures, errors = time.monotonic(), set(), *(collections.Counter() for _ in range(4)), [], 0
    for report in reports_of(options):
        seen |= report["seen"]
        asked.update(name for name, _ in report["asked"])
        left.update(report["left out"])
        refusals.update(text[:110] for text in report["refusals"])
        errors += bool(report["error"])
        for sentence, name, problem in report["known"]:
            faults[sentence] += 1
            if VERBOSE:
                print(f"known: seed {report['seed']}, {name}: {problem} ({sentence})", flush=True)
        for name, problem, folder in report["failures"]:
            failures.append(name)
            print(f"FAILED: seed {report['seed']}, {name}: {problem} [{report['about']}]" + (f" ({folder})" if folder else ""), flush=True)
    if options.scenes >= 200:
        problems += [f"no scene had {key} = {choice}" for key, choice in never_drawn(schema, seen)]
    for problem in problems:
        print(f"FAILED: {problem}")
    print(f"{options.scenes} scenes, {time.monotonic() - began:.0f} s; {errors} of them ended with an error; {sum(refusals.values())} more were refused")
    for name in [*LAWS, *RELATIONS]:
        print(f"  {name}: asked of {asked[name]}, {failures.count(name)} failed")
    for sentence, count in faults.most_common():
        print(f"  known: {count}: {sentence}")
    if VERBOSE:
        for (name, reason), count in left.most_common():
            print(f"  left out {count}: {name}: {reason}")
        for text, count in refusals.most_common(12):
            print(f"  refused {count}: {text}")
    return 1 if failures or problems else 0


if __name__ == "__main__":
    sys.exit(main())
