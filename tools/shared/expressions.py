"""The language of a deck's expressions (inputs/KEYS.md), as the program reads it: strut-evaluate is asked."""
import functools
import math
import os
import re
import subprocess

from strut_tools import fail, programs


class NoExpression(Exception):
    """Where and what is wrong, for a user."""


@functools.cache
def asked():
    """STRUT_EVALUATE, or the program that belongs to this tool; it runs until the tool ends."""
    name = os.environ.get("STRUT_EVALUATE") or programs("strut-evaluate")[0]
    try:
        return subprocess.Popen([name], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    except OSError as error:
        fail(f"{name} cannot be started: {error.strerror}")


def evaluated(text, names):
    """The number that an expression of these {name: number} is, nan and infinite among them; throws NoExpression."""
    for name in set(names) - set("xyzt"):  # which the language does not know
        text = re.sub(rf"(?<![\w.]){re.escape(name)}(?!\w|\s*\()", f"({float(names[name])!r})", text)
    program, place = asked(), " ".join(repr(float(names.get(c, math.nan))) for c in "xyzt")
    program.stdin.write(f"{place} {' '.join(text.split())}\n")
    program.stdin.flush()
    answer = program.stdout.readline().strip()
    if answer.startswith("error") or not answer:
        raise NoExpression(answer[len("error "):] or "the program that reads expressions has ended")
    return float(answer)
