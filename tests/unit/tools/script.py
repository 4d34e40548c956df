"""Runs a tool written in Python as a process of its own, which has the libraries that the test has imported: starting
Python and reading VTK and scipy anew took most of the time of tests that call a tool a hundred times."""
import functools
import multiprocessing
import os
import runpy
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor

FORK = multiprocessing.get_context("fork")


def child(script, words, folder, environment, out, err):
    os.environ.update(environment)
    for file, number in ((out, 1), (err, 2)):
        os.dup2(file.fileno(), number)
    sys.stdout, sys.stderr = (os.fdopen(number, "w") for number in (1, 2))
    os.chdir(folder)
    sys.argv = [str(script), *words]
    runpy.run_path(str(script), run_name="__main__")


def forked(script, words, folder, environment, timeout):
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        process = FORK.Process(target=child, args=(script, words, folder, environment, out, err))
        process.start()
        process.join(timeout)
        if process.is_alive():
            process.kill()
            raise subprocess.TimeoutExpired([str(script), *words], timeout)
        for file in (out, err):
            file.seek(0)
        return subprocess.CompletedProcess([str(script), *words], process.exitcode, out.read(), err.read())


@functools.cache
def begin():
    """The process from which runs are forked. To be called before the test draws by VTK, whose screen no fork survives."""
    pool = ProcessPoolExecutor(1, mp_context=FORK)
    pool.submit(int).result()
    return pool


def run(script, *words, folder=".", timeout=200, **environment):
    """As subprocess.run() of the script in `folder`: its exit status, and what it printed."""
    return begin().submit(forked, script, [str(word) for word in words], folder, environment, timeout).result()
