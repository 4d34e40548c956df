"""Images of Scanco's micro-CT: AIM (versions 020 and 030) and ISQ. Little-endian, lengths in mm, floats as VAX has them.

No specification is public; the layout is what ITK's reader (ITKIOScanco, D. Gobbi 2015) makes of files, told here by places:
AIM 020 begins with five int32 (size of this list 20, of the header 140, of the log, …), 030 with its name and five int64;
in the header from byte 20 on the type (int32), 21 whole numbers of that size (3 to 5 are the voxels), and 3 floats: the edges
of a voxel. Voxels follow the log. ISQ: 512 bytes, at 44 voxels and the box in micrometers, at 508 the block before the voxels.
"""
import struct

import numpy as np

from strut_tools import fail

NEW = b"AIMDATA_V030   \0"
ISQ = b"CTDATA-HEADER_V1"
PLAIN = {0x00160001: "<u1", 0x000d0001: "<u1", 0x00010001: "<i1", 0x00170002: "<u2", 0x00020002: "<i2",
         0x00030004: "<i4", 0x001a0004: "<f4"}
BITS, RUNS_OF_BITS, RUNS_OF_BYTES = 0x00060001, 0x00150001, 0x00080002
MOST_VOXELS = 2**40


def read(path):
    """The values (z, y, x) and the edges of a voxel (x, y, z), m."""
    with open(path, "rb") as file:
        data = file.read()
    return isq(path, data) if data.startswith(ISQ) else aim(path, data)


def vax_floats(data):
    """F_floating: its halves are exchanged and its exponent is larger by two."""
    words = np.frombuffer(data, "<u2").astype(np.uint32)
    with np.errstate(invalid="ignore"):  # for damaged files
        return ((words[0::2] << 16) | words[1::2]).astype(np.uint32).view(np.float32) * 0.25


def checked(path, shape, edges):
    if any(n < 1 for n in shape) or np.prod(shape, dtype=float) > MOST_VOXELS or not all(0 < e < 1 for e in edges):
        fail(f"{path} is damaged: {shape[2]} x {shape[1]} x {shape[0]} voxels of {' x '.join(f'{e:.4g}' for e in edges)} m")


def aim(path, data):
    new = data.startswith(NEW)
    start, whole = (len(NEW), struct.Struct("<q")) if new else (0, struct.Struct("<i"))
    if len(data) < start + 5 * whole.size or (not new and struct.unpack_from("<2i", data) != (20, 140)):
        fail(f"{path} is not an AIM image of Scanco (version 020 or 030), or is damaged")
    lengths = struct.unpack_from("<3" + whole.format[1], data, start)
    header = start + lengths[0]
    if min(lengths) < 0 or len(data) < header + 36 + 21 * whole.size:
        fail(f"{path} is damaged: it ends in its header")
    kind, *numbers = struct.unpack_from("<i21" + whole.format[1], data, header + 20)
    shape = tuple(numbers[5:2:-1])
    edges = tuple(float(1e-3 * (e or 1)) for e in vax_floats(data[header + 24 + 21 * whole.size:][:12]))
    checked(path, shape, edges)
    return values_of(path, data[start + sum(lengths):], kind, shape, whole), edges


def values_of(path, data, kind, shape, whole):
    count = int(np.prod(shape))
    if kind in PLAIN:
        dtype = np.dtype(PLAIN[kind])
        if len(data) < count * dtype.itemsize:
            cut_off(path, len(data), count * dtype.itemsize)
        return np.frombuffer(data, dtype, count).reshape(shape)
    if kind == BITS:
        return bits(path, data, shape)
    if kind not in (RUNS_OF_BITS, RUNS_OF_BYTES):
        fail(f"{path} holds numbers of Scanco's type {kind:#010x}, which is not known")
    packed, = whole.unpack(data[:whole.size].ljust(whole.size, b"\0"))
    if not 0 <= packed <= len(data):
        cut_off(path, len(data), packed)
    runs = np.frombuffer(data[whole.size:packed], np.uint8)
    # Bytes come as pairs of run length and value.
    found = runs_of_bits(runs) if kind == RUNS_OF_BITS else np.repeat(runs[1::2], runs[0:2 * (len(runs) // 2):2])
    if len(found) < count:
        cut_off(path, len(found), count)
    return found[:count].view(np.int8).reshape(shape)


def cut_off(path, found, expected):
    fail(f"{path} is damaged: {found} bytes of voxels, expected {expected}")


def bits(path, data, shape):
    """A byte holds 2 x 2 x 2 voxels, the lowest bit first, x fastest; the last byte is the value of a 1."""
    halves = [(n + 1) // 2 for n in shape]
    count = int(np.prod(halves))
    if len(data) < count + 1:
        cut_off(path, len(data), count + 1)
    cells = np.frombuffer(data, np.uint8, count).reshape(halves)
    out = np.zeros([2 * n for n in halves], np.int8)
    for z, y, x in np.ndindex(2, 2, 2):
        out[z::2, y::2, x::2] = (cells >> (x + 2 * y + 4 * z) & 1) * np.uint8(data[count] or 0x7f)
    return out[tuple(slice(n) for n in shape)]


def runs_of_bits(data):
    """Two values, then the lengths of alternating runs; 255: 254 times, and the same value continues."""
    lengths = data[2:]
    turns = np.concatenate([[0], np.cumsum(lengths != 255)])[:len(lengths)] % 2
    return np.repeat(data[:2][turns], np.where(lengths == 255, 254, lengths))


def isq(path, data):
    if len(data) < 512:
        fail(f"{path} is damaged: it ends in its header")
    numbers, (before,) = struct.unpack_from("<6i", data, 44), struct.unpack_from("<i", data, 508)
    shape, start = numbers[2::-1], 512 * (1 + before)
    edges = tuple(1e-6 * box / max(n, 1) for box, n in zip(numbers[3:], numbers))
    checked(path, shape, edges)
    count = int(np.prod(shape))
    if start < 512 or len(data) < start + 2 * count:
        cut_off(path, max(0, len(data) - start), 2 * count)
    return np.frombuffer(data, "<i2", count, start).reshape(shape), edges
