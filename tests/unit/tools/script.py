"""Runs a tool written in Python as a process of its own, which has the libraries that the test has imported: starting
Python and reading VTK and scipy anew took most of the time of tests that call a tool a hundred times."""
import multiprocessing
import os
import runpy
import subprocess
import sys
import tempfile


def child(script, words, folder, out, err):
    for file, number in ((out, 1), (err, 2)):
        os.dup2(file.fileno(), number)
    sys.stdout, sys.stderr = (os.fdopen(number, "w") for number in (1, 2))
    os.chdir(folder)
    sys.argv = [str(script), *words]
    runpy.run_path(str(script), run_name="__main__")


def run(script, *words, folder=".", timeout=120):
    """As subprocess.run() of the script in `folder`: its exit status, and what it printed."""
    words = [str(word) for word in words]
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        process = multiprocessing.get_context("fork").Process(target=child, args=(script, words, folder, out, err))
        process.start()
        process.join(timeout)
        if process.is_alive():
            process.kill()
            raise subprocess.TimeoutExpired([str(script), *words], timeout)
        for file in (out, err):
            file.seek(0)
        return subprocess.CompletedProcess([str(script), *words], process.exitcode, out.read(), err.read())
