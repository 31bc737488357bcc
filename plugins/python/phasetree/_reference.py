"""The kinds of nodes, materials and other parts that the library lists: how to call, document and write them."""

from __future__ import annotations

import difflib
import inspect
import json
import keyword
import math
import numbers
import os

from phasetree import _phasetree
from phasetree._errors import Error
from phasetree._paths import path_text

_HANDLES = ("field", "object", "list of fields", "list of objects")


def python_name(name):
    """A parameter's name in Python: with a trailing underscore if it is a keyword."""
    return name + "_" if keyword.iskeyword(name) else name


def _american(name):
    """The name in American spelling."""
    return name.replace("colour", "color").replace("centre", "center")


class Parameter:
    """A parameter of a kind: its description in the library's list, and how it is passed."""

    def __init__(self, page):
        self.name = page["name"]
        self.python_name = python_name(self.name)
        self.type = page["type"]
        self.unit = page["unit"]
        self.description = page["description"]
        self.limits = page["limits"]
        self.optional = page["optional"]
        self.written_default = page["default"]
        self.is_handle = self.type in _HANDLES
        self.is_list = self.type.startswith("list of ")

    @property
    def default(self):
        """The default as a Python value; None for a default that is described by a word, such as "all"."""
        try:
            value = json.loads(self.written_default)
        except ValueError:
            return None
        return tuple(value) if isinstance(value, list) else value

    @property
    def text(self):
        parts = [self.type + (f" in {self.unit}" if self.unit else ""), self.limits]
        if self.optional:
            parts.append(f"default {self.written_default}")
        return f"{self.python_name}: {self.description} ({'; '.join(p for p in parts if p)})"


class Kind:
    """A kind of node or part. In Python, parameters that are fields or objects come first."""

    def __init__(self, chapter, page):
        self.chapter = chapter
        self.name = page["name"]
        self.section = page["section"]
        self.equation = page["equation"]
        self.summary = page["summary"]
        listed = [Parameter(p) for p in page["parameters"]]
        required = [p for p in listed if not p.optional]
        self.parameters = [p for p in required if p.is_handle] + [p for p in required if not p.is_handle]
        self.parameters += [p for p in listed if p.optional]
        # A required list of fields or objects, which may be passed as separate arguments: union(a, b, c).
        self.many = next((p for p in self.parameters if p.is_handle and p.is_list and not p.optional), None)

    @property
    def doc(self):
        text = self.summary
        if self.equation:
            text += f"\n\n    {self.equation}"
        if self.section:
            *first, last = self.section.split(", ")
            sections = f"Sections {', '.join(first)} and {last}" if first else f"Section {last}"
            text += f"\n\n{sections} of Galin et al. (2026)."
        return text + "\n\n" + "\n".join(p.text for p in self.parameters)

    def signature(self):
        seen_many = False
        arguments = []
        for p in self.parameters:
            how = inspect.Parameter.KEYWORD_ONLY if seen_many else inspect.Parameter.POSITIONAL_OR_KEYWORD
            if p is self.many:
                how, seen_many = inspect.Parameter.VAR_POSITIONAL, True
            default = p.default if p.optional else inspect.Parameter.empty
            arguments.append(inspect.Parameter(p.python_name, how, default=default))
        return inspect.Signature(arguments)

    def _unnamed(self, arguments):
        """Pairs positional arguments with their parameters, up to the parameter that takes any number of arguments."""
        first = self.parameters[: self.parameters.index(self.many)] if self.many else self.parameters
        return zip(first, arguments)

    def _in_known_spelling(self, named, known):
        """The same arguments, with names in the other spelling, British or American, replaced by the known ones."""
        names = {_american(name): name for name in known}
        result = {}
        for name, value in named.items():
            name = name if name in known else names.get(_american(name), name)
            if name in result:
                raise TypeError(f'{self.name}: "{name}" is given twice, in two spellings')
            result[name] = value
        return result

    def bound(self, signature, arguments, named):
        """The arguments of a call as {parameter: value}. Raises TypeError or Error if they do not fit."""
        if self.many and self.many.python_name in named:
            raise Error(f'{self.name}: pass its fields or objects as positional arguments: {self.name}(a, b, …)')
        known = {p.python_name: p for p in self.parameters}
        for p, value in (*self._unnamed(arguments), *((known.get(name), value) for name, value in named.items())):
            # For translate(1, 2, 3), report that the vector must be one list, instead of the parameters to which 2 and
            # 3 would be bound.
            if p and p.type.startswith("[") and isinstance(value, numbers.Real):
                raise Error(f'{self.name}: "{p.name}" must be {p.type} as one list or tuple, but is {value!r}')
        named = self._in_known_spelling(named, known)
        for name in named:
            if name not in known:
                close = difflib.get_close_matches(name, known, 1)
                meant = f' (did you mean "{close[0]}"?)' if close else ""
                raise TypeError(f'{self.name}: there is no parameter "{name}"{meant}; it has {", ".join(known)}')
        try:
            given = signature.bind(*arguments, **named).arguments
        except TypeError as error:
            raise TypeError(f"{self.name}: {error}") from None
        values = {}
        for p in self.parameters:
            if p.python_name not in given:
                continue
            value = given[p.python_name]
            if p is self.many and len(value) == 1 and isinstance(value[0], (list, tuple)):
                value = value[0]
            if value is None and p.optional:
                continue
            values[p] = value
        return values


def chapters():
    """The chapters of the reference, as a list of (title, list of kinds)."""
    return [(c["title"], [Kind(c["title"], page) for page in c["kinds"]]) for c in _phasetree.chapters()]


def written(value, what):
    """Converts a value to JSON. NumPy arrays become lists."""
    if isinstance(value, (str, bool)) or value is None:
        return value
    if hasattr(value, "text") and hasattr(value, "within"):
        return value.text  # a formula; tested first, because it also has the attributes of fields, such as written()
    if hasattr(value, "written"):
        return value.written()
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, int):
        return value
    if isinstance(value, float):
        if not math.isfinite(value):
            raise Error(f"{what} must be a finite number, but is {value}")
        return value
    if isinstance(value, dict):
        return {key: written(v, what) for key, v in value.items()}
    if isinstance(value, os.PathLike):
        return path_text(value)
    try:
        items = list(value)
    except TypeError:
        raise Error(f"{what} cannot be {value!r}") from None
    return [written(item, what) for item in items]


def moves(value):
    """Whether a JSON value changes with time, that is, contains {"keys": [[seconds, value], …]}."""
    if isinstance(value, dict):
        return isinstance(value.get("keys"), list) or any(moves(v) for v in value.values())
    return isinstance(value, list) and any(moves(v) for v in value)


def check_still(value, what):
    """Rejects keyframes ("keys") where they would be lost.

    The library reads a tree at one time, so its nodes cannot keep keyframes.
    """
    if moves(value):
        raise Error(
            f"{what} has keys, but trees and transforms made in Python do not move. Make one scene per time, or write "
            "the scene file by hand: the command renders it with --at and --frames"
        )


def file_name(value):
    """The absolute name of a file. Raises Error if it is not UTF-8."""
    name = os.path.abspath(path_text(value))
    try:
        name.encode()
    except UnicodeEncodeError:
        raise Error(f"scene files are UTF-8, so they cannot name the file {os.fsencode(name)!r}; rename it") from None
    return name
