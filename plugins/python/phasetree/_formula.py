"""Formulas in x, y and z: arithmetic whose result is a field."""

from __future__ import annotations

import numbers

from phasetree import _registry
from phasetree._errors import Error
from phasetree._values import Value

#: The functions that formulas may call, with the minimum and maximum number of arguments; None for no maximum.
FUNCTIONS = {
    "sqrt": (1, 1),
    "abs": (1, 1),
    "min": (2, None),
    "max": (2, None),
    "sin": (1, 1),
    "cos": (1, 1),
    "tan": (1, 1),
    "exp": (1, 1),
    "tanh": (1, 1),
    "length": (2, 3),
    "clamp": (3, 3),
    "smooth_min": (3, 3),
    "smooth_max": (3, 3),
    "square": (1, 1),
}

# NumPy's functions that map to functions of formulas: np.sqrt(x) of an expression x is an expression.
_UFUNCS = {
    "add": "+",
    "subtract": "-",
    "multiply": "*",
    "divide": "/",
    "true_divide": "/",
    "power": "^",
    "negative": "negate",
    "absolute": "abs",
    "fabs": "abs",
    "minimum": "min",
    "maximum": "max",
    "hypot": "length",
    **{name: name for name in ("sqrt", "sin", "cos", "tan", "exp", "tanh", "square")},
}


class Expression(Value):
    """A formula in x, y and z. Immutable.

    It can be used wherever a field is expected, as in glass(x**2 + y**2 - 1); the solid is where the formula is
    negative. within(low, high) cuts the solid to a box. Formulas whose slope grows without bound need this. Formulas
    are evaluated in the precision of the call: double in locate, crossings and so on, otherwise single. When the field
    is made, an upper bound on the slope is determined, and the formula is divided by it.
    """

    __slots__ = ("_bounds", "_field", "_height", "_of", "_what")

    def __init__(self, what, of=(), bounds=None):
        self._what = what  # the text of a leaf, an operator, or a function's name
        self._of = of
        self._bounds = bounds
        self._field = None
        self._height = 1 + max((e._height for e in of), default=0)

    def _pickled(self):
        # A list, because pickle would recurse as deep as the formula.
        order = _Writer(self).order
        number = {id(one): i for i, one in enumerate(order)}
        return (tuple((one._what, tuple(number[id(e)] for e in one._of), one._bounds) for one in order),)

    @classmethod
    def _unpickled(cls, parts):
        made = []
        for what, of, bounds in parts:
            made.append(cls(what, tuple(made[i] for i in of), bounds))
        return made[-1]

    @property
    def text(self):
        """The formula as text for a scene file."""
        return _Writer(self).text()

    def within(self, low, high):
        """The same formula, cut to a box. Each corner is a point, or a number for three equal coordinates."""
        corners = tuple(tuple(c) if hasattr(c, "__iter__") else (c, c, c) for c in (low, high))
        return Expression(self._what, self._of, corners)

    def field(self):
        """The formula as a field. Raises Error, with the position in the formula, if the slope has no bound."""
        if self._field is None:
            self._field = _registry.functions["formula"](self.text, self._bounds)
        return self._field

    def _with(self, sign, other, swapped=False):
        if isinstance(other, tuple(_registry.classes.values())):
            if sign != "-" or isinstance(other, _registry.classes["Object"]):
                return NotImplemented
            raise TypeError(
                "formula - field is ambiguous: a number or a difference of solids? For the difference, write "
                "formula.field() - field"
            )
        other = expression(other)
        return NotImplemented if other is None else Expression(sign, (other, self) if swapped else (self, other))

    def __add__(self, other):
        return self._with("+", other)

    def __radd__(self, other):
        return self._with("+", other, True)

    def __sub__(self, other):
        return self._with("-", other)

    def __rsub__(self, other):
        return self._with("-", other, True)

    def __mul__(self, other):
        return self._with("*", other)

    def __rmul__(self, other):
        return self._with("*", other, True)

    def __truediv__(self, other):
        return self._with("/", other)

    def __rtruediv__(self, other):
        return self._with("/", other, True)

    def __pow__(self, other):
        if not isinstance(other, numbers.Real):
            raise Error(f"an exponent must be a number, but is {other!r}")
        return self._with("^", other)

    def __neg__(self):
        return Expression("negate", (self,))

    def __pos__(self):
        return self

    def __abs__(self):
        return Expression("abs", (self,))

    def __or__(self, other):
        return self.field() | other

    def __and__(self, other):
        return self.field() & other

    def __eq__(self, other):
        return isinstance(other, Expression) and self._bounds == other._bounds and self.text == other.text

    def __hash__(self):
        return hash(self.text)

    def __bool__(self):
        raise TypeError("a formula has no truth value; use pt.min or pt.max to choose between numbers")

    def __array_ufunc__(self, ufunc, method, *inputs, **options):
        name = _UFUNCS.get(ufunc.__name__)
        if method != "__call__" or options or name is None:
            return NotImplemented
        of = tuple(expression(i) for i in inputs)
        return NotImplemented if None in of else Expression(name, of)

    def __getattr__(self, name):
        # An expression can be used wherever a field can, so it has the methods of fields, too.
        if name.startswith("_"):
            raise AttributeError(name)
        if not hasattr(_registry.classes["Field"], name):
            raise AttributeError(f"a formula has no {name!r}")
        return getattr(self.field(), name)

    def __repr__(self):
        text = self.text
        return f"<Expression {text if len(text) <= 100 else text[:97] + '…'}>"


def expression(value):
    """Converts a number to an expression; returns expressions unchanged, and None for anything else."""
    if isinstance(value, Expression):
        return value
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        number = float(value)
        if number != number or number in (float("inf"), float("-inf")):
            raise Error(f"a formula's numbers must be finite, but one is {number}")
        text = repr(int(number)) if number == int(number) and abs(number) < 1e15 else repr(number)
        return Expression(text if number >= 0 else f"({text})")
    return None


class _Writer:
    """Writes an expression as text. Subexpressions that are used more than once, or nested deeply, get a name."""

    deepest = 20  # expressions nested more deeply get a name

    def __init__(self, root):
        self.order, self.uses, self.names, self.levels = [], {}, {}, {}
        open_, seen = [(root, False)], set()
        while open_:
            one, is_done = open_.pop()
            if is_done:
                self.order.append(one)
                continue
            self.uses[id(one)] = self.uses.get(id(one), 0) + 1
            if id(one) in seen:
                continue
            seen.add(id(one))
            open_.append((one, True))
            open_ += [(e, False) for e in reversed(one._of)]
        self.root = root

    def text(self):
        texts, lines = {}, []
        for one in self.order:
            text = self.joined(one, [texts[id(e)] for e in one._of])
            level = 1 + max((self.levels[id(e)] for e in one._of), default=0)
            if one is not self.root and one._of and (self.uses[id(one)] > 1 or level >= self.deepest):
                name = f"v{len(lines) + 1}"
                lines.append(f"{name} = {text}; ")
                text, level = name, 0
            texts[id(one)], self.levels[id(one)] = text, level
        text = texts[id(self.root)]
        if self.root._what in ("+", "-", "*", "/", "negate") and self.root._of:
            text = text[1:-1]
        return "".join(lines) + text

    @staticmethod
    def joined(one, of):
        if not of:
            return one._what
        if one._what == "negate":
            return f"(-{of[0]})"
        if one._what == "^":
            return f"{of[0]}^{of[1].strip('()')}"
        if one._what in "+-*/":
            return f"({of[0]} {one._what} {of[1]})"
        return f"{one._what}({', '.join(of)})"


def coordinates():
    """The expressions x, y and z, from which formulas are built: x, y, z = pt.coordinates()."""
    return Expression("x"), Expression("y"), Expression("z")


def _function(name, least, most):
    def apply(*values):
        if len(values) < least or (most is not None and len(values) > most):
            counts = least if least == most else f"{least} or more" if most is None else f"{least} or {most}"
            raise TypeError(f"{name} takes {counts} numbers")
        of = tuple(expression(v) for v in values)
        if None in of:
            raise Error(f"{name} takes numbers and expressions of pt.coordinates(), not {values[of.index(None)]!r}")
        return Expression(name, of)

    apply.__name__ = apply.__qualname__ = name
    apply.__doc__ = f"The function {name} of formulas: see pt.formula."
    apply.__module__ = "phasetree"
    return apply


functions = {name: _function(name, *count) for name, count in FUNCTIONS.items()}
