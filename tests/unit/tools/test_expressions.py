#!/usr/bin/python3
"""Expressions as the tools in Python read them: the table by which the program's own are tested (test_base)."""
import math
import pathlib
import unittest

import tool_test  # noqa: F401
from decks import NoExpression, evaluated, integrals, value_at, value_of

TABLE = pathlib.Path(__file__).resolve().parents[1] / "base" / "expressions.txt"
PLACE = {"x": 3.0, "y": 0.0, "z": 0.0, "t": 0.0}


class Expressions(unittest.TestCase):
    def test_the_shared_table(self):
        rows = [line.split(" | ", 1) for line in TABLE.read_text().splitlines() if line.strip() and line[0] != "#"]
        self.assertGreater(len(rows), 60)
        for expected, text in rows:
            with self.subTest(text):
                if expected == "error":
                    self.assertRaises(NoExpression, evaluated, text, PLACE)
                    continue
                found, value = evaluated(text, PLACE), float(expected)
                if math.isnan(value):
                    self.assertTrue(math.isnan(found))
                elif math.isinf(value):
                    self.assertEqual(found, value)
                else:  # the last bits of sums of 64 terms of size 1, for Bessel's
                    self.assertAlmostEqual(found, value, delta=2e-15 * max(1, abs(value)))

    def test_only_so_deep(self):
        self.assertEqual(value_at("(" * 90 + "t" + ")" * 90, 3), 3)
        right = "t"
        for _ in range(45):
            right = f"(0 || 1 && 1 == 1 < 2 + 3 * {right})"
        self.assertEqual(value_at(right, 3), 1)
        self.assertEqual(value_at("t" + "-" * 9000 + "t", 3), 6)
        self.assertIsNone(value_at("(" * 100000 + "t" + ")" * 100000, 3))

    def test_sums_are_as_long_as_a_deck_s(self):
        self.assertEqual(value_at("t" + " + t" * 1999, 3), 6000)
        self.assertEqual(value_at("t" + " + 2*t*t" * 999, 3), 3 + 18 * 999)

    def test_of_the_time_alone(self):
        self.assertEqual(value_at("-2*t^2", 3), -18)
        steps = "value = 1e-3; if (t < 2 && !(t < 1)) { value = 2*t; } else if (t >= 3) { value = -t; }"
        self.assertEqual([value_at(steps, t) for t in (0.5, 1.5, 2.5, 3)], [1e-3, 3, 1e-3, -3])
        self.assertEqual([value_at("t < 1 ? 5 : 2*t", t) for t in (0.5, 3)], [5, 6])
        for none in ("x*t", "__import__('os')", "log(-t)"):
            self.assertIsNone(value_at(none, 3), none)

    def test_integrals_over_the_time_are_the_program_s(self):
        for text, begin, times, expected in (("-2*(t < 0.51)", 0, [0.5, 1], [-1, -1.02]), ("3", 1, [2], [3]), ("t*t", 0, [3], [9])):
            for found, known in zip(integrals(text, begin, times), expected, strict=True):
                self.assertAlmostEqual(found, known, 12)
        for none in ("x*t", "log(-1 - t)"):
            self.assertIsNone(integrals(none, 0, [1]), none)

    def test_of_the_names_of_a_study(self):
        self.assertAlmostEqual(value_of("0.3*50e6*density^1.5", {"density": 0.25}), 0.3 * 50e6 * 0.125)
        self.assertEqual(value_of("value*2", {"value": 4}), 8)
        self.assertIsNone(value_of("velocty", {"velocity": 4}))


if __name__ == "__main__":
    unittest.main()
