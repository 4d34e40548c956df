"""The runs of a study: each in a folder of its own, several at a time, resumed where they were stopped."""
import copy
import errno
import glob
import hashlib
import itertools
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time

from strut_tools import fail, is_open_mpi, mpirun, own_file, program

from . import inputs, logs

OWN_LINE = r"^strut[\w-]*: "  # of an error of strut or strut-mesh
EARLY = 3  # exit status of a run that a signal or its wall time has ended


class Case:
    def __init__(self, values, folder, deck, recipe):
        self.values, self.folder, self.deck = values, folder, os.path.basename(deck.path)
        self.source, text, self.mesh, self.links = inputs.of(deck, recipe)
        self.texts = {self.deck: self.source.text}
        self.recipe = recipe and os.path.basename(recipe.path)
        if recipe is not None:
            self.texts[self.recipe] = text
        self.process, self.started, self.is_meshed = None, 0.0, True
        self.cost = 1.0  # relative to other runs, for the remaining time

    @property
    def log(self):
        return os.path.join(self.folder, "log")

    def mark(self):
        """Identifies the run: it changes with the deck, the recipe, and the files that they read."""
        read = {name: [os.path.getsize(file), os.path.getmtime(file)] for name, file in self.links.items()}
        return hashlib.sha256(json.dumps([self.texts, read], sort_keys=True).encode()).hexdigest()

    def state(self):
        """The recorded state of the run: {mark, over, error, seconds}; empty if there is none for this deck."""
        try:
            with open(os.path.join(self.folder, "state.json")) as file:
                found = json.load(file)
            return found if found.get("mark") == self.mark() else {}
        except (OSError, ValueError):
            return {}

    def put_state(self, **words):
        with open(os.path.join(self.folder, "state.json"), "w") as file:
            json.dump({"mark": self.mark(), **words}, file)

    def done(self):
        return self.state().get("over", False)

    def error(self):
        """Why the run has no result; None if it has one."""
        state = self.state()
        return state.get("error") or (None if state.get("over") else f"stopped at {100 * self.part():.0f} %; the same command goes on with it")

    def prepare(self):
        """True if the run can be resumed. Else the folder is created anew."""
        if self.state() and glob.glob(os.path.join(glob.escape(self.folder), "*.restart*")):
            return True
        if os.path.isdir(self.folder) and not os.path.isfile(os.path.join(self.folder, "state.json")):
            fail(f"{self.folder} is there, and not of a study: name another folder")
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        for name, text in self.texts.items():
            with open(os.path.join(self.folder, name), "w") as file:
                file.write(text)
        for name in [*self.links, *([self.mesh] if self.mesh else []), *(name for _, _, name in inputs.writers_in(self.source))]:
            os.makedirs(os.path.join(self.folder, os.path.dirname(name)), exist_ok=True)
        for name, file in self.links.items():
            os.symlink(file, os.path.join(self.folder, name))
        self.put_state(over=False)
        return False

    def start(self, ranks):
        goes_on = self.prepare()
        with open(self.log, "a") as log:
            status = 0 if goes_on else self.make_mesh(log)
            if status < 0:  # another time it is made anew
                return self.put_state(over=False, error=f"strut-mesh was ended by signal {-status}", seconds=0)
            if status > 0:
                error = last_line(self.log)
                return self.put_state(over=stays(error), error=error, seconds=0)
            self.started = time.monotonic()
            # A process group of its own: only this program passes on a Ctrl-C from the terminal.
            self.process = subprocess.Popen(self.command(ranks, *(["--continue"] if goes_on else [])), cwd=self.folder,
                                            stdout=log, stderr=log, env=environment(), start_new_session=True)
        return None

    def make_mesh(self, log):
        """The exit status. Like a run, it is in a process group of its own, and is ended with the study."""
        if not self.recipe:
            return 0
        self.process, self.is_meshed = subprocess.Popen([program("strut-mesh"), self.recipe, self.mesh], cwd=self.folder,
                                                        stdout=log, stderr=log, start_new_session=True), False
        status = self.process.wait()
        self.process, self.is_meshed = None, True
        return status

    def command(self, ranks, *options):
        return [*(mpirun(ranks) if ranks > 1 else []), program("strut"), *options, self.deck]

    def check(self, ranks):
        """The output of strut --check, in a temporary folder."""
        with tempfile.TemporaryDirectory() as folder:
            trial = copy.copy(self)
            trial.folder = os.path.join(folder, "trial")
            trial.prepare()
            with open(trial.log, "a") as log:
                if trial.make_mesh(log) == 0:
                    subprocess.run(trial.command(ranks, "--check"), cwd=trial.folder, stdout=log, stderr=log,
                                   env=environment())
            return logs.text_of(trial.log)

    def ended(self, stopped=False):
        """True if the run has ended, now or before. One ended by a signal is resumed another time, one whose error
        may pass, as that of an MPI that does not start, is tried again."""
        if self.process is None:
            return True
        status = self.process.poll()
        if status is None:
            return False
        killed = status < 0 or status > 128  # mpirun ends with 128 and the number of the signal
        early = status == EARLY or killed or (stopped and status != 0)
        error = last_line(self.log) if status and not early else None
        self.put_state(over=not early and (error is None or stays(error)), error=error,
                       seconds=self.state().get("seconds", 0) + time.monotonic() - self.started)
        self.process = None
        return True

    def stop(self, ranks):
        """Stops strut, which leaves a checkpoint. Open MPI's mpirun would give its ranks only a second, so they get the
        signal directly; MPICH's, whose children they are not, passes it on and waits."""
        if self.is_meshed and ranks > 1 and is_open_mpi():
            subprocess.run(["pkill", "-TERM", "-P", str(self.process.pid), "-x", "strut"])
        else:
            self.process.terminate()

    def part(self):
        """Fraction of its simulated time that is computed, 0 to 1."""
        found = re.findall(r"^ *(\d+) %  t = ", logs.text_of(self.log), re.M)
        return int(found[-1]) / 100 if found else 0


def environment():
    return {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def claim(out, path, *written):
    """Claims the folder `out` for one study or deck: creates it, and refuses that of another one. `written`: files
    there besides the runs."""
    os.makedirs(out, exist_ok=True)
    note, own = os.path.join(out, "runs-of.json"), os.path.realpath(path)
    try:
        with open(note) as file:
            found = json.load(file).get("path")
    except FileNotFoundError:
        found = None
    except (ValueError, AttributeError):
        fail(f"{note} is damaged: remove it, or name another folder")
    if found not in (None, own):
        fail(f"{out} has the runs of {found}: name another folder (or remove {note}, if it is the same one in another place)")
    of_runs = glob.glob(os.path.join(glob.escape(out), "*", "state.json"))
    there = [name for name in written if os.path.lexists(os.path.join(out, name))]
    if found is None and there and not of_runs:
        fail(f"{os.path.join(out, there[0])} is there, and not of runs in this folder: name another folder")
    with open(own_file(out, "runs-of.json"), "w") as file:
        json.dump({"path": own}, file)


def stays(error):
    """True of an error of strut or strut-mesh, which another try would meet again, as not that of a full disk."""
    return re.match(OWN_LINE, error) is not None and os.strerror(errno.ENOSPC) not in error


def last_line(path):
    """The error message of a program, with the problems that it lists."""
    lines = [line for line in logs.text_of(path).split("\n") if line.strip()]
    own = [n for n, line in enumerate(lines) if re.match(OWN_LINE, line)]
    if not own:
        return (lines or ["it said nothing"])[-1].strip()
    listed = itertools.takewhile(lambda line: line.startswith("  "), lines[own[-1] + 1:])  # MPI's messages come after it
    return lines[own[-1]].strip() + "".join(f"; {line.strip()}" for line in listed)


def run_all(cases, ranks, tell, jobs=None):
    """Runs several at a time, else as many as there are cores for. Ends the tool if a signal has stopped them."""
    jobs = jobs or max(1, len(os.sched_getaffinity(0)) // ranks)
    waiting, running, stopped = [c for c in cases if not c.done()], [], []

    def stop(*_):
        stopped.append(True)
        for case in running:
            if case.process is not None:
                case.stop(ranks)
    before = {s: signal.signal(s, stop) for s in (signal.SIGINT, signal.SIGTERM)}
    began, ahead = time.monotonic(), sum(case.cost for case in waiting)
    while (waiting and not stopped) or running:
        while waiting and len(running) < jobs and not stopped:
            case = waiting.pop(0)
            running.append(case)
            case.start(ranks)
            if stopped and case.process is not None:  # when its mesh had just been made
                case.stop(ranks)
        over = [case for case in running if case.ended(stopped)]
        running = [case for case in running if case not in over]
        to_do = sum(case.cost for case in waiting) + sum(case.cost * (1 - case.part()) for case in running)
        tell(over, running, len(cases) - len(waiting) - len(running), left(began, ahead, to_do))
        if not over:
            time.sleep(0.2)
    for number, handler in before.items():
        signal.signal(number, handler)
    if stopped:
        fail("stopped by a signal; the same command goes on with it")


def left(began, ahead, to_do):
    """Remaining seconds, from the progress since the start; None if that is almost nothing."""
    done = ahead - to_do
    return (time.monotonic() - began) / done * to_do if done > 0.02 else None


def duration(seconds):
    if seconds is None:
        return "unknown"
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"
