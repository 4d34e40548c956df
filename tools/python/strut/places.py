"""Where the tools and programs of strut are: in the sources, or as they are installed."""
import os

HERE = os.path.dirname(os.path.realpath(__file__))
TOOLS = next((os.path.realpath(path) for path in (os.path.join(HERE, *up) for up in (
    ("..", ".."), ("..", "..", "..", "..", "share", "strut", "tools"), ("..", "..", "..", "..", "..", "share", "strut", "tools")))
    if os.path.isdir(os.path.join(path, "shared"))), None)
if TOOLS is None:
    raise ImportError(f"strut: its tools are not there, seen from {HERE}")


def programs():
    """{variable of the tools: program} of the build or the prefix that holds this module."""
    from . import _core

    top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(_core.__file__))))
    folders = (top, os.path.join(top, "tools"), os.path.join(top, "..", "bin"), os.path.join(top, "..", "..", "bin"))
    found = {}
    for variable, name in (("STRUT", "strut"), ("STRUT_MESH", "strut-mesh"), ("STRUT_EVALUATE", "strut-evaluate")):
        path = next((path for path in (os.path.join(f, name) for f in folders) if os.access(path, os.X_OK) and os.path.isfile(path)), None)
        found |= {variable: os.path.realpath(path)} if path else {}
    return found


PROGRAMS = programs()
