"""Shared by the Python tools: install missing packages, end with one line, run programs, fill pages."""
import argparse
import contextlib
import csv
import difflib
import functools
import math
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile

os.environ["MPLBACKEND"] = "Agg"  # figures need no screen
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def fail(text):
    """Ends the tool with one line that names it, and status 1."""
    name = os.path.basename(sys.argv[0])
    sys.exit(f"{'' if name.startswith('strut') else 'tools/'}{name}: {text}")


def run(main):
    """A tool: an error of a file is one line."""
    try:
        main()
    except OSError as error:
        fail(str(error))


def install_missing(*modules):
    """Restarts the script with Debian's Python if need be, and installs what it lacks."""
    import importlib.util

    missing = [f"python3-{'vtk9' if module == 'vtkmodules' else module.lower()}" for module in modules if importlib.util.find_spec(module) is None]
    if not missing:
        return
    debians = "/usr/bin/python3"  # which Debian's packages are for
    if os.path.exists(debians) and os.path.realpath(sys.executable) != os.path.realpath(debians):
        os.execv(debians, [debians, *sys.argv])
    if os.environ.get("STRUT_TOOLS_INSTALLED"):
        fail(f"these packages are installed but cannot be imported: {' '.join(missing)}")
    print("installing", *missing, flush=True)
    root = [] if os.geteuid() == 0 else ["sudo"]
    command = ("export DEBIAN_FRONTEND=noninteractive; apt-get -qq update && "
               "apt-get -qq install -y --no-remove --no-install-recommends \"$@\" >/dev/null")
    if subprocess.run([*root, "sh", "-c", command, "sh", *missing]).returncode != 0:
        fail(f"these packages could not be installed, or not without removing others: {' '.join(missing)}")
    os.environ["STRUT_TOOLS_INSTALLED"] = "1"
    os.execv(sys.executable, [sys.executable, *sys.argv])


# The command line


def nearest(word, words, likeness=0.6):
    """" (did you mean 'x'?)", or nothing."""
    close = difflib.get_close_matches(word, words, 1, likeness)
    return f" (did you mean '{close[0]}'?)" if close else ""


def number(word):
    try:
        return float(word)
    except (TypeError, ValueError):
        return None


class Parser(argparse.ArgumentParser):
    """argparse with one-line errors and the nearest option. An option takes as many numbers as follow it, or none if
    that is one of its counts: a file's name may follow them, and they may be negative. They are finite, and `above` a number or
    `within` two."""

    def __init__(self, **words):
        super().__init__(allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter, **words)
        self.counts = {}

    def add_numbers(self, option, *counts, kind=float, above=-math.inf, within=(-math.inf, math.inf), **words):
        self.counts[option] = counts
        wanted = f"{' or '.join(map(str, counts)).replace('0', 'no')} {'whole ' if kind is int else ''}number{'s' * (counts != (1,))}"
        wanted += f" > {above}" if above > -math.inf else f" from {within[0]} to {within[1]}" if within[0] > -math.inf else ""

        def numbers(text):
            found = [number(word) for word in text.split(",") if text]
            if len(found) not in counts or not all(x is not None and math.isfinite(x) and x == kind(x) and x > above and
                                                   within[0] <= x <= within[1] for x in found):
                raise argparse.ArgumentTypeError(f"expected {wanted}, found '{text}'")
            return [kind(x) for x in found] if counts != (1,) else kind(found[0])

        self.add_argument(option, type=numbers, **words)

    def parse_args(self, words=None):
        found, unknown = self.parse_known_intermixed_args(self.joined(sys.argv[1:] if words is None else words))
        if unknown:
            self.error(f"unknown option '{unknown[0]}'{nearest(unknown[0], self._option_string_actions)}")
        return found

    def joined(self, words):
        """--size 1 2 3 -> --size=1,2,3"""
        out = []
        while words:
            word, *words = words
            if word in self.counts:
                most = max(self.counts[word])
                taken = 0
                while taken < min(most, len(words)) and number(words[taken]) is not None:
                    taken += 1
                if taken or 0 in self.counts[word]:
                    word, words = f"{word}={','.join(words[:taken])}", words[taken:]
            out.append(word)
        return out

    def error(self, message):
        fail(f"{message}; --help has all options")


# Output files. A file that the user names is replaced, unless it is an input; one that a tool names by itself is
# created anew, never written through a link


def check_output(path, *read):
    """Checks an output path before the work is done. `read`: the input files."""
    folder = os.path.dirname(path) or "."
    if os.path.isdir(path):
        fail(f"{path} is a folder, expected the name of a file to write")
    if not os.path.isdir(folder):
        fail(f"{path} cannot be written: there is no folder {folder}")
    for file in read:
        if os.path.exists(path) and os.path.exists(file) and os.path.samefile(path, file):  # through links
            fail(f"{path} is {file}, which is read: expected another file to write" if path != file else
                 f"{path} is read: expected another file to write")


def check_input(path):
    """Checks the path of an input, a file or a folder: a pipe without a writer would block for ever."""
    if not os.path.exists(path):
        fail(f"{path} does not exist")
    if not os.path.isfile(path) and not os.path.isdir(path):
        fail(f"{path} is a pipe or a device, expected a file")


def own_file(folder, name, *read, is_ours=None):
    """The path of a file that a tool names by itself, ready for writing: it must not be an input, and the target of a
    link is preserved. `is_ours`: tells if an existing file is of this tool; else it is the user's, and preserved."""
    path = os.path.join(folder, name)
    check_output(path, *read)
    if is_ours and os.path.isfile(path) and not os.path.islink(path) and not is_ours(path):
        fail(f"{path} is there and was not written by this tool, which would replace it: expected another folder, or that it is "
             "removed")
    if os.path.islink(path) or (os.path.isfile(path) and os.stat(path).st_nlink > 1):
        os.unlink(path)
    return path


def make_folder(path):
    """Makes the folder of results, unless it is there."""
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        fail(f"the folder {path} cannot be made: {'a file has its name' if os.path.isfile(path) else error.strerror}")


@contextlib.contextmanager
def part_of(path):
    """The name under which a file is written until it is whole: where the disk is full, an earlier one stays."""
    whole = os.path.realpath(path)
    part = f"{whole}.{os.getpid()}.part{os.path.splitext(path)[1]}"
    try:
        yield part
        os.replace(part, whole)
    except OSError as error:
        fail(f"{path} cannot be written: {error.strerror}")
    finally:
        if os.path.exists(part):
            os.unlink(part)


def write_table(path, header, rows):
    """A CSV; of numbers nine digits, nothing for None."""
    with part_of(path) as part, open(part, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([f"{value:.9g}" if isinstance(value, float) else value for value in row] for row in rows)


def begins(path, text):
    with open(path, "rb") as file:
        return file.read(len(text)) in (text.encode(), b"")


MARK = "strut"  # the program that made a picture


def save_picture(figure, path, dpi=110):
    """Saves a picture with a mark of its program, which own_file checks, and closes it. Returns the path."""
    from matplotlib import pyplot

    with part_of(path) as part:
        figure.savefig(part, metadata={"Software": MARK} if path.endswith(".png") else None, dpi=dpi)
    pyplot.close(figure)
    return path


def is_our_picture(path):
    """True for a picture with our mark, or an empty file."""
    with open(path, "rb") as file:
        head = file.read(4096)
    return not head or b"Software\0" + MARK.encode() in head


# Libraries that crash, and those that print


def run_guarded(main, no_memory):
    """Runs main() in a child process: if a damaged file makes a library crash, this process can report it."""
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        try:
            try:
                return main()
            except MemoryError:
                fail(no_memory)
            except (OSError, OverflowError) as error:
                fail(str(error))
        except SystemExit as end:  # what libraries do at the exit after an error says nothing of the file
            if isinstance(end.code, str):
                print(end.code, file=sys.stderr)
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(1 if isinstance(end.code, str) else end.code or 0)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the terminal signals both
    signal.signal(signal.SIGTERM, lambda *_: os.kill(child, signal.SIGTERM))
    _, status = os.waitpid(child, 0)
    code = os.waitstatus_to_exitcode(status)
    if code == -signal.SIGKILL:
        fail(f"it was killed; {no_memory}")
    if code < 0 and -code not in (signal.SIGINT, signal.SIGTERM):
        fail(f"the file is damaged: the library that reads it ended by signal {-code}")
    sys.exit(code if code >= 0 else 128 - code)


class Said:
    text = ""

    def error(self):
        """The first line that looks like an error, without VTK's prefix (date, file, address)."""
        text = re.sub(r"^\d{4}-\d\d-\d\d .*?\| |(ERROR|Warning): In \S+, line \d+\n|vtk\w+ \(0x[0-9a-f]+\): ",
                      "", re.sub(r"\x1b\[[0-9;]*m", "", self.text), flags=re.M)
        lines = [line.strip() for line in text.splitlines() if line.strip()]
        sounds = "error|fail|cannot|could not|unable|invalid|not |trunc|corrupt"
        bad = [line for line in lines if re.search(sounds, line, re.I)]
        return (bad or [""])[0]


@contextlib.contextmanager
def captured():
    """Captures the output of libraries, also those in C: .text contains it afterwards."""
    said = Said()
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(1), os.dup(2)]
    with tempfile.TemporaryFile() as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
        try:
            yield said
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            for old, stream in zip(kept, (1, 2)):
                os.dup2(old, stream)
                os.close(old)
            file.seek(0)
            said.text = file.read().decode(errors="replace")


# Programs, and what they write


@functools.cache
def program(name):
    """The path of strut, strut-mesh, …: from the variable STRUT, STRUT_MESH, …, else in this source tree (built if
    stale), else in an installed tree."""
    if path := os.environ.get(name.upper().replace("-", "_")):
        return path
    prepare = os.path.join(ROOT, "tools", "prepare")
    if not os.path.exists(prepare):
        return os.path.join(ROOT, "..", "..", "bin", name)
    if subprocess.run([prepare, "release", "--target", name]).returncode != 0:
        fail(f"{name} could not be built")
    return os.path.join(ROOT, "build", "release", "." if name == "strut" else "tools", name)


@functools.cache
def is_open_mpi(program="mpirun"):
    found = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
    return "Open MPI" in found or "OpenRTE" in found


def mpirun(ranks):
    """The command that starts this many ranks; Open MPI's mpirun needs options for runs that share cores."""
    return ["mpirun", *(["--oversubscribe", "--bind-to", "none"] if is_open_mpi() else []), "-np", str(ranks)]


def run_deck(deck, folder, ranks=None, limit=None):
    """tools/run of a deck in a folder: the text of its log, which is kept there as NAME.log. `limit`: seconds after
    which the run is stopped, which is no failure."""
    log = os.path.join(folder, os.path.splitext(os.path.basename(deck))[0] + ".log")
    command = [os.path.join(ROOT, "tools/run"), *(["-np", str(ranks)] if ranks else []), str(deck)]
    if limit:
        command = ["timeout", "-k", "10", str(limit), *command]
    with open(log, "w") as output:
        subprocess.run(command, cwd=folder, stdout=output, stderr=subprocess.STDOUT if limit else None, check=not limit)
    with open(log) as output:
        return output.read()


def columns(path, growing=False):
    """The columns of a table (CSV) by name; lines that begin with # give the writer and the units. Ends the tool if it is damaged, or
    cut off, because a truncated number has another value; `growing`: a run may be writing its last line, which is left out."""
    import numpy as np

    if not os.path.isfile(path):
        fail(f"{path} does not exist")
    try:
        with open(path, newline="") as file:
            *lines, last = file.read().split("\n")
        if last and not growing:
            fail(f"{path} is cut off in line {len(lines) + 1}, '{last[-30:]}' (or a run is about to write it: try again)")
        places = [place for place, line in enumerate(lines, 1) if not line.startswith("#")]
        if not places:
            fail(f"{path} is empty")
        header, *rows = csv.reader((lines[place - 1] for place in places), skipinitialspace=True)
    except (UnicodeDecodeError, csv.Error) as error:
        fail(f"{path} is not a table: {error}")
    table = []
    for place, row in zip(places[1:], rows):
        if len(row) != len(header):
            fail(f"{path} is damaged: line {place} has {len(row)} values, expected {len(header)} as in its head")
        table.append([number(word) for word in row])
        if None in table[-1]:
            fail(f"{path} is damaged: line {place} has '{row[table[-1].index(None)]}', expected a number")
    if twice := [name for name in header if header.count(name) > 1]:
        fail(f"{path} has two columns '{twice[0]}', expected each once")
    return dict(zip(header, np.array(table, float).reshape(-1, len(header)).T))


def history(path, growing=False):
    """The columns() of a history."""
    table = columns(path, growing)
    if not len(table.get("Time", ())):
        fail(f"{path} is not a history: it has no column Time, or no rows")
    return table


def history_of(path):
    """The rows of a history, as numbers by column."""
    table = history(path)
    return [dict(zip(table, map(float, row))) for row in zip(*table.values())]


def with_core_seconds(run):
    """The result of run(), and the processor time of the programs that it ran, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    result = run()
    return result, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def seconds_of_phase(report, phase):
    """Wall time of a phase, s, from strut's closing table; 0 if it has no such row."""
    found = re.search(rf"^{phase} +([0-9.]+)", report, re.M)
    return float(found.group(1)) if found else 0.0


def put_into_page(page, name, body):
    """Replaces the text between <!-- name --> and <!-- end --> in the file `page` (a pathlib.Path); prints it if the page has
    no such place."""
    pattern = re.compile(f"(<!-- {name} -->\n).*?(<!-- end -->)", re.S)
    text, places = pattern.subn(lambda m: m.group(1) + body + "\n" + m.group(2), page.read_text())
    if places:
        page.write_text(text)
    else:
        print(f"{name}\n{body}")


def run_parts(page, parts):
    """For a script that fills the tables of a page: runs the parts in its command line, or all. {name: function}"""
    chosen = sys.argv[1:] or list(parts)
    for name in chosen:
        if name not in parts:
            script = os.path.relpath(os.path.abspath(sys.argv[0]), ROOT)
            sys.exit(f"{script}: there is no part '{name}'; there are {', '.join(parts)}")
    for name in chosen:
        put_into_page(page, name, parts[name]())


def percent(value, known, digits=1):
    """The signed relative error of a value."""
    return f"{100 * (value / known - 1):+.{digits}f} %"
