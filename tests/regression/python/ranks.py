#!/usr/bin/python3
"""Started on ranks by mpirun: the same run as on one, errors on all ranks, and MPI as mpi4py or strut starts it.
    ranks.py mpi4py|strut RANKS"""
import os
import subprocess
import sys
import tempfile

if sys.argv[1] == "mpi4py":
    try:
        from mpi4py import MPI
    except ImportError as error:
        print(f"skipped: {error}")
        sys.exit(77)

import block
import strut
from strut.tools import environment

FOLDER = tempfile.mkdtemp(prefix="strut-ranks-")  # a rank each: only rank 0 writes
os.chdir(FOLDER)
rank = strut._core.rank()


def fails(action, words):
    try:
        action()
    except strut.Error as error:
        assert words in str(error), f"rank {rank}: {error}"
    else:
        raise AssertionError(f"rank {rank}: no error '{words}'")


mesh = block.mesh() if rank == 0 else None  # rank 0's counts
deck = block.deck(Discretization={"Type": "Memory"}, Output=block.output("block.e"))
run = strut.Run(deck, mesh)
assert len(run.ids) < block.solid().sum(), "one rank has all points"
calls = []
run.watch(lambda run: calls.append(run.steps) or run.steps < 4, every=2)
assert calls == [2, 4]
run.watch(lambda run: rank != 1 or run.steps < 8, every=2)  # rank 1 alone stops: all do
assert run.steps == 8 and not run.has_ended
for kind in (ZeroDivisionError, KeyboardInterrupt):
    def fail(_, kind=kind):
        if rank == 1:
            raise kind

    try:
        run.watch(fail, every=1)
    except kind:
        assert rank == 1
    except strut.Error as error:
        assert rank != 1 and "the callback failed on another rank" in str(error)
    else:
        raise AssertionError("no error of the callback")
run.advance()
assert run.is_over
fails(lambda: strut.run(block.deck(Discretization={"Type": "Memory"}, Solver={"Final Time": -1.0}), mesh), "Solver > Final Time")
fails(lambda: strut.curve(run, smoth=3), "the tool failed on rank 0" if rank else "did you mean '--smooth'")
everything = run.whole("Displacement")
assert (everything is None) == (rank != 0)
if rank == 0:  # fields have the same bits on any number of ranks; this is the run on one, by the program
    block.mesh().write("block.g")
    one = block.deck(Discretization={"Type": "Exodus", "Input Mesh File": "block.g"}, Output=block.output("one.e"), History=None)
    with open("one.xml", "w") as file:
        file.write(one.to_xml())
    for command in ([os.environ["STRUT"], "one.xml"], [os.environ["STRUT_COMPARE"], "block.e", "one.e"]):
        done = subprocess.run(command, env=environment(), capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
if sys.argv[1] == "mpi4py":
    total = MPI.COMM_WORLD.allreduce(len(run.ids))
    assert total == block.solid().sum() and MPI.COMM_WORLD.size == int(sys.argv[2])
