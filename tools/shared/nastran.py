"""Refuses what meshio reads otherwise than Nastran does, without a word: it takes the coordinates of each GRID for basic ones, and
passes over INCLUDE."""


def check(path, end):
    """Ends the program if the nodes would be elsewhere, or in another file."""
    with open(path, errors="replace") as file:
        for number, line in enumerate(file, 1):
            if problem := problem_of(line):
                end(f"{path}, line {number}: {problem}")


def problem_of(line):
    word = (line.split(",")[0][:8].split() or [""])[0].upper()
    if word == "INCLUDE":
        return "INCLUDE, which meshio does not read; expected all in one file"
    if word.rstrip("*") not in ("GRID", "GRDSET"):
        return None
    wide = 16 if word.endswith("*") else 8
    system = (line.split(",")[2:3] or [""])[0] if "," in line else line.expandtabs(8)[8 + wide:8 + 2 * wide]
    if system.strip() not in ("", "0"):
        return f"{word} in the coordinate system {system.strip()}, which meshio does not read; expected the basic one (CP blank or 0)"
    return None
