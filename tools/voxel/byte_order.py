"""Detects numbers that were read in the wrong byte order when the file does not specify it."""
import numpy as np

from strut_tools import fail

META_IMAGE = (".mhd", ".mha")
SAYS = ("binarydatabyteordermsb", "elementbyteordermsb")
ROUGHER = 2      # Neighboring voxels are similar; in swapped bytes the lowest comes first, which is noise.
SAMPLE = 10**6   # numbers


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
    """True if much rougher than in the other order; or for one-byte integers that are all in the upper byte."""
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
    with open(path, "rb") as file:
        head = file.read(20000).decode("latin-1").split("ElementDataFile")[0].lower()
    if not any(word in head for word in SAYS) and sounds_swapped(values):
        fail(f"{path} says nothing of the order of its bytes, and reads like an image in the other one: expected a line "
             "BinaryDataByteOrderMSB = True (or False, where it is so)")
