"""The unit of lengths in the headers of NRRD and MetaImage."""
import re

from strut_tools import fail, nearest

UNITS = {"m": 1.0, "meter": 1.0, "cm": 1e-2, "mm": 1e-3, "millimeter": 1e-3, "um": 1e-6, "micron": 1e-6,
         "micrometer": 1e-6, "nm": 1e-9, "nanometer": 1e-9, "in": 25.4e-3, "inch": 25.4e-3}
FIELDS = {".nrrd": r"^(?:space units|units):(.*)$", ".nhdr": r"^(?:space units|units):(.*)$",
          ".mhd": r"^DistanceUnits\s*=(.*)$", ".mha": r"^DistanceUnits\s*=(.*)$"}


def factor_of(word, where):
    known = re.sub(r"[^\x00-\x7f]+", "u", word.strip().lower())  # the micro sign, in any encoding
    for name in (known, known.rstrip("s")):
        if name in UNITS:
            return UNITS[name]
    fail(f"{where}: '{word}' is not a unit of length that is known{nearest(known, list(UNITS))}; there are {', '.join(UNITS)}")


def of_file(path, ending):
    """The unit of length of the file in m; None if it has none."""
    if ending not in FIELDS:
        return None
    with open(path, "rb") as file:
        header = file.read(20000).decode("latin-1")
    if ending in (".nrrd", ".nhdr"):
        header = re.split(r"\r?\n\r?\n", header)[0]
    header = header.split("ElementDataFile")[0]
    found = re.search(FIELDS[ending], header, re.M)
    if not found:
        return None
    words = [w for w in (re.findall(r'"([^"]*)"', found[1]) or found[1].split()) if w.strip() not in ("", "?")]
    factors = {factor_of(word, path) for word in words}
    if len(factors) > 1:
        fail(f"{path} has axes of different units: {', '.join(words)}; expected one")
    return factors.pop() if factors else None
