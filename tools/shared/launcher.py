"""Starts ranks on this machine."""
import functools
import subprocess


@functools.cache
def is_open_mpi(program="mpirun"):
    found = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
    return "Open MPI" in found or "OpenRTE" in found


def mpirun(ranks):
    """The command that starts this many ranks; Open MPI's mpirun needs options for runs that share cores."""
    return ["mpirun", *(["--oversubscribe", "--bind-to", "none"] if is_open_mpi() else []), "-np", str(ranks)]
