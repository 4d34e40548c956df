"""Exodus II by netCDF4: files of which nothing is missing, the names in them, and meshes as strut-mesh writes them."""
import os
import re
import subprocess

import classic_netcdf
import numpy as np
from strut_tools import fail, program

CORNERS = {"HEX8": 8, "TET4": 4, "SPHERE": 1}
TITLE = "strut mesh"  # by which strut-mesh knows its files
LONGEST_NAME, MOST_SETS = 127, 64
LARGEST = 2**32 - 8   # bytes of a variable in the format with 64-bit offsets


def opened(path):
    """The file, without masks. netCDF reads what a file that is cut off lacks as zeros: such a file is refused."""
    import netCDF4

    if not os.path.isfile(path):
        fail(f"{path} does not exist")
    if wrong := classic_netcdf.problem(path):
        fail(f"{path} is damaged: {wrong}")
    try:
        file = netCDF4.Dataset(path)
    except OSError as error:
        fail(f"{path} is not an Exodus file: {error}")
    file.set_auto_mask(False)
    return file


def names_in(file, variable):
    """The names that a file lists under `variable`; none where it has no such list."""
    rows = file.variables[variable][:] if variable in file.variables else []
    return [np.ma.filled(row, b"\0").tobytes().decode(errors="replace").split("\0")[0].strip() for row in rows]


def field_in(file, name):
    """A field of a result, frame by frame: of its nodes, or of the elements of its first block."""
    nodal = names_in(file, "name_nod_var")
    if name in nodal:
        return file[f"vals_nod_var{nodal.index(name) + 1}"]
    return file[f"vals_elem_var{names_in(file, 'name_elem_var').index(name) + 1}eb1"]


# Writing


def check(path, blocks, sets):
    names = [block[0] for block in blocks] + list(sets)
    if long := [name for name in names if len(name) > LONGEST_NAME]:
        fail(f"{path}: the name '{long[0]}' is longer than {LONGEST_NAME} characters")
    if len(sets) > MOST_SETS:
        fail(f"{path}: {len(sets)} node sets, at most {MOST_SETS} are supported")
    if not os.path.exists(path):
        return
    # A rename would replace a device, and a file that may not be written.
    if not os.path.isfile(path):
        fail(f"'{path}' is a folder, a pipe or a device; expected a file that may be replaced")
    if not os.access(path, os.W_OK):
        fail(f"'{path}' is there and may not be written; expected another name")
    with open(path, "rb") as file:
        head = file.read(10**6)
    if head.strip(b"\0") and not (head.startswith(b"CDF") and TITLE.encode() in head):
        fail(f"'{path}' is there and is no mesh of strut-mesh, which would replace it; expected another name, or that it is removed")


def numbers_of(names, prefix):
    """Numbers of blocks or sets: those in names like block_7 where all have one, else 1, 2, …"""
    found = {int(match[1]) for name in names if (match := re.fullmatch(prefix + r"_([1-9]\d{0,8})", name))}
    return [int(name[len(prefix) + 1:]) for name in names] if len(found) == len(names) else range(1, len(names) + 1)


class Variables:
    """The variables of a file: all are defined before the first one gets its values, as netCDF would move these otherwise."""

    def __init__(self, file):
        self.file, self.later = file, []

    def put(self, name, kind, values, words=None, **sizes):
        for dimension, size in sizes.items():
            if dimension not in self.file.dimensions:
                self.file.createDimension(dimension, size)
        variable = self.file.createVariable(name, kind, list(sizes))
        variable.setncatts(words or {})
        self.later.append((variable, values))

    def put_names(self, name, names, **sizes):
        rows = np.array([word.encode() for word in names], f"S{LONGEST_NAME + 1}")
        self.put(name, "S1", rows.view("S1").reshape(len(rows), -1), **sizes, len_name=LONGEST_NAME + 1)

    def put_list(self, kind, prefix, names, filled, **size):
        self.put(f"{kind}_status", "i4", np.array(filled, "i4"), **size)
        self.put(f"{kind}_prop1", "i4", np.array(numbers_of(names, prefix)), {"name": "ID"}, **size)
        self.put_names(f"{kind}_names", names, **size)

    def put_mesh(self, nodes, blocks, sets):
        self.file.setncatts({"api_version": np.float32(6.02), "version": np.float32(6.02), "floating_point_word_size": np.int32(8),
                             "file_size": np.int32(1), "maximum_name_length": np.int32(LONGEST_NAME), "title": TITLE})
        for name, size in (("len_string", 33), ("len_line", 81), ("four", 4), ("num_elem", sum(len(b[2]) for b in blocks))):
            self.file.createDimension(name, size)
        self.put("time_whole", "f8", [], time_step=None)
        self.put_names("coor_names", "xyz", num_dim=3)
        self.put_list("eb", "block", [block[0] for block in blocks], [1] * len(blocks), num_el_blk=len(blocks))
        if sets:
            self.put_list("ns", "nodelist", sets, [len(members) > 0 for members in sets.values()], num_node_sets=len(sets))
        for n, members in enumerate(sets.values(), 1):
            if len(members):
                self.put(f"node_ns{n}", "i4", members, **{f"num_nod_ns{n}": len(members)})
        for c, x in zip("xyz", nodes.T):
            self.put("coord" + c, "f8", x, num_nodes=len(nodes))
        for n, (_, kind, elements, volumes) in enumerate(blocks, 1):
            size = {f"num_el_in_blk{n}": len(elements)}
            self.put(f"connect{n}", "i4", elements, {"elem_type": kind}, **size, **{f"num_nod_per_el{n}": CORNERS[kind]})
            if volumes is not None:
                size[f"num_att_in_blk{n}"] = 2
                self.put(f"attrib{n}", "f8", np.stack([np.cbrt(0.75 * volumes / np.pi), volumes], axis=1), **size)
                self.put_names(f"attrib_name{n}", ["radius", "volume"], **{f"num_att_in_blk{n}": 2})

    def fill(self):
        for variable, values in self.later:
            if len(values):
                variable[:] = values + 1 if variable.name.startswith(("connect", "node_ns")) else values


def write_mesh(path, nodes, blocks, sets):
    """nodes: N x 3, in m; blocks: (name, HEX8|TET4|SPHERE, elements x nodes, volumes or None); sets: {name: nodes}.
    Returns a line about it. It is renamed when it is whole: where the disk is full, an earlier mesh stays."""
    import netCDF4

    whole = os.path.realpath(path)
    part = f"{whole}.{os.getpid()}.part"  # of this process: another one may write the same mesh
    for file in (path, part):
        check(file, blocks, sets)
    largest = max([8 * len(nodes), *(4 * elements.size for _, _, elements, _ in blocks)])
    try:
        with netCDF4.Dataset(part, "w", format=f"NETCDF3_64BIT_{'OFFSET' if largest <= LARGEST else 'DATA'}") as file:
            file.set_fill_off()
            variables = Variables(file)
            variables.put_mesh(nodes, blocks, sets)
            variables.fill()
        os.replace(part, whole)
    except (OSError, RuntimeError) as error:
        fail(f"{path} cannot be written: {error}")
    finally:
        if os.path.exists(part):
            os.unlink(part)
    return f"{path}: {sum(len(b[2]) for b in blocks)} points, {len(nodes)} nodes; node sets {', '.join(sets)}"


def gather_voxels(path, parts):
    """A mesh of partly filled cells, by strut-mesh. parts: cells.stream_of()."""
    try:
        run = subprocess.Popen([program("strut-mesh"), "--arrays", path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    except OSError as error:
        fail(f"{program('strut-mesh')} cannot be started: {error.strerror}")
    try:
        for part in parts:
            run.stdin.write(part)
    except BrokenPipeError:
        pass  # the program reports the reason, below
    out, errors = run.communicate()
    if run.returncode != 0:
        said = errors.decode(errors="replace").strip().splitlines() or [f"exit status {run.returncode}"]
        fail(said[0] if said[0].startswith("strut-mesh") else f"strut-mesh: {said[0]}")
    print(out.decode(), end="")
