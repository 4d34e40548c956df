"""Reads files of voxels: an array (z, y, x) and the spacing (x, y, z). Libraries (tifffile, VTK) read all formats
except NRRD and Scanco's."""
import glob
import os
import re
from dataclasses import dataclass

import numpy as np

import headers
import nrrd
import orientation
import points
import scanco
from strut_tools import captured, check_input, fail, nearest

VTK_READERS = {".mhd": ("vtkIOImage", "vtkMetaImageReader"), ".mha": ("vtkIOImage", "vtkMetaImageReader"),
               ".vti": ("vtkIOXML", "vtkXMLImageDataReader"), ".vtk": ("vtkIOLegacy", "vtkStructuredPointsReader")}
TIFF = (".tif", ".tiff")
TEXT = (".pts", ".txt", ".xyz", ".dat")
SCANCO = (".aim", ".isq")
RAW_TYPES = {"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4", "float32": "f4",
             "float64": "f8"}
BYTE_ORDERS = {"little": "<", "big": ">"}


@dataclass
class Raw:
    """A file of plain numbers: x varies fastest."""
    shape: list             # voxels along x, y, z
    type: str               # of RAW_TYPES
    order: str | None = "little"  # of bytes; None: unspecified, little unless the data contradict it
    header: int = 0         # bytes before the numbers


@dataclass
class Image:
    values: np.ndarray      # (z, y, x); bool if the file says which voxels are solid
    spacing: tuple | None   # (x, y, z), as in the file
    kind: str


def files_of(path):
    """The files that read() reads, or may read."""
    if re.search(r"[*?\[]", path) and not os.path.exists(path):
        return glob.glob(path)
    if os.path.isdir(path):
        return [os.path.join(path, name) for name in os.listdir(path)]
    if ending_of(path) not in (".mhd", ".nhdr", ".mha", ".nrrd") or not os.path.isfile(path):
        return [path]
    with open(path, "rb") as file:  # a header names its data: one file per line, or a pattern with %03d
        lines = file.read(2**20).decode("latin-1").splitlines()
    named = [re.split(r"[:=]\s*", line, maxsplit=1)[-1].strip() for line in lines[:10000]]
    patterns = [re.sub(r"%\d*d", "*", glob.escape(name.split(" ")[0] if "%" in name else name)) for name in named if name]
    folder = glob.escape(os.path.dirname(path))
    return [path, *(file for pattern in patterns for file in glob.glob(os.path.join(folder, pattern)) if "\0" not in pattern)]


def read(path, raw=None, array=None, unit=None):
    """raw: format of plain numbers; unit: of the file's lengths, instead of the one in the file, as a word."""
    if re.search(r"[*?\[]", path) and not os.path.exists(path):
        return slices(sorted_naturally(glob.glob(path)), path)
    check_input(path)
    ending = ending_of(path)
    if os.path.isdir(path):
        names = [os.path.join(path, name) for name in os.listdir(path) if ending_of(name) in TIFF]
        return slices(sorted_naturally(names), path)
    if os.path.getsize(path) == 0:
        fail(f"{path} is empty")
    if raw:
        return bare(path, raw)
    if ending in SCANCO or re.search(r"\.aim(;\d+)?$", path.lower()):  # VMS numbers versions of files: a.aim;2
        values, spacing = scanco.read(path)
        return Image(values, spacing, "Scanco's")
    if ending in TIFF:
        return Image(*tiff(path))
    if ending in headers.NRRD:
        return checked(path, *nrrd.read(path), ending, unit)
    if ending in VTK_READERS:
        values, image = by_vtk(path, *VTK_READERS[ending], array)
        directions = np.reshape(image.GetDirectionMatrix().GetData(), (3, 3)).T
        if ending in headers.META_IMAGE:
            headers.check_meta_image(path, values)
            directions = orientation.of_meta_image(path, headers.head_of(path))
        return checked(path, *orientation.oriented(path, values, image.GetSpacing(), directions), ending, unit)
    if ending == ".npy":
        return Image(numpy_array(path).transpose(), None, "NumPy's array [x, y, z]")
    if ending in TEXT:
        solid, spacing = points.lattice(path)
        return Image(solid, spacing, "list of points")
    known = [*headers.NRRD, *VTK_READERS, *TIFF, *SCANCO, ".npy", ".stl", *TEXT]
    fail(f"{path}: '{ending}' is not a format that is known{nearest(ending, known)}; there are {' '.join(known)} "
         "(lists of points also .gz), and any file with --shape and --type")


def ending_of(path):
    """.pts of a.pts.gz"""
    stem, ending = os.path.splitext(path.lower())
    return os.path.splitext(stem)[1] if ending == ".gz" else ending


def numpy_array(path):
    """Indices are [x, y, z], as in the module for Python."""
    try:
        values = np.load(path, allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        fail(f"{path} cannot be read as NumPy's: {error}")
    if getattr(values, "ndim", 0) != 3 or 0 in values.shape:
        fail(f"{path} is an array of the shape {getattr(values, 'shape', ())}; expected three axes: x, y, z")
    return values.astype(np.uint8) if values.dtype == bool else values


def parts_of(names):
    """Texts and numbers of each name, by turns. A sign counts where some have another one: s-1, s0, s+1."""
    found = [re.split(r"([+-]?\d+)", name) for name in names]
    is_signed = [n % 2 == 1 and len({part[0] if part[0] in "+-" else "" for part in parts}) > 1 for n, parts in enumerate(zip(*found))]

    def number(n, word):
        return int(word) if n < len(is_signed) and is_signed[n] else abs(int(word))
    return [[number(n, part) if n % 2 else part for n, part in enumerate(parts)] for parts in found]


def sorted_naturally(names):
    """slice2 before slice10"""
    return [name for _, name in sorted(zip(parts_of(names), names))]


def bare(path, raw):
    order = raw.order or "little"
    kind = np.dtype(BYTE_ORDERS[order] + RAW_TYPES[raw.type])
    size = raw.header + int(np.prod(raw.shape)) * kind.itemsize
    found = os.path.getsize(path)
    if found != size:
        after = f" after {raw.header} bytes" if raw.header else ""
        more = "" if found < size else f"; is there a header? --header {found - size + raw.header}"
        fail(f"{path} has {found} bytes, expected {size}: {' x '.join(map(str, raw.shape))} numbers of type {raw.type}{after}{more}")
    values = np.fromfile(path, kind, offset=raw.header).reshape(raw.shape[::-1])
    values = values.astype(kind.newbyteorder("="), copy=False)
    if raw.order is None and headers.sounds_swapped(values):
        fail(f"{path} reads like an image in the other order of bytes: expected --byte-order big, or little where it is so")
    return Image(values, None, f"raw {raw.type}, {order}-endian")


# TIFF: a page is a layer in z, a row runs along x, rows follow each other in y


def tiff(path):
    """The array, no spacing and the kind."""
    import tifffile

    wrong, white_is_zero = None, False
    with captured() as said:
        try:
            with tifffile.TiffFile(path) as file:
                color = any(page.samplesperpixel > 1 for page in file.pages)
                white_is_zero = file.pages[0].photometric == tifffile.PHOTOMETRIC.MINISWHITE
                values = None if color or len(file.series) != 1 else file.asarray()
                series = len(file.series)
        except Exception as error:  # damaged files raise any exception of the parser
            wrong = error
    if said.error():  # the rest of a truncated file may still consist of equal pages
        fail(f"{path} is damaged: {said.error()}")
    if wrong is not None and "imagecodecs" in str(wrong):  # a compression that needs a library missing in Debian
        return by_vtk(path, "vtkIOImage", "vtkTIFFReader", None)[0], None, "TIFF"  # rows in the order of tifffile
    if wrong is not None or (values is None and series == 0):
        told = str(wrong or said.text).strip().splitlines() or [type(wrong).__name__ if wrong else "it has no pages"]
        fail(f"{path} is not a TIFF image, or is damaged: {told[0]}")
    if color:
        fail(f"{path} has several numbers a voxel (colors?), expected one")
    if values is None or (values.ndim not in (2, 3)):
        fail(f"{path} holds images of different sizes or of more than three dimensions, expected pages of one size")
    values = values.reshape((-1, *values.shape[-2:]))
    return (darkened(path, values), None, "TIFF, of which 0 is white") if white_is_zero else (values, None, "TIFF")


def darkened(path, values):
    """The same picture with 0 as black (TIFF 6.0, PhotometricInterpretation 0)."""
    if values.dtype == bool:
        return ~values
    if values.dtype.kind != "u":
        fail(f"{path} says that 0 is white (PhotometricInterpretation 0), of numbers of the type {values.dtype}: expected 0 as black")
    return np.iinfo(values.dtype).max - values


def slices(names, where):
    if not names:
        fail(f"{where}: no TIFF images there (.tif, .tiff)")
    if any(os.path.isdir(name) or os.path.getsize(name) == 0 for name in names):
        fail(f"{next(n for n in names if os.path.isdir(n) or os.path.getsize(n) == 0)} is empty or a folder")
    if len(names) == 1:
        return Image(*tiff(names[0]))
    other = [name for name in names if not re.search(r"\d", os.path.basename(name))]
    if other and len(other) < len(names):
        fail(f"{other[0]} has no number in its name, as other slices have: expected slices alone, or a pattern that leaves it out")
    values, kind = None, "TIFF"
    for z, name in enumerate(names):
        if ending_of(name) not in TIFF:
            fail(f"{name}: a list of slices holds TIFF images only (.tif, .tiff)")
        page, _, kind = tiff(name)
        values = np.empty((len(names), *page.shape[1:]), page.dtype) if values is None else values
        if page.shape != (1, *values.shape[1:]) or page.dtype != values.dtype:
            fail(f"{name} has {' x '.join(map(str, page.shape[::-1]))} voxels of {page.dtype}, expected "
                 f"{values.shape[2]} x {values.shape[1]} x 1 of {values.dtype} as in {names[0]}")
        values[z] = page[0]
    return Image(values, None, f"{len(names)} slices, {kind}{gap_in(names)}")


def gap_in(names):
    """Words on the first place where the numbers in the names of slices, which rise or fall by equal steps, leave some out:
    the body is shorter by those."""
    numbers = [parts[1::2] for parts in parts_of([os.path.basename(name) for name in names])]
    if len({len(found) for found in numbers}) > 1:
        return ""
    steps = [tuple(b - a for a, b in zip(one, other)) for one, other in zip(numbers, numbers[1:])]
    usual = max(steps, key=steps.count)
    if sum(n != 0 for n in usual) != 1:
        return ""
    (at, step), = ((i, n) for i, n in enumerate(usual) if n)
    for i, found in enumerate(steps):
        if found[at] / step > 1 and not any(found[:at] + found[at + 1:]):
            return (f" (WARNING: none is numbered from {numbers[i][at] + step} to {numbers[i + 1][at] - step}, between "
                    f"{os.path.basename(names[i])} and {os.path.basename(names[i + 1])}: they are taken as neighbors)")
    return ""


# MetaImage and VTK's own


def by_vtk(path, module, name, array):
    """The array and the image that it came from."""
    import importlib

    if ending_of(path) == ".vti":  # VTK's reader of XML accepts truncated ones
        with open(path, "rb") as file:
            file.seek(max(0, os.path.getsize(path) - 64))
            if b"</VTKFile>" not in file.read():
                fail(f"{path} is damaged: it does not end with </VTKFile>")
    reader = getattr(importlib.import_module("vtkmodules." + module), name)()
    with captured() as said:
        reader.SetFileName(path)
        readable = not hasattr(reader, "CanReadFile") or reader.CanReadFile(path)
        if readable:
            reader.Update()
        image = reader.GetOutput()
    if not readable or said.error() or image is None or 0 in image.GetDimensions():
        fail(f"{path} cannot be read as {os.path.splitext(path)[1]} image, or is damaged"
             f"{': ' + said.error() if said.error() else ''}")
    return array_of(path, image, array), image


def array_of(path, image, name):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    both = in_points, in_cells = image.GetPointData(), image.GetCellData()
    held = [(data, data.GetArrayName(i)) for data in both for i in range(data.GetNumberOfArrays())]
    names = [held_name for _, held_name in held]
    if not names:
        fail(f"{path} has no numbers")
    if name is not None and name not in names:
        fail(f"{path} has no array '{name}'{nearest(name, names)}; it has {', '.join(map(str, names))}")
    chosen = [data for data in both if data.GetScalars()]  # by the file
    if name is None and len(names) > 1 and len(chosen) != 1:
        fail(f"{path} has several arrays: name one with --array; there are {', '.join(map(str, names))}")
    data = next(data for data, held_name in held if held_name == name) if name else (chosen or [held[0][0]])[0]
    found = data.GetArray(name) if name else data.GetScalars() or data.GetArray(0)
    if found is None:
        fail(f"{path}: the array is not one of numbers")
    if found.GetNumberOfComponents() != 1:
        fail(f"{path} has {found.GetNumberOfComponents()} numbers a voxel (colors?), expected one")
    # Voxels are the points of VTK's image, or its cells: one less along each axis.
    shape = [max(1, n - (data is in_cells)) for n in image.GetDimensions()]
    if found.GetNumberOfTuples() != np.prod(shape):
        fail(f"{path} has {found.GetNumberOfTuples()} numbers, expected {' x '.join(map(str, shape))}")
    return vtk_to_numpy(found).reshape(shape[::-1])


def checked(path, values, spacing, ending, unit):
    factor = headers.factor_of(unit, "--units") if unit else headers.unit_of(path, ending)
    kind = ending[1:].upper() + (f", lengths of {factor:g} m" if factor else "")
    # VTK returns 1 if the file has no spacing; a voxel of 1 m is implausible.
    if spacing is None or tuple(abs(s) * (factor or 1) for s in spacing) == (1, 1, 1):
        return Image(values, None, kind)
    spacing = tuple(abs(s) * (factor or 1) for s in spacing)
    if not all(0 < s < np.inf for s in spacing):
        fail(f"{path}: spacing {spacing}, expected three numbers > 0")
    return Image(values, spacing, kind)
