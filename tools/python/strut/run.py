"""A run: its steps, fields and history."""
import copy
import sys
import warnings
import weakref
from collections.abc import Mapping

import numpy as np

from . import _core
from .deck import Deck

live = weakref.WeakSet()


class Told:
    """The output of a run: kept, and shown at once with progress; without progress, only its warnings are shown."""

    def __init__(self, progress):
        self.progress, self.text, self.warned = progress, "", 0

    def write(self, text):
        self.text += text
        if self.progress:
            sys.stdout.write(text)

    def warn(self):
        """Issues the warnings in whole lines since the last call. Not within write(), where an exception would be lost."""
        end = self.text.rfind("\n") + 1
        lines, self.warned = self.text[self.warned:end].split("\n"), end
        for line in lines:
            if line.startswith("WARNING") and not self.progress:
                warnings.warn(line.removeprefix("WARNING: "), stacklevel=4)

    def flush(self):
        if self.progress:
            sys.stdout.flush()


class Fields(Mapping):
    """The output variables (inputs/VARIABLES.md) of this rank's points, in the order of run.ids."""

    def __init__(self, run):
        self.run = run

    def __getitem__(self, name):
        return self.run.core.field(str(name))

    def __iter__(self):
        return iter(self.run.core.names)

    def __len__(self):
        return len(self.run.core.names)

    def __contains__(self, name):
        return name in self.run.core.names


class History(dict):
    """The columns of the history so far, as arrays; units: {column: unit}."""

    def __init__(self, names, units, rows):
        super().__init__(zip(names, np.asarray(rows).reshape(-1, max(1, len(names))).T))
        self.units = dict(zip(names, units))

    def to_pandas(self):
        import pandas

        return pandas.DataFrame(dict(self))


class Run:
    """A run of a deck (Deck, dictionary or file). It is set up, and stands at its first time; advance() and advance_to()
    go on. mesh: of a deck that names none; continued: from the checkpoint that an earlier run has left, if there is one.
    Errors are strut.Error, on all ranks."""

    def __init__(self, deck, mesh=None, progress=False, continued=False):
        self.deck = with_mesh(deck, mesh)
        if "Restart" not in self.deck and not continued:  # without that section the program writes one at times
            self.deck = Deck({**self.deck, "Restart": {"Enabled": False}}, self.deck.name)
        self.deck = copy.deepcopy(self.deck)
        self.mesh, self.told, self.text = mesh, Told(progress), self.deck.to_xml()
        self.core = self._telling(_core.Run, self.text, self.deck.name, mesh, continued, self.told)
        live.add(self)

    def _telling(self, action, *words):
        try:
            return action(*words)
        finally:
            self.told.warn()

    def advance(self, steps=None, until=None):
        """So many steps (load steps of equilibria), or to the first one at or after a time, s, or to the end. True if
        steps are left."""
        if self.deck.to_xml() != self.text:
            raise _core.Error("run.deck has been changed; expected the deck that the run began with: loads change in time by expressions "
                              "of t, and another run may start from this one's checkpoint (Start From)")
        if steps is not None:
            steps = whole_number(steps, "steps", 0)
        if until is not None and not (isinstance(until, (int, float, np.number)) and np.isfinite(until)):
            raise _core.Error(f"until: {until!r}; expected a time, in s")
        return self._telling(self.core.advance, steps, until)

    def advance_to(self, time):
        """To the first step at or after a time, s. True if steps are left."""
        return self.advance(until=time)

    def watch(self, callback, every, until=None):
        """Goes on like advance(until=…), and calls callback(run) after so many steps each; False stops there, and the
        run may go on later. An error of a callback on one rank is one on all."""
        every = whole_number(every, "every", 1)
        if not callable(callback):
            raise _core.Error(f"callback: {callback!r}; expected a function of the run")
        while self.advance(every, until) and (until is None or self.time < until):
            error = goes_on = None
            try:
                goes_on = callback(self) is not False
            except BaseException as raised:  # Ctrl-C, too, reaches the ranks at different times
                error = raised
            if _core.any(error is not None):
                raise error or _core.Error("the callback failed on another rank")
            if _core.any(not goes_on):
                return True
        return not self.has_ended

    def end(self):
        """Ends the run early, after one more step: with a last frame, and a checkpoint if the deck has one."""
        if not self.has_ended:
            self._telling(self.core.end)

    time = property(lambda self: self.core.time, doc="s")
    steps = property(lambda self: self.core.steps, doc="made so far")
    has_ended = property(lambda self: self.core.has_ended, doc="early or not")
    is_over = property(lambda self: self.core.is_over, doc="at the final time")
    log = property(lambda self: self.told.text, doc="what the run has said so far (on rank 0)")
    fields = property(Fields)
    ids = property(lambda self: self.core.ids, doc="of this rank's points: their places in the mesh, from 0")
    blocks = property(lambda self: np.array(self.core.blocks), doc="of this rank's points: the names of their blocks")
    positions = property(lambda self: self.core.positions, doc="of this rank's points, now, m")
    history = property(lambda self: History(*self.core.history()), doc="{column: array} so far, of a deck with the section History; .units, .to_pandas()")

    def whole(self, name):
        """A field of all points in the order of the mesh, on rank 0 (None elsewhere); NaN for points that were dropped."""
        return self.core.whole(name)


def run(deck, mesh=None, progress=False, every=None, callback=None, continued=False):
    """Runs a deck to its end; or until callback(run), called after `every` steps each, returns False."""
    if (every is None) != (callback is None):
        raise _core.Error("every and callback belong together: callback(run) is called after so many steps each")
    made = Run(deck, mesh, progress, continued)
    if callback is None:
        made.advance()
    else:
        made.watch(callback, every)
    return made


def check(deck, mesh=None):
    """Raises strut.Error with all that is wrong with a deck and its mesh; without a mesh, with the deck alone."""
    deck = with_mesh(deck, mesh)
    if problems := _core.problems(deck.to_xml(), deck.name, mesh):
        raise _core.Error(problems)


def whole_number(number, user, least):
    if isinstance(number, bool) or not isinstance(number, (int, np.integer)) or number < least:
        raise _core.Error(f"{user}: {number!r}; expected a whole number, {least} or more")
    return int(number)


def with_mesh(deck, mesh):
    """The deck, whose Type is Memory where it names no mesh."""
    if not isinstance(mesh, (_core.Mesh, type(None))):
        raise _core.Error(f"mesh: {type(mesh).__name__}; expected what strut.voxels, strut.mesh or strut.recipe give")
    deck = deck if isinstance(deck, Deck) else Deck(deck)
    points = deck.get("Discretization", {})
    if isinstance(points, dict) and "Type" not in points and "Input Mesh File" not in points:
        deck = Deck({**deck, "Discretization": {"Type": "Memory", **points}}, deck.name)
    if mesh is not None and deck["Discretization"].get("Type") != "Memory":
        raise _core.Error(f"{deck.name}: Discretization names a mesh, and one is given, too; expected one of them")
    return deck


def close_all():
    for one in list(live):
        one.core.close()
