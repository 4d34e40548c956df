"""Quantities derived from a 6 x 6 stiffness (Pa; order xx yy zz yz zx xy, engineering shear strains)."""
import numpy as np


def symmetric(C):
    return 0.5 * (C + C.T)


def asymmetry(C):
    return float(np.abs(C - C.T).max() / np.abs(C).max())


def extremes(C):
    """The least and the largest eigenvalue."""
    return np.linalg.eigvalsh(symmetric(C))[[0, -1]]


def engineering(C):
    """{name: value} for Young's moduli, shear moduli (Pa) and Poisson's ratios along the axes."""
    S = np.linalg.inv(symmetric(C))
    found = {f"E_{a}": 1 / S[i, i] for i, a in enumerate("xyz")}
    found.update({f"G_{a}": 1 / S[i, i] for i, a in zip((3, 4, 5), ("yz", "zx", "xy"))})
    found.update({f"nu_{'xyz'[i]}{'xyz'[j]}": -S[i, j] / S[i, i] for i in range(3) for j in range(3) if i != j})
    return found


def bounds(C):
    """Bulk and shear moduli of an aggregate of all orientations, by Voigt, Reuss, Hill (Hill 1952)."""
    C = symmetric(C)
    S = np.linalg.inv(C)
    normal, across, shear = (lambda T: T[:3, :3].trace()), (lambda T: T[:3, :3].sum()), (lambda T: T[3:, 3:].trace())
    K_V = across(C) / 9
    G_V = (normal(C) - 0.5 * (across(C) - normal(C)) + 3 * shear(C)) / 15
    K_R = 1 / across(S)
    G_R = 15 / (4 * normal(S) - 2 * (across(S) - normal(S)) + 3 * shear(S))
    return K_V, G_V, K_R, G_R


def anisotropy(C):
    """The universal index, 0 if isotropic (Ranganathan & Ostoja-Starzewski, Phys. Rev. Lett. 101 (2008) 055504)."""
    K_V, G_V, K_R, G_R = bounds(C)
    return float(5 * G_V / G_R + K_V / K_R - 6)


def zener(C):
    """2 C44/(C11 - C12) from the means for a cubic body (Zener 1948)."""
    C = symmetric(C)
    c11, c12 = C.diagonal()[:3].mean(), (C[0, 1] + C[1, 2] + C[2, 0]) / 3
    return float(2 * C.diagonal()[3:].mean() / (c11 - c12))


def young(C, directions):
    """Young's modulus along unit vectors n (N x 3): 1 / (n n : S : n n)."""
    x, y, z = directions.T
    nn = np.stack([x * x, y * y, z * z, y * z, z * x, x * y], axis=1)  # engineering strains: S takes twice the half
    return 1 / np.einsum("ni,ij,nj->n", nn, np.linalg.inv(symmetric(C)), nn)
