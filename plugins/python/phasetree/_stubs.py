"""Writes the type stubs with which editors complete and check calls: python3 -m phasetree._stubs > __init__.pyi.

Stubs of generated functions come from the same lists as the functions. Functions written by hand keep their own
signatures, without types.
"""

from __future__ import annotations

import inspect
import textwrap

from phasetree import _formula, _parts, _placed, _scene, _solve, _trees, _view

_TYPES = {
    "number": "float",
    "whole number": "int",
    "true or false": "bool",
    "text": "str",
    "name of a file": "str | PathLike[str]",
    "field": "Field | Expression",
    "object": "Object",
    "phase": "Phase | str",
    "phase or list of phases": "Phase | str | Sequence[Phase | str]",
    "list of phases": "Sequence[Phase | str]",
    "colour": "Sequence[float] | str",
    "colour or texture": "Sequence[float] | str | Texture",
    "number or field": "float | Number",
    "list of [number, number]": "Sequence[Sequence[float]] | np.ndarray",
    "list of [number, colour or texture]": "Sequence[Sequence[float | str | Sequence[float] | Texture]]",
    "opaque material": "Material",
    "normal map": "NormalMap",
    "phase function": "PhaseFunction",
    "voxels": "Voxels",
    "list of fields": "Field | Expression | Sequence[Field | Expression]",
    "list of objects": "Object | Sequence[Object]",
}
_CLASSES = {
    "Materials": "Material",
    "Textures": "Texture",
    "Number textures": "Number",
    "Normal maps": "NormalMap",
    "Phase functions": "PhaseFunction",
    "Voxel grids": "Voxels",
    "Lights": "Light",
    "Meshes": "Mesh",
    "Cameras": "Camera",
    "Render settings": "ImageSettings",
}


def _type(name):
    if name in _TYPES:
        return _TYPES[name]
    if name.startswith("number or "):
        return "float | Sequence[float]"
    if name.startswith("list of ["):
        return "Sequence[Sequence[float]] | np.ndarray"
    if name == "list of numbers":
        return "Sequence[float] | np.ndarray"
    if name.startswith("["):
        return "Sequence[float] | np.ndarray"
    if name.startswith("`"):
        return "Literal[" + ", ".join(n.strip("` ") for n in name.split(",")) + "]"
    raise ValueError(f"no type of Python is known for {name!r}")


def _arguments(kind, first=None):
    """The parameters in a stub. For a method, `first` is the type of the first parameter, which is `self`."""
    parts = ["self"] if first else []
    for p, argument in zip(kind.parameters, kind.signature().parameters.values()):
        if first and p is kind.parameters[0]:
            if p is kind.many:
                parts.append(f"*{argument.name}: {first}")
            continue
        star = "*" if p is kind.many else ""
        optional = " | None = ..." if p.optional else ""
        python_type = "str | Expression" if (kind.name, p.name) == ("formula", "text") else _type(p.type)
        parts.append(f"{star}{argument.name}: {python_type}{optional}")
    return ", ".join(parts)


def _function(name, kind, result, indent="", first=None, doc=True):
    head = f"{indent}def {name}({_arguments(kind, first)}) -> {result}:"
    if not doc:
        return head + " ...\n"
    lines = textwrap.indent(f'r"""{kind.doc}\n"""', indent + "    ")
    return f"{head}\n{lines}\n"


def _overloads(name, function, indent="", method_of=None):
    """The stub of a function, or two overloads if it maps fields to fields and objects to objects."""
    results = [t for t in function.makes if method_of is None or len(function.makes) == 1 or t is method_of]
    text = ""
    for result in results:
        line = _function(name, function.kind, result.__name__, indent, method_of and method_of.__name__)
        if len(function.makes) == 2:
            of = result.__name__
            line = line.replace("of: Object", f"of: {of}", 1)
            if len(results) == 2:
                line = f"{indent}@overload\n" + line
        text += line
    return text


def _plain(member, indent="    "):
    """The stub of a function written by hand: its signature and its documentation."""
    is_property = isinstance(member, property)
    function = member.fget if is_property else member
    doc = inspect.getdoc(function)
    text = f"{indent}@property\n" if is_property else ""
    text += f"{indent}def {function.__name__}{_untyped(inspect.signature(function))}:"
    return text + (f'\n{indent}    r"""{doc}"""\n' if doc else " ...\n")


def _untyped(signature):
    """The signature with its defaults replaced by `...`."""
    parameters = [
        p if p.default is inspect.Parameter.empty else p.replace(default=...) for p in signature.parameters.values()
    ]
    return str(signature.replace(parameters=parameters)).replace("Ellipsis", "...")


_NUMBER = "Expression | float"
_OPERATORS = ("__or__", "__and__", "__sub__")


def _class(cls, methods=""):
    text = f"class {cls.__name__}:\n" + textwrap.indent(f'r"""{inspect.getdoc(cls)}"""', "    ") + "\n"
    for name, member in vars(cls).items():
        is_generated = name in _trees.functions
        is_said = not name.startswith("_") or (name == "__init__" and cls in (_scene.Scene, _scene.Image, _view.View))
        if is_said and not is_generated and (inspect.isfunction(member) or isinstance(member, property)):
            text += _plain(member)
    if cls is _trees.Field:
        for name in _OPERATORS:
            text += f"    def {name}(self, other: Field | Expression) -> Field: ...\n"
    for name, kind in getattr(cls, "__annotations__", {}).items():
        text += f"    {name}: {getattr(kind, '__forward_arg__', kind)}\n"  # NamedTuple stores forward references
    return text + methods


def _methods(cls):
    text = ""
    for name, function in _trees.functions.items():
        if vars(cls).get(name) is function:
            text += _overloads(name, function, "    ", cls)
    return text


def text():
    """The text of the stub file."""
    out = '"""Written by python3 -m phasetree._stubs from the library\'s lists; see plugins/python/README.md."""\n\n'
    out += "from os import PathLike\nfrom typing import Any, Literal, NamedTuple, Sequence, overload\n\n"
    out += "import numpy as np\n\n__version__: str\nbuild_id: str\n\n"
    out += "class Error(ValueError): ...\n\nclass SceneError(Error):\n    file: str\n    line: int\n    column: int\n"
    out += "    message: str\n    suggestion: str | None\n\n"
    out += "class Interrupted(KeyboardInterrupt):\n    result: Any\n\n"
    for name in _CLASSES.values():
        out += f"class {name}:\n    kind: str\n    def parameters(self) -> dict[str, Any]: ...\n\n"
    out += "class Phase:\n    name: str\n    material: Material | None\n    density: float | None\n"
    out += "    def __call__(self, *fields: Field | Expression) -> Object: ...\n\n"
    out += "vacuum: Phase\n\ndef phase(name: str, material: Material | None = ..., density: float | None = ...) -> Phase: ...\n\n"
    for cls in (_trees.Crossings, _trees.Hits, _trees.NextCrossings, _trees.Closest, _trees.PhaseMesh, _trees.Measures, _trees.Proof, _solve.Solution):
        out += _class(cls).replace(f"class {cls.__name__}:", f"class {cls.__name__}(NamedTuple):") + "\n"
    out += _class(_trees.Field, _methods(_trees.Field)) + "\n"
    out += "".join(["class Object:\n    phases: tuple[Phase, ...]\n", _class(_trees.Object).split("\n", 1)[1]])
    out += _methods(_trees.Object) + "\n"
    out += _class(_scene.Image) + "\n" + _class(_scene.Scene) + "\n"
    out += "class Instances:\n    of: str\n    transforms: np.ndarray\n    def __len__(self) -> int: ...\n\n"
    out += "def instances_of(of: str, transforms: Sequence[float] | Sequence[Sequence[float]] | np.ndarray) -> Instances:\n"
    out += textwrap.indent(f'r"""{inspect.getdoc(_placed.instances_of)}"""', "    ") + "\n\n"
    out += _class(_view.View) + "    url: str\n    file: str\n    def __enter__(self) -> View: ...\n"
    out += "    def __exit__(self, *_: object) -> None: ...\n\n"
    out += "def view(what: Object | Scene, *, width: int | None = ..., samples: int | None = ..., threads: int = ..., "
    out += "port: int = ..., open: bool | None = ...) -> View:\n"
    out += textwrap.indent(f'r"""{inspect.getdoc(_view.view)}"""', "    ") + "\n\n"
    out += _class(_formula.Expression)
    for name in ("add", "radd", "sub", "rsub", "mul", "rmul", "truediv", "rtruediv"):
        out += f"    def __{name}__(self, other: {_NUMBER}) -> Expression: ...\n"
    out += "    def __pow__(self, other: float) -> Expression: ...\n"
    out += "    def __neg__(self) -> Expression: ...\n    def __abs__(self) -> Expression: ...\n"
    out += "    def __or__(self, other: Field | Expression) -> Field: ...\n"
    out += "    def __and__(self, other: Field | Expression) -> Field: ...\n\n"
    out += "def coordinates() -> tuple[Expression, Expression, Expression]: ...\n\n"
    for name in _formula.functions:
        out += f"def {name}(*values: {_NUMBER}) -> Expression: ...\n"
    out += "\n" + _plain(_solve.solve, "")
    doc = textwrap.indent(f'r"""{inspect.getdoc(_scene.load)}\n"""', "    ")
    out += f"\ndef load(path: str | PathLike[str]) -> Scene:\n{doc}\n\n"
    for name, function in _trees.functions.items():
        out += _overloads(name, function) + "\n"
    for title, kinds in _parts.kinds.items():
        if title in ("Render settings", "Normal maps", "Voxel grids"):
            out += _function(kinds[0].name if title != "Render settings" else "image", kinds[0], _CLASSES[title]) + "\n"
            continue
        out += f"class {_parts.module_name(title)}:\n"
        for kind in kinds:
            out += "    @staticmethod\n" + _function(kind.name, kind, _CLASSES[title], "    ")
        out += "\n"
        for kind in kinds if title == "Materials" else ():
            out += _function(kind.name, kind, _CLASSES[title]) + "\n"
        if title == "Cameras":
            out += _function("camera", kinds[0], _CLASSES[title]) + "\n"
    return out


if __name__ == "__main__":
    print(text(), end="")
