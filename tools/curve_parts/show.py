"""The text and the figure of a curve."""
import matplotlib.pyplot as plt
import numpy as np
from strut_tools import save_picture


def say(about, found):
    for what, text in about.items():
        if text:
            print(f"{what:<18} {text}")
    print()
    for m in found:
        value = "-" if m.value is None else f"{m.value:.5g}"
        print(f"{m.name:<24} {value:>12} {'' if m.unit == '1' else m.unit:<6} {m.said()}")


def scaled(pascals):
    """A factor and its unit for the axes."""
    largest = np.abs(pascals).max()
    return next(((f, u) for f, u in ((1e-9, "GPa"), (1e-6, "MPa"), (1e-3, "kPa")) if largest * f >= 1), (1, "Pa"))


def figure(path, title, times, strain, names, stresses, found, front):
    ends = len(stresses) > 1 or front is not None
    columns = 1 + ends + (front is not None)
    drawing, panels = plt.subplots(1, columns, figsize=(5.4 * columns, 4.2), layout="constrained", squeeze=False)
    panels = list(panels[0])
    factor, unit = scaled(np.concatenate(stresses))
    draw_curve(panels[0], strain, factor * stresses[0], {m.name: m.value for m in found}, factor)
    panels[0].set_ylabel(f"nominal stress, {unit}")
    if ends:
        for name, stress in zip(names, stresses):
            panels[1].plot(1e3 * times, factor * stress, linewidth=1.2, label=name)
        panels[1].set(xlabel="t, ms", ylabel=f"nominal stress at the ends, {unit}")
        panels[1].legend(frameon=False)
    if front is not None:
        panels[2].plot(1e3 * front.arrivals, 1e3 * front.places, ".", label="front")
        t = front.ahead.arrivals[[0, -1]]
        panels[2].plot(1e3 * t, 1e3 * front.speed * (t - front.start), linewidth=1, label=f"{front.speed:.4g} m/s")
        panels[2].set(xlabel="t, ms", ylabel="reference distance from the end that is hit, mm")
        panels[2].legend(frameon=False)
    for panel in panels:
        panel.grid(alpha=0.3)
    drawing.suptitle(title, fontsize=12)
    save_picture(drawing, path)


def draw_curve(axes, strain, stress, found, factor):
    axes.plot(strain, stress, linewidth=1.4, color="black")
    for name, low, high in (("plateau_stress", 0.2, 0.3), ("plateau_stress_20_40", 0.2, 0.4)):
        if found.get(name) is not None:
            axes.plot([low, high], [factor * found[name]] * 2, linewidth=3, alpha=0.6, label=name.replace("_", " "))
    for name in ("plateau_end", "densification_strain"):
        if found.get(name) is not None:
            axes.axvline(found[name], linestyle=":" if name == "plateau_end" else "--", color="grey",
                         label=name.replace("_", " "))
    gradient = found.get("quasi_elastic_gradient")
    if gradient:
        top = 1.1 * stress.max()
        axes.plot([0, top / (factor * gradient)], [0, top], linewidth=0.8, label="quasi-elastic gradient")
        axes.set_ylim(min(0, stress.min()), top)
    axes.set_xlabel("nominal strain")
    axes.set_xlim(0, 1.02 * strain.max())
    if axes.get_legend_handles_labels()[0]:
        axes.legend(frameon=False)
