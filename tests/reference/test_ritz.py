#!/usr/bin/python3
"""Frequencies by Ritz against closed forms, and the committed table against the script that made it."""
import math
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
DIGITS = 2e-6  # relative: the sixth decimal may be rounded otherwise by another library


def ritz(*words):
    done = subprocess.run([HERE / "ritz", *words], capture_output=True, text=True)
    if done.returncode == 77:
        print(done.stderr)
        sys.exit(77)
    assert done.returncode == 0, done.stderr
    return done.stdout


def frequencies(*words):
    return [(float(line.split()[0]), line.split()[1]) for line in ritz(*words).splitlines()]


def check_near(value, expected, tolerance, what):
    assert abs(value - expected) < tolerance * expected, f"{what}: {value}, expected {expected}"


def test_a_round_bar_twists_at_the_speed_of_shear():
    for poisson, length in (0.3, 4), (0.1, 2.5):
        found = frequencies("--section", "round", "--poisson", str(poisson), "--length", str(length))
        torsion = min(omega for omega, kind in found if kind == "torsion")
        check_near(torsion, math.pi / length / math.sqrt(2 * (1 + poisson)), DIGITS, "torsion of a round bar")


def test_a_cube_has_the_modes_of_lame():
    """u = (sin x cos y, -cos x sin y), Lame's waves at 45 degrees to the faces, leave all faces free of stress, for
    any Poisson's ratio: omega = pi sqrt(2 G)."""
    for poisson in 0.0, 0.3:
        exact = math.pi * math.sqrt(2 / (2 * (1 + poisson)))
        found = frequencies("--length", "1", "--poisson", str(poisson), "--count", "30")
        check_near(min((abs(omega - exact), omega) for omega, kind in found)[1], exact, DIGITS, "Lame's mode of a cube")


def test_long_bars_come_near_the_theories_of_bars():
    """Theories of Euler and Bernoulli, and of Navier: exact but for the square of thickness over wavelength. An ideal beam's
    beta L is 4.73004; the first correction, of shear and rotatory inertia, is some (pi/L)^2 at L = 20: 2 %."""
    for section, radius_of_gyration in ("square", math.sqrt(1 / 12)), ("round", 0.25):
        found = frequencies("--section", section, "--length", "20", "--poisson", "0.3", "--count", "20",
                            "--tolerance", "1e-3")
        assert [kind for omega, kind in found[:4]] == ["bending"] * 4
        check_near(found[0][0], radius_of_gyration * (4.73004 / 20) ** 2, 0.02, "bending of a long bar")
        extension = min(omega for omega, kind in found if kind == "extension")
        check_near(extension, math.pi / 20, 1e-3, "extension of a long bar")  # lateral inertia: (nu pi/L)^2/12 or so


def test_a_box_bends_along_its_thickness_first():
    """By theory 1.5 times as fast along the breadth; shear takes more of the stiffer one."""
    bendings = [omega for omega, kind in frequencies("--breadth", "1.5") if kind == "bending"]
    assert 1.2 < bendings[1] / bendings[0] < 1.5, bendings


def test_the_table_is_what_the_script_says():
    table, now = (HERE / "frequencies.hpp").read_text(), ritz("--table")
    number = r"\d\.\d{6}"
    assert re.sub(number, "", table) == re.sub(number, "", now), "frequencies.hpp is not what ritz --table prints"
    for old, new in zip(re.findall(number, table), re.findall(number, now)):
        check_near(float(new), float(old), DIGITS, "frequencies.hpp")


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print("passed:", name)
