"""The tools of strut: in the sources, or as they are installed."""
import importlib.util
import os
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
UP = ("../..", "../../../../share/strut/tools", "../../../../../share/strut/tools")
TOOLS = next(((HERE / up).resolve() for up in UP if (HERE / up / "shared").is_dir()), None)
if TOOLS is None:
    raise ImportError(f"strut: its tools are not there, seen from {HERE}")


def part_of_the_tools(*path):
    """A module of the tools, loaded by its file because a script may have a module of the same name."""
    spec = importlib.util.spec_from_file_location("strut._" + path[-1], os.path.join(TOOLS, *path) + ".py")
    part = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(part)
    return part
