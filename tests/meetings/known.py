"""Faults that are known and not yet mended: a meeting is described here, not a seed. The test counts them, and does not fail by them. An entry
that no scene has needed for some thousand scenes goes."""
from scenes import written


def contact_models(scene):
    return {model["Contact Model"] for model in scene.deck.get("Contact", {}).get("Models", {}).values()}


def gains(case, name, problem):
    """The run was stopped as its energy grew; relations then see that the other run was not, or later."""
    return case.scene.explicit and "balance of energy" in case.base.error and (name == "stable" or problem.startswith(("status", "error")))


def step_fell(case):
    """A run that has written no row, or one, has not been seen to change its step."""
    steps = case.base.history.get("Step_Size", ())
    return len(steps) > 1 and steps[0] > 1.02 * steps[1:].min()


def touched_by_a_stiff_law(case, name, problem):
    return gains(case, name, problem) and any("times as stiff as the stiffer block" in line for line in case.base.warnings)


def changed_its_step(case, name, problem):
    return gains(case, name, problem) and not contact_models(case.scene) and step_fell(case)


def by_substeps(case, name, problem):
    """Without substeps the run keeps its energy."""
    told = any("out of nothing" in line for line in case.base.warnings)
    if not (gains(case, name, problem) or name == "without subcycling" and told):
        return False
    other = case.scene.copy()
    other.deck["Solver"].setdefault("Verlet", {})["Subcycling"] = False
    result = case.runner.run(written(other), name="other")
    return result.status == 0 and not any("out of nothing" in line for line in result.warnings)


def pushed_between_substeps(case, name, problem):
    """By contact, or by a tool with a mass: levels and step are chosen anew as they come."""
    scene = case.scene
    return (contact_models(scene) or any("Mass" in one for one in scene.conditions.values())) and by_substeps(case, name, problem)


def flat_in_substeps(case, name, problem):
    return any("nearly lie in one plane" in line for line in case.base.warnings) and by_substeps(case, name, problem)


KNOWN = {
    "by a law of points far stiffer than the bodies a touch lasts a few steps, whose ends cost or give a part of its energy; told at the start": touched_by_a_stiff_law,
    "the step changes while the highest modes ring, which gives them energy": changed_its_step,
    "contact, or a tool with a mass, comes to points of many substeps while bodies vibrate: the step falls, which gives them energy": pushed_between_substeps,
    "points whose neighbors nearly lie in one plane take some ten substeps or more, which feed their vibrations; told at the start": flat_in_substeps,
}


def known(case, name, problem):
    """The sentence, or None."""
    return next((sentence for sentence, holds in KNOWN.items() if holds(case, name, problem)), None)
