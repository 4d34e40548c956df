"""The logs of runs, and the warnings in them: each is told once, with the number of runs that it stands in."""
import os
import re

NUMBER = re.compile(r"(?<![\w.])[-+]?\d[\d.,]*(?:e[-+]?\d+)?")


def text_of(path):
    """The text of a log so far; empty if there is none."""
    try:
        with open(path, errors="replace") as file:
            return file.read()
    except OSError:
        return ""


def warnings_of(case):
    """{text without numbers: the first line}. A run that went on says the same again, perhaps of another time."""
    found = {}
    for line in re.findall("^WARNING: (.*)", text_of(case.log), re.M):
        found.setdefault(NUMBER.sub("#", line), line.strip())
    return found


def told(cases, known=None):
    """The warnings of all runs, for reading: the numbers are those of the first run with it. `known`: tells lines that
    the tool itself causes."""
    found = {}
    for case in cases:
        for text, line in warnings_of(case).items():
            found.setdefault(text, []).append((os.path.basename(case.folder), line))
    return "".join(f"WARNING in {len(runs)} of {len(cases)} runs, here {runs[0][0]}: {runs[0][1]}\n"
                   for runs in found.values() if not (known and known(runs[0][1])))
