"""Checks the names in a study before its runs: columns of the history, measures of tools/curve, its options."""
import re

import numpy as np
from curve_parts import measures, shock, source
from decks import NoExpression, evaluated, is_true, value_in
from strut_tools import Parser, fail, nearest

from .collect import OF_LOGS

# The first columns of every history (src/output/writers.cpp).
ALWAYS = ("Time", "Step_Size", "Kinetic_Energy", "Elastic_Energy", "Plastic_Work", "Stabilization_Energy", "Fracture_Energy",
          "Heat", "Tool_Kinetic_Energy", "Tool_Work", "Contact_Work", "External_Work", "Balance_Error", "Momentum_X", "Momentum_Y",
          "Momentum_Z")


def columns_of(deck):
    """The columns of the deck's history; empty without one."""
    if deck.section("History") is None:
        return []
    layers = {name: int(value_in(keys, "Layers") or 0) for name, keys in deck.sections("History", "Profiles").items()}
    variables = deck.section("History", "Variables")
    asked = [] if variables is None else [e.get("name") for e in variables.findall("Parameter") if is_true(e.get("value"))]
    found = list(ALWAYS)
    for name in asked:
        match = re.fullmatch(r"(.+)\((.+)\)", name)
        count = layers.get(match[2], 1) if match else 1
        found += [f"{match[1]}({match[2]} {n})" for n in range(1, count + 1)] if count > 1 else [name]
    return found


def measures_of(study):
    if study.curve is None:
        return []
    return [m.name for m in measures.of_curve(np.linspace(0, 0.1, 5), np.linspace(0, 1, 5))] + list(shock.MEASURES)


def check(study, deck):
    """Ends the tool if a name in `collect`, `plot` or `curve` will not exist in a run of the deck."""
    columns, read = columns_of(deck), measures_of(study)
    if study.curve is not None:
        check_curve(study, columns)
    for name in study.collect:
        study.expect(name, columns + read, "to collect")
    varied = [name for names, _ in study.vary for name in names]
    known = list(dict.fromkeys(varied + list(OF_LOGS) + (study.collect or read)))
    for plot in study.plots:
        for name in (plot.x, plot.y, plot.by):
            if name:
                study.expect(name, known, "to plot")
        check_beside(study, plot, known)


def check_beside(study, plot, known):
    if not plot.beside:
        return
    try:
        evaluated(plot.beside, dict.fromkeys(known, 1))
    except NoExpression as error:
        word = re.search(r"'(\w+)' is not a variable", str(error))
        fail(f"{study.path}: 'beside {plot.beside}': {word[0] + nearest(word[1], known) if word else error}")


def check_curve(study, columns):
    class OfStudy(Parser):
        def error(self, message):
            fail(f"{study.path}, curve: {message}")

    words = source.parser_of("", OfStudy).parse_args(["deck.xml", *study.curve.split()])
    for option, name in (("--force", words.force), ("--other", words.other)):
        if name and name not in columns:
            fail(f"{study.path}, curve: {option}: there is no column '{name}'{nearest(name, columns)}; there are {', '.join(columns)}")
