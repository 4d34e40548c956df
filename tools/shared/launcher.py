"""How ranks are started on this machine."""
import functools
import subprocess


@functools.cache
def is_open_mpi(program="mpirun"):
    found = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
    return "Open MPI" in found or "OpenRTE" in found


def mpirun(ranks):
    """The words that start so many ranks; Open MPI's mpirun must be asked for runs that share cores."""
    return ["mpirun", *(["--oversubscribe", "--bind-to", "none"] if is_open_mpi() else []), "-np", str(ranks)]
