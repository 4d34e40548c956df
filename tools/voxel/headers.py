"""Unit of lengths and order of bytes by headers of NRRD and MetaImage; numbers that were read in the wrong order."""
import re

import numpy as np
from strut_tools import fail, nearest

UNITS = {"m": 1.0, "meter": 1.0, "cm": 1e-2, "mm": 1e-3, "millimeter": 1e-3, "um": 1e-6, "micron": 1e-6,
         "micrometer": 1e-6, "nm": 1e-9, "nanometer": 1e-9, "in": 25.4e-3, "inch": 25.4e-3}
NRRD, META_IMAGE = (".nrrd", ".nhdr"), (".mhd", ".mha")
ORDERS = ("binarydatabyteordermsb", "elementbyteordermsb")
ROUGHER = 2      # Neighboring voxels are similar; in swapped bytes the lowest comes first, which is noise.
SAMPLE = 10**6   # numbers


def head_of(path):
    with open(path, "rb") as file:
        return file.read(20000).decode("latin-1").split("ElementDataFile")[0]


def factor_of(word, where):
    known = re.sub(r"[^\x00-\x7f]+", "u", word.strip().lower())  # the micro sign, in any encoding
    for name in (known, known.rstrip("s")):
        if name in UNITS:
            return UNITS[name]
    fail(f"{where}: '{word}' is not a unit of length that is known{nearest(known, list(UNITS))}; there are {', '.join(UNITS)}")


def unit_of(path, ending):
    """The unit of length of the file in m; None if it has none."""
    if ending in NRRD:
        found = re.search(r"^(?:space units|units):(.*)$", re.split(r"\r?\n\r?\n", head_of(path))[0], re.M | re.I)
    else:
        found = re.search(r"^DistanceUnits\s*=(.*)$", head_of(path), re.M) if ending in META_IMAGE else None
    if not found:
        return None
    words = [w for w in (re.findall(r'"([^"]*)"', found[1]) or found[1].split()) if w.strip() not in ("", "?")]
    factors = {factor_of(word, path) for word in words}
    if len(factors) > 1:
        fail(f"{path} has axes of different units: {', '.join(words)}; expected one")
    return factors.pop() if factors else None


def roughness(values):
    """The mean difference of neighbors over the scatter of all; inf if a value is not finite."""
    with np.errstate(all="ignore"):
        values = values.astype(float)
        if not np.isfinite(values).all():
            return np.inf
        scatter = values.std()
        found = np.abs(np.diff(values)).mean() / scatter if scatter > 0 else 0
    return found if np.isfinite(found) else np.inf


def sounds_swapped(values):
    """True if much rougher than in the other byte order, or if all are integers below 256 in that order."""
    if values.dtype.itemsize == 1 or values.dtype == bool or values.size < 2:
        return False
    flat = values.reshape(-1)
    start = max(0, (flat.size - SAMPLE) // 2)  # from the middle of the body
    part = flat[start:start + SAMPLE]
    other = part.byteswap()
    if part.dtype.kind in "iu" and part.any() and 0 <= other.min() and other.max() < 256:
        return True
    return roughness(part) > ROUGHER * roughness(other)


def check_meta_image(path, values):
    head = head_of(path).lower()
    if not any(word in head for word in ORDERS) and sounds_swapped(values):
        fail(f"{path} says nothing of the order of its bytes, and reads like an image in the other one: expected a line "
             "BinaryDataByteOrderMSB = True (or False, where it is so)")
