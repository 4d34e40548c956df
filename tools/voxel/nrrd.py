"""Reads NRRD (teem.sourceforge.net/nrrd/format.html): an array (z, y, x) and the spacing (x, y, z) of the file. VTK's
reader interprets compressed numbers and text as this machine's, whatever the header says, and thin images as colors."""
import bz2
import gzip
import math
import os
import re
import zlib

import numpy as np

import orientation
from strut_tools import fail

TYPES = {"signed char": "i1", "int8": "i1", "uchar": "u1", "unsigned char": "u1", "uint8": "u1",
         "short": "i2", "signed short": "i2", "int16": "i2", "ushort": "u2", "unsigned short": "u2", "uint16": "u2",
         "int": "i4", "signed int": "i4", "int32": "i4", "uint": "u4", "unsigned int": "u4", "uint32": "u4",
         "longlong": "i8", "long long": "i8", "int64": "i8", "ulonglong": "u8", "unsigned long long": "u8", "uint64": "u8",
         "float": "f4", "double": "f8"}
TYPES.update({f"{name}_t": code for name, code in TYPES.items() if re.fullmatch(r"u?int\d+", name)})
OBLIQUE = 1e-3  # cosine of the angle between two axes; headers have four digits or more


def read(path):
    with open(path, "rb") as file:
        if not file.readline(100).startswith(b"NRRD000"):
            fail(f"{path} cannot be read as .nrrd image: it does not begin with NRRD")
        fields, files = header_of(path, file)
        rest = file.read()
    if not files and path.lower().endswith(".nhdr"):
        fail(f"{path}: a header alone, expected a field 'data file'")
    sizes = sizes_of(path, fields)
    parts = [unpacked(name, fields, content_of(path, name), sizes) for name in files] or [unpacked(path, fields, rest, sizes)]
    directions = directions_of(path, fields, sizes)
    across = axes_of(fields, sizes, directions)
    axes = directions and [d for d in directions if d is not None]
    return orientation.oriented(path, joined(path, sizes, across, parts), spacing_of(path, fields, axes, across), axes)


def header_of(path, file):
    """The fields, and the files with the numbers: none if they follow the header."""
    fields, files, ended = {}, [], False
    while raw := file.readline(10000):
        line = raw.decode("latin-1").strip()
        if not line:
            ended = True
            break
        if ": " in line and not line.startswith("#"):
            key, value = line.split(": ", 1)
            key = key.lower()  # the format takes either case
            key = {"datafile": "data file", "byteskip": "byte skip", "lineskip": "line skip"}.get(key, key)
            if fields.setdefault(key, value.strip()) != value.strip():
                fail(f"{path}: '{key}' is said twice: {fields[key]}, and {value.strip()}")
        elif fields.get("data file", "").startswith("LIST"):
            files.append(line)
    if not ended and "data file" not in fields:
        fail(f"{path} is damaged: its header does not end with an empty line")
    for key in ("type", "dimension", "sizes", "encoding"):
        if key not in fields:
            fail(f"{path} cannot be read as .nrrd image, or is damaged: its header has no '{key}'")
    named = fields.get("data file")
    if named and not named.startswith("LIST"):
        files = numbered(named)
    return fields, files


def numbered(name):
    """'part%02d.raw 1 20 1' means twenty files."""
    found = re.fullmatch(r"(.*%\d*d.*?) (-?\d+) (-?\d+) (-?\d+)(?: \d+)?", name)
    if not found or int(found[4]) == 0:
        return [name]
    first, last, step = (int(found[n]) for n in (2, 3, 4))
    return [found[1] % n for n in range(first, last + (1 if step > 0 else -1), step)]


def content_of(path, name):
    data = os.path.join(os.path.dirname(path), name)
    if not os.path.isfile(data):
        fail(f"{path}: its data file {data} does not exist")
    with open(data, "rb") as file:
        return file.read()


def unpacked(path, fields, content, sizes):
    """The numbers of one file."""
    code = TYPES.get(fields["type"].lower())
    if code is None:
        fail(f"{path}: its type '{fields['type']}' is none of numbers that are known: {', '.join(TYPES)}")
    for _ in range(whole(path, fields, "line skip")):
        content = content[content.find(b"\n") + 1:]
    encoding = fields["encoding"].lower()
    try:
        if encoding in ("ascii", "text", "txt"):
            return written_out(content, code, fields["type"])
        if encoding in ("gzip", "gz"):
            content = gzip.decompress(content)
        elif encoding in ("bzip2", "bz2"):
            content = bz2.decompress(content)
        elif encoding == "hex":
            content = bytes.fromhex(content.decode("latin-1"))
        elif encoding != "raw":
            fail(f"{path}: its encoding '{fields['encoding']}' is not known; expected raw, gzip, bzip2, ascii or hex")
    except (OSError, EOFError, ValueError, OverflowError, zlib.error) as error:
        fail(f"{path} is damaged: {error}")
    kind = np.dtype(order_of(path, fields, code) + code)
    skip = whole(path, fields, "byte skip")
    content = content[-math.prod(sizes) * kind.itemsize if skip == -1 else skip:]
    if len(content) % kind.itemsize:
        fail(f"{path} is damaged: {len(content)} bytes are no whole number of numbers of {kind.itemsize} bytes")
    return np.frombuffer(content, kind).astype(code)


def whole(path, fields, key):
    try:
        return int(fields.get(key, 0))
    except ValueError:
        fail(f"{path}: '{key}' is '{fields[key]}', expected a whole number")


def order_of(path, fields, code):
    if code[1] == "1":
        return "="
    order = fields.get("endian", "").lower()
    if order not in ("little", "big"):
        fail(f"{path}: its header says '{order}' of the order of bytes (endian), expected little or big")
    return "<" if order == "little" else ">"


def written_out(text, code, name):
    numbers = np.array(text.split(), "i8" if code[0] in "iu" else code)
    beyond = numbers[numbers.astype(code) != numbers]
    if code[0] in "iu" and len(beyond):
        raise OverflowError(f"{beyond[0]} is no number of type {name}")
    return numbers.astype(code)


def numbers_in(text, kind):
    """None of them where a word is no number."""
    try:
        return [kind(word) for word in text.split()]
    except ValueError:
        return []


def sizes_of(path, fields):
    sizes = numbers_in(fields["sizes"], int)
    if len(sizes) != whole(path, fields, "dimension") or not sizes or min(sizes) < 1:
        fail(f"{path} is damaged: dimension {fields['dimension']} and sizes {fields['sizes']}")
    return sizes


def joined(path, sizes, across, parts):
    values = np.concatenate(parts)
    if len(values) != math.prod(sizes):
        fail(f"{path} is damaged: it has {len(values)} numbers, expected {' x '.join(map(str, sizes))}")
    numbers = math.prod(n for n, a in zip(sizes, across) if not a)
    if numbers != 1:
        fail(f"{path} has {numbers} numbers a voxel (colors?), expected one")
    kept = [n for n, a in zip(sizes, across) if a]
    if not 2 <= len(kept) <= 3:
        fail(f"{path} has {len(kept)} axes, expected three")
    return values.reshape((kept + [1])[:3][::-1])


def axes_of(fields, sizes, directions):
    """True for each spatial axis."""
    if directions is not None:
        return [d is not None for d in directions]
    kinds = fields.get("kinds", "").lower().split()
    if len(kinds) == len(sizes):
        return [k in ("domain", "space", "???", "none", "unknown") for k in kinds]
    return [True] * len(sizes) if len(sizes) <= 3 else [False] * (len(sizes) - 3) + [True] * 3


def directions_of(path, fields, sizes):
    """A vector for each spatial axis, None for others; None without the field."""
    text = fields.get("space directions")
    if text is None:
        return None
    try:
        found = [None if word == "none" else np.array([float(x) for x in word[1:-1].split(",")])
                 for word in re.findall(r"none|\([^)]*\)", text)]
    except ValueError:
        found = []
    if len(found) != len(sizes) or len({len(d) for d in found if d is not None}) != 1:
        fail(f"{path}: space directions '{text}', expected a vector or 'none' for each axis")
    return found


def spacing_of(path, fields, axes, across):
    """None if the file has no spacing."""
    if axes is None:
        if not fields.get("spacings"):
            return None
        numbers = numbers_in(fields["spacings"], float)
        if len(numbers) != len(across):
            fail(f"{path}: spacings '{fields['spacings']}', expected a number for each axis")
        found = [abs(n) for n, a in zip(numbers, across) if a]
    else:
        found = [float(np.linalg.norm(d)) for d in axes]
        oblique = np.abs(np.inner(axes, axes)) > OBLIQUE * np.outer(found, found)
        if np.triu(oblique, 1).any():
            fail(f"{path}: its axes are not at right angles ('space directions'), expected voxels that are boxes: "
                 "resample it")
    return tuple((found + found[-1:])[:3])
