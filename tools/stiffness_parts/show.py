"""The text and the picture of a stiffness."""
import matplotlib.pyplot as plt
import numpy as np
from strut_tools import save_picture

from . import tensors
from .loads import ORDER


def text_of(kind, C, energy):
    unit = 10.0**(3 * int(np.floor(np.log10(np.abs(C).max()) / 3)))
    named = {1e9: "GPa", 1e6: "MPa", 1e3: "kPa"}.get(unit, f"{unit:g} Pa")
    lines = [f"{kind} boundaries, {named}", " " * 4 + "".join(f"{c:>11}" for c in ORDER)]
    lines += [f"{c:<4}" + "".join(f"{x / unit:>11.4g}" for x in row) for c, row in zip(ORDER, C)]
    e = tensors.engineering(C)
    K_V, G_V, K_R, G_R = tensors.bounds(C)
    lines += [", ".join(f"{name} {e[name] / unit:.4g}" for name in e if not name.startswith("nu")),
              ", ".join(f"{name} {e[name]:.4g}" for name in e if name.startswith("nu")),
              f"of all orientations mixed: K {K_R / unit:.4g} to {K_V / unit:.4g}, G {G_R / unit:.4g} to {G_V / unit:.4g} (Reuss, Voigt)",
              f"universal anisotropy {tensors.anisotropy(C):.4g}, Zener {tensors.zener(C):.4g}; off symmetry by "
              f"{tensors.asymmetry(C):.1e}, energies off 1/2 strain C strain by {energy:.1e}"]
    return "\n".join(lines)


def figure(path, title, found):
    """Young's modulus in all directions as a surface, for the last kind; and in the three planes, for each kind."""
    drawing = plt.figure(figsize=(15, 4.2), layout="constrained")
    kind, (C, _) = list(found.items())[-1]
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 73), np.linspace(0, np.pi, 37))
    n = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], axis=-1)
    E = 1e-9 * tensors.young(C, n.reshape(-1, 3)).reshape(u.shape)
    axes = drawing.add_subplot(1, 4, 1, projection="3d")
    spread = max(np.ptp(E), 1e-6 * E.max())
    axes.plot_surface(*np.moveaxis(E[..., None] * n, -1, 0), facecolors=plt.cm.viridis((E - E.min()) / spread), rstride=1,
                      cstride=1, shade=False)
    axes.set_box_aspect((1, 1, 1))
    axes.set(xlim=(-E.max(), E.max()), ylim=(-E.max(), E.max()), zlim=(-E.max(), E.max()))
    axes.set_title(f"E of directions, GPa: {E.min():.4g} to {E.max():.4g}\n{kind} boundaries", fontsize=10)
    angle = np.linspace(0, 2 * np.pi, 361)
    for place, (a, b) in enumerate(((0, 1), (1, 2), (2, 0)), 2):
        panel = drawing.add_subplot(1, 4, place, projection="polar")
        n = np.zeros((len(angle), 3))
        n[:, a], n[:, b] = np.cos(angle), np.sin(angle)
        for name, (tensor, _) in found.items():
            panel.plot(angle, 1e-9 * tensors.young(tensor, n), label=name)
        panel.set_ylim(0, None)
        panel.set_title(f"E in the plane {'xyz'[a]}{'xyz'[b]} (from {'xyz'[a]}), GPa", fontsize=10)
    panel.legend(loc="lower right", fontsize=8)
    drawing.suptitle(title)
    save_picture(drawing, path)
