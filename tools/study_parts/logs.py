"""The warnings in the logs of runs: each is told once, with the number of runs that it stands in."""
import os
import re

NUMBER = re.compile(r"(?<![\w.])[-+]?\d[\d.,]*(?:e[-+]?\d+)?")


def warnings_of(case):
    """{text without numbers: the first line}. A run that went on says the same again, perhaps of another time."""
    if not os.path.isfile(case.log):
        return {}
    found = {}
    with open(case.log, errors="replace") as file:
        for line in file:
            if line.startswith("WARNING: "):
                found.setdefault(NUMBER.sub("#", line), line.strip().removeprefix("WARNING: "))
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
