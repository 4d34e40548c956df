"""A block of voxels between two plates, as a deck and a mesh for tests of the module, and a folder for each test."""
import os
import sys
import tempfile
import unittest

try:
    import numpy as np
    import strut
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

SPACING = 1e-3


def solid():
    """Of two sizes, so that no axis is like another."""
    voxels = np.ones((4, 5, 8), bool)
    voxels[0, 0, :] = False
    return voxels


def mesh():
    return strut.voxels(solid(), SPACING, name="block")


def deck(**sections):
    return strut.Deck({
        "Discretization": {},
        "Materials": {"metal": {"Material Model": "Elastic Plastic Correspondence", "Density": 2700.0, "Young's Modulus": 70e9,
                                "Poisson's Ratio": 0.3, "Yield Stress": 200e6}},
        "Blocks": {"block": {"Block Names": "block", "Material": "metal", "Horizon Factor": 1.75}},
        "Boundary Conditions": {
            "top": {"Type": "Prescribed Velocity", "Node Set": "block_zmax", "Coordinate": "z", "Value": "-20"},
            "foot": {"Type": "Prescribed Displacement", "Node Set": "block_zmin", "Coordinate": "xyz", "Value": "0"}},
        "Solver": {"Final Time": 4e-6},
        "History": {"Frequency": 1, "Variables": {"Max_Displacement": True, "Reaction_Z(top)": True}},
        **sections})


FIELDS = {"Displacement": True, "Cauchy_Stress": True, "Equivalent_Plastic_Strain": True, "Force_Density": True}


def output(name):
    return {"Output Filename": name, "Output Interval": 1e-6, "Output Variables": FIELDS}


class InFolder(unittest.TestCase):
    """Each test has a working folder of its own."""

    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(keep.name)
