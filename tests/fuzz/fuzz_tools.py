#!/usr/bin/python3
"""Images, meshes and histories that are nearly right, to tools/voxels, tools/tetrahedra and strut-compare: each must be read
or refused with one line, within limits of time and memory.

    tests/fuzz/fuzz_tools.py [--seed N] [--first N] [--inputs N | --minutes M] [--keep FOLDER]

STRUT_MESH names strut-mesh. Exit status: 0 no failure, 1 failures, 77 the Debian packages of the tools are missing.
"""
import argparse
import contextlib
import gzip
import importlib.util
import os
import random
import resource
import runpy
import shutil
import signal
import sys
import tempfile
import time
import traceback

MODULES = ("numpy", "scipy", "tifffile", "vtkmodules", "meshio", "h5py", "netCDF4")
if any(importlib.util.find_spec(module) is None for module in MODULES):
    print("skipped: Debian packages are missing (tools/prepare installs them)")
    sys.exit(77)

# Imported once; each input gets a process of its own, a copy of this one.
import h5py  # noqa: E402, F401
import meshio  # noqa: E402
import numpy as np  # noqa: E402
import scipy.ndimage  # noqa: E402, F401
import tifffile  # noqa: E402
import vtkmodules.vtkIOImage  # noqa: E402, F401
import vtkmodules.vtkIOLegacy  # noqa: E402, F401
import vtkmodules.vtkIOXML  # noqa: E402, F401
from vtkmodules.util.numpy_support import numpy_to_vtk  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
REFUSED = "refused:"
SECONDS = 20  # of the processor, for one input
MEMORY = 2 << 30  # bytes, beyond what this process has
MOST_FAILURES = 20
WORDS = [b"", b"nan", b"inf", b"-1", b"0", b"1", b"1e400", b"99999999999999999999", b"2147483647", b"4294967296",
         b"1000000000", b"x", b"../../etc/passwd", b"/dev/zero", b"%s%n", b"a" * 5000, b"\xff\xfe", b"gzip", b"raw",
         b"double", b"uchar", b"\n", b"<", b">", b"\"", b"&lol;", b"<!DOCTYPE d [<!ENTITY lol SYSTEM 'file:///dev/zero'>]>"]
OTHER = {"strut-compare": "run.csv"}  # the second word, of tools that write no mesh
COUNTS = [0, 1, 7, 255, 65535, 10**9, 2**31 - 1, 2**31, 2**32 - 1]


# Samples


def image():
    solid = np.zeros((5, 6, 12), np.uint8)
    solid[1:4, 1:5, 1:11] = 200
    return solid


def noisy():
    """Two struts that cross, blurred, and the noise of a scan."""
    solid = np.zeros((16, 16, 16))
    solid[6:10, 6:10] = solid[:, 6:10, 5:9] = 8000
    grey = scipy.ndimage.gaussian_filter(solid, 0.7) + np.random.default_rng(1).normal(0, 2000, solid.shape)
    return grey.astype("<i2")


def vtk_image():
    values = image()
    data = vtkImageData()
    data.SetDimensions(*values.shape[::-1])
    data.SetSpacing(0.1, 0.1, 0.2)
    data.GetPointData().SetScalars(numpy_to_vtk(values.reshape(-1), deep=True))
    return data


def by_vtk(folder, module, name, file):
    writer = getattr(importlib.import_module("vtkmodules." + module), name)()
    writer.SetFileName(os.path.join(folder, file))
    writer.SetInputData(vtk_image())
    writer.Write()


def nrrd(encoding, pack):
    header = f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 12 6 5\nspacings: 0.1 0.1 0.2\nendian: little\nencoding: {encoding}\n\n"
    return header.encode() + pack(image().tobytes())


def scanco(kind, data):
    """AIM 020, without its log."""
    head = bytearray(140)
    head[20:24] = kind.to_bytes(4, "little")
    head[36:48] = np.array([12, 6, 5], "<i4").tobytes()
    head[108:120] = 3 * b"\x80\x40\x00\x00"  # 1 mm, as a VAX has it
    return np.array([20, 140, 0, len(data), 0], "<i4").tobytes() + bytes(head) + data


def tetrahedra():
    points = np.array([(i & 1, i >> 1 & 1, i >> 2 & 1) for i in range(8)], float)
    cells = [("tetra", np.array([(0, 1, 2, 4), (7, 6, 5, 3)])), ("triangle", np.array([(0, 1, 2)]))]
    groups = [np.array([1, 2]), np.array([3])]
    return meshio.Mesh(points, cells, cell_data={"gmsh:physical": groups, "gmsh:geometrical": groups})


ABAQUS = b"""*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 0., 1., 0.
4, 0., 0., 1.
*ELEMENT, TYPE=C3D4, ELSET=strut
1, 1, 2, 3, 4
*NSET, NSET=foot
1, 2, 3
"""


def samples(folder):
    """{file: (tool, words after the file)}; the files are written."""
    def put(name, data):
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)

    tifffile.imwrite(os.path.join(folder, "image.tif"), image(), photometric="minisblack")
    tifffile.imwrite(os.path.join(folder, "packed.tif"), image(), photometric="minisblack", compression="zlib")
    by_vtk(folder, "vtkIOXML", "vtkXMLImageDataWriter", "image.vti")
    by_vtk(folder, "vtkIOLegacy", "vtkStructuredPointsWriter", "image.vtk")
    by_vtk(folder, "vtkIOImage", "vtkMetaImageWriter", "image.mha")
    put("image.nrrd", nrrd("raw", bytes))
    put("packed.nrrd", nrrd("gzip", gzip.compress))
    put("image.raw", image().tobytes())
    put("image.aim", scanco(0x00160001, image().tobytes()))
    runs = b"".join(bytes([1, value]) for value in image().tobytes())
    put("packed.aim", scanco(0x00080002, (4 + len(runs)).to_bytes(4, "little") + runs))
    places = "\n".join(" ".join(f"{c / 10:g}" for c in place[::-1]) for place in np.argwhere(image()))
    put("list.pts", places.encode())
    put("list.pts.gz", gzip.compress(places.encode()))
    put("run.csv", b"Time,Step_Size,Kinetic_Energy\n0,1e-8,0.5\n1e-8,1e-8,0.25\n")
    size = ("--size", "1")
    found = {name: ("voxels", size) for name in ("image.tif", "packed.tif", "image.vti", "image.vtk", "image.mha",
                                                 "image.nrrd", "packed.nrrd", "list.pts", "list.pts.gz",
                                                 "image.aim", "packed.aim")}
    found["run.csv"] = ("strut-compare", ())
    found["image.raw"] = ("voxels", (*size, "--shape", "12", "6", "5", "--type", "uint8"))
    for name, words in (("noisy-spurs.raw", ("--cells", "2", "--spurs", "drop")), ("noisy-all.raw", ("--cells", "3", "--pieces", "0")),
                        ("noisy-one.raw", ("--cells", "1"))):
        put(name, noisy().tobytes())
        found[name] = ("voxels", (*size, "--shape", "16", "16", "16", "--type", "int16", "--grey", *words))
    for name, form, words in (("mesh.msh", "gmsh", {}), ("text.msh", "gmsh", {"binary": False}),
                              ("old.msh", "gmsh22", {"binary": False}), ("mesh.vtu", "vtu", {}), ("mesh.vtk", "vtk", {}),
                              ("mesh.mesh", "medit", {}), ("mesh.med", "med", {})):
        with contextlib.redirect_stdout(None), contextlib.suppress(Exception):  # not every version writes every one
            meshio.write(os.path.join(folder, name), tetrahedra(), form, **words)
            found[name] = ("tetrahedra", ())
    put("mesh.inp", ABAQUS)
    found["mesh.inp"] = ("tetrahedra", ())
    return found


# Damage


def damage_once(data, chance):
    at = chance.randrange(min(len(data), 2000) if chance.random() < 0.6 else len(data))
    length = 1 + chance.randrange(16 if chance.random() < 0.7 else 2000)
    kind = chance.randrange(8)
    if kind == 0:
        data[at] ^= 1 << chance.randrange(8)
    elif kind == 1:
        data[at] = chance.randrange(256)
    elif kind == 2:
        del data[chance.randrange(len(data)):]
    elif kind == 3:
        del data[at:at + length]
    elif kind == 4:
        data[at:at] = data[at:at + length]
    elif kind == 5:
        number = chance.choice(COUNTS).to_bytes(chance.choice((4, 8)), chance.choice(("little", "big")))
        data[at:at + len(number)] = number
    else:  # a word
        words = [i for i in range(len(data)) if bytes(data[i:i + 1]).isspace()] or [0]
        begin = chance.choice(words) + 1
        end = next((i for i in words if i > begin), len(data))
        data[begin:end] = chance.choice(WORDS)


def damaged(data, chance):
    data = bytearray(data)
    for _ in range(1 + chance.randrange(3)):
        if data:
            damage_once(data, chance)
    return bytes(data)


# One input


def limits():
    with open("/proc/self/statm") as file:
        taken = int(file.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (taken + MEMORY,) * 2)
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.signal(signal.SIGXCPU, signal.SIG_DFL)


def work(tool, words, said):
    """In a process of its own. 0: read, 1: refused with a line, 2: anything else."""
    os.dup2(said.fileno(), 1)
    os.dup2(said.fileno(), 2)
    limits()
    path = os.path.join(ROOT, "tools", tool)
    sys.argv = [path, *words]
    try:
        runpy.run_path(path, run_name="__main__")
        return 0
    except SystemExit as end:
        if end.code in (None, 0):
            return 0
        print(REFUSED, end.code, flush=True)  # the tool's own process has said a line, and ends this one with 1
        return 1 if end.code == 1 or end.code == 2 and tool in OTHER or str(end.code).startswith(f"tools/{tool}: ") else 2
    except BaseException:
        traceback.print_exc()
        return 2


def outcome(tool, words):
    """Status of the process and what it said."""
    with tempfile.TemporaryFile() as said:
        child = os.fork()
        if child == 0:
            status = 2
            try:
                status = work(tool, words, said)
            finally:
                sys.stdout.flush()
                os._exit(status)
        _, status = os.waitpid(child, 0)
        said.seek(0)
        text = said.read().decode(errors="replace")
        status = os.waitstatus_to_exitcode(status)
        return 2 if status == 1 and (REFUSED not in text or "Traceback" in text) else status, text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--inputs", type=int, default=200)
    parser.add_argument("--minutes", type=float)
    parser.add_argument("--keep", default="fuzz-failures")
    options = parser.parse_args()
    start, accepted, failures, number = time.time(), 0, 0, options.first
    with tempfile.TemporaryDirectory() as folder:
        known = samples(folder)
        for name, (tool, words) in known.items():
            status, said = outcome(tool, (os.path.join(folder, name), os.path.join(folder, OTHER.get(tool, "out.g")), *words))
            if status != 0:
                print(f"the sample {name} is not read: {said}")
                return 1
        while failures < MOST_FAILURES:
            minutes = (time.time() - start) / 60
            if minutes >= options.minutes if options.minutes else number >= options.first + options.inputs:
                break
            chance = random.Random(f"{options.seed} {number}")
            name = chance.choice(sorted(known))
            tool, words = known[name]
            with open(os.path.join(folder, name), "rb") as file:
                data = damaged(file.read(), chance)
            path = os.path.join(folder, "input-" + name)
            with open(path, "wb") as file:
                file.write(data)
            status, said = outcome(tool, (path, os.path.join(folder, OTHER.get(tool, "out.g")), *words))
            accepted += status == 0
            if status not in (0, 1):
                failures += 1
                os.makedirs(options.keep, exist_ok=True)
                kept = os.path.join(options.keep, f"{options.seed}-{number}-{name}")
                shutil.copy(path, kept)
                print(f"FAILURE input {number}: status {status}\n{said[-1500:]}\n  again: tools/{tool} {kept} out.g "
                      f"{' '.join(words)}", flush=True)
            number += 1
    minutes = (time.time() - start) / 60
    tried = number - options.first
    print(f"{tried} inputs in {minutes:.1f} minutes ({tried / minutes:.0f} a minute), {accepted} accepted, the others "
          f"refused: {failures} failures")
    return 1 if failures else 0


sys.exit(main())
