"""The language of a deck's expressions (src/base/math/expression_parser.cpp, inputs/KEYS.md) for tools in Python:
arithmetic, comparisons, functions, or statements that assign to `value`. Parsed to functions of a {name: number};
nothing is executed that is not defined here."""
import math
import re

import numpy as np

DEEPEST = 100  # nesting of brackets, signs and blocks
RANKS = {"||": 0, "&&": 1, "==": 2, "!=": 2, "<=": 3, ">=": 3, "<": 3, ">": 3, "+": 4, "-": 4, "*": 5, "/": 5}
OPERATIONS = {"||": lambda a, b: float(a != 0 or b != 0), "&&": lambda a, b: float(a != 0 and b != 0),
              "==": np.equal, "!=": np.not_equal, "<=": np.less_equal, ">=": np.greater_equal, "<": np.less,
              ">": np.greater, "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": np.power}


def without_exceptions(function):
    """The result of the C library for arguments for which Python raises an exception."""
    def of(x):
        try:
            return function(x)
        except OverflowError:
            return math.inf
        except ValueError:
            return math.nan
    return of


def bessel(order, wave):
    """(1/π)∫ wave(τ, x) dτ from 0 to π, for Bessel functions of integer order; midpoints converge exponentially."""
    def of(x):
        if math.isnan(x):
            return x
        points = 64 + 2 * math.ceil(min(abs(x), 1e6))
        angle = (np.arange(points) + 0.5) * math.pi / points
        return wave(angle, x, order).mean()
    return of


def ordinary(angle, x, n):
    return np.cos(n * angle - x * np.sin(angle)) if math.isfinite(x) else np.zeros_like(angle)


def modified(angle, x, n):
    return np.exp(x * np.cos(angle)) * np.cos(n * angle)


FUNCTIONS = {
    "fabs": np.fabs, "sqrt": np.sqrt, "exp": np.exp, "log": np.log, "log10": np.log10, "sin": np.sin, "cos": np.cos,
    "tan": np.tan, "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "sinh": np.sinh, "cosh": np.cosh,
    "tanh": np.tanh, "pow": np.power, "atan2": np.arctan2, "erf": math.erf, "erfc": math.erfc,
    "gamma": without_exceptions(math.gamma), "j0": bessel(0, ordinary), "j1": bessel(1, ordinary),
    "i0": bessel(0, modified), "i1": bessel(1, modified)}
OF_TWO = ("pow", "atan2")
TYPES = ("double", "float", "int")

# Numbers, names and operators, with blanks in between.
TOKEN = re.compile(r"\s*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?![\w.]))|([A-Za-z_]\w*)|(\|\||&&|[=!<>]=|[-+*/^<>=!(),;{}]))", re.A)


class NoExpression(Exception):
    """Position and description of an error, for a user."""


def compiled(text, names):
    """A function of a {name: number}, with a number for each of the names; raises NoExpression."""
    try:
        return Parser(text, names).parse()
    except RecursionError:
        raise NoExpression("too many brackets and signs within each other") from None


def evaluated(expression, numbers):
    """Evaluates as the program does: undefined arithmetic gives nan or infinity."""
    with np.errstate(all="ignore"):
        return float(expression({name: np.float64(number) for name, number in numbers.items()}))


class Parser:
    def __init__(self, text, names):
        self.tokens, self.at, self.depth = tokens_of(text), 0, 0
        self.given, self.whole = set(names), {"value": False}  # variables that can be assigned to; True for an int

    def parse(self):
        if ("name", "value") in self.tokens and "value" not in self.given:
            steps = []
            while self.coming() is not None:
                steps.append(self.statement())
            return lambda v: value_after(steps, v, self.whole)
        whole = self.binary(0)
        if self.coming() is not None:
            self.fail("an operator")
        return whole

    # ---- tokens

    def coming(self):
        return self.tokens[self.at][1] if self.at < len(self.tokens) else None

    def kind(self):
        return self.tokens[self.at][0] if self.at < len(self.tokens) else None

    def take(self, token):
        found = self.coming() == token
        self.at += found
        return found

    def expect(self, token):
        if not self.take(token):
            self.fail(f"'{token}'")

    def name(self):
        if self.kind() != "name":
            self.fail("a name")
        self.at += 1
        return self.tokens[self.at - 1][1]

    def fail(self, expected):
        found = "the end" if self.coming() is None else f"'{self.coming()}'"
        raise NoExpression(f"expected {expected}, found {found}")

    def within(self, part):
        """A nested part."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise NoExpression(f"more than {DEEPEST} brackets or signs within each other")
        found = part()
        self.depth -= 1
        return found

    # ---- statements: functions that change the variables

    def statement(self):
        if self.take("if"):
            return self.within(self.condition)
        if self.coming() in TYPES:
            return self.declaration(self.name() == "int")
        name = self.name()
        if name not in self.whole:
            self.at -= 1
            self.fail("a variable that can be assigned to")
        return self.assignment(name)

    def declaration(self, whole):
        name = self.name()
        if name in self.given or name in self.whole or name in FUNCTIONS:
            raise NoExpression(f"the name '{name}' is taken")
        self.whole[name] = whole
        if self.coming() == "=":
            return self.assignment(name)
        self.end_statement()
        return lambda v: v.__setitem__(name, np.float64(0))

    def assignment(self, name):
        self.expect("=")
        number = self.binary(0)
        self.end_statement()
        if self.whole[name]:
            return lambda v: v.__setitem__(name, np.trunc(number(v)))
        return lambda v: v.__setitem__(name, number(v))

    def end_statement(self):
        if self.coming() is not None:
            self.expect(";")

    def condition(self):
        self.expect("(")
        asked = self.binary(0)
        self.expect(")")
        then, otherwise = self.within(self.block), []
        if self.take("else"):
            otherwise = [self.within(self.condition)] if self.take("if") else self.within(self.block)
        return lambda v: run(then if asked(v) != 0 else otherwise, v)

    def block(self):
        self.expect("{")
        steps = []
        while self.coming() not in ("}", None):
            steps.append(self.statement())
        self.expect("}")
        return steps

    # ---- expressions: functions that return a number

    def binary(self, rank):
        first, others = self.within(self.power), []
        while RANKS.get(self.coming(), -1) >= rank:
            token = self.coming()
            self.at += 1
            others.append((OPERATIONS[token], self.binary(RANKS[token] + 1)))
        return chained(first, others) if others else first

    def power(self):
        signs = []
        while self.coming() in ("-", "+", "!"):
            signs.append(self.coming())
            self.at += 1
        base = self.primary()
        if "-" in signs or "!" in signs:
            if self.coming() == "^":
                raise NoExpression("write -(a^b) or (-a)^b: which of the two is meant?")
            base = signed(signs[::-1], base)
        return combined(OPERATIONS["^"], base, self.within(self.power)) if self.take("^") else base

    def primary(self):
        kind, word = self.kind(), self.coming()
        if kind == "number":
            self.at += 1
            return constant(word)
        if kind == "name":
            return self.named(self.name())
        if not self.take("("):
            self.fail("a number, a name or '('")
        inside = self.binary(0)
        self.expect(")")
        return inside

    def named(self, word):
        if self.take("("):
            return self.call(word)
        if word not in self.given and word not in self.whole:
            raise NoExpression(f"'{word}' is not a variable" + (" but a function" if word in FUNCTIONS else ""))
        return lambda v: v[word]

    def call(self, word):
        if word not in FUNCTIONS:
            raise NoExpression(f"there is no function '{word}'; there are {', '.join(FUNCTIONS)}")
        function, first = FUNCTIONS[word], self.binary(0)
        if word in OF_TWO:
            self.expect(",")
            first = combined(function, first, self.binary(0))
            self.expect(")")
            return first
        self.expect(")")
        return lambda v: np.float64(function(first(v)))


def tokens_of(text):
    """A list of (kind, word)."""
    found, at = [], 0
    text = text.rstrip()
    while at < len(text):
        match = TOKEN.match(text, at)
        if match is None:
            raise NoExpression(f"at character {at + 1}, '{text[at:at + 20].strip()}' cannot be read")
        found.append((("number", "name", "sign")[match.lastindex - 1], match[match.lastindex]))
        at = match.end()
    return found


def constant(word):
    number = np.float64(word)
    if not np.isfinite(number):
        raise NoExpression(f"'{word}' is more than a double can hold")
    return lambda v: number


def combined(operation, left, right):
    return lambda v: np.float64(operation(left(v), right(v)))


def chained(first, others):
    """Evaluates from left to right; a loop, because sums may have thousands of terms."""
    def of(v):
        number = first(v)
        for operation, right in others:
            number = np.float64(operation(number, right(v)))
        return number
    return of


def signed(signs, base):
    def of(v):
        number = base(v)
        for sign in signs:
            number = np.float64(number == 0) if sign == "!" else -number if sign == "-" else number
        return number
    return of


def run(steps, variables):
    for step in steps:
        step(variables)


def value_after(steps, given, own):
    variables = {**given, **dict.fromkeys(own, np.float64(0))}  # 0, also if the branch of a declaration is not taken
    run(steps, variables)
    return variables["value"]
