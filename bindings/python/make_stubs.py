"""Writes the type stubs of the extension, calligraphy/_calligraphy.pyi, from the module itself.

usage: python make_stubs.py [--check]     needs pybind11-stubgen and a module built with pybind11 3
What pybind11-stubgen finds is made shorter: enumerations and records by their members alone.
"""

from __future__ import annotations

import ast
import pathlib
import re
import subprocess
import sys
import tempfile

HEADER = '''"""The C++ library. Written by make_stubs.py; docstrings are in the module."""

import builtins
import collections.abc
import os
import typing

import numpy
import numpy.typing

_Self = typing.TypeVar("_Self")

class _Enumeration:
    __members__: typing.ClassVar[dict[str, typing.Any]]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __index__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...
    def __ne__(self, other: object) -> bool: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

'''
#: Of every class; what they do needs no types.
UNTOLD = {
    "__copy__", "__deepcopy__", "__eq__", "__getstate__", "__hash__", "__reduce__", "__reduce_ex__", "__repr__",
    "__setstate__",
}  # fmt: skip


#: What signatures in docstrings cannot say, and how a person would write it.
TYPES = {
    "typing.SupportsFloat | typing.SupportsIndex": "float",
    "typing.SupportsInt | typing.SupportsIndex": "int",
    "os.PathLike | str | bytes": "str | os.PathLike[str]",
    "method: typing.Any": "method: str | NearestPointMethod",
    "progress: collections.abc.Callable[[float], None]=": "progress: collections.abc.Callable[[float], None] | None=",
    "law: collections.abc.Callable,": "law: collections.abc.Callable[[DeviceState], numpy.typing.ArrayLike],",
    "times: typing.Any=": "times: numpy.typing.ArrayLike | None=",
    "samples: typing.Any": "samples: numpy.typing.ArrayLike",
    "t: typing.Any) -> typing.Any": "t: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]",
    "character: typing.Any": "character: Character",
    "stop: collections.abc.Callable[[], bool]=": "stop: collections.abc.Callable[[], bool] | None=",
    "watch: typing.Any=": "watch: collections.abc.Callable[[LiveView], object] | None=",
    "def __enter__(self) -> typing.Any:": "def __enter__(self: _Self) -> _Self:",
    "__exit__(self, *args)": "__exit__(self, *args: object)",
    "numpy.bool]": "numpy.bool_]",  # the other name is NumPy 2's alone
    "list[typing.Any]": "list[Stroke]",
    "def typical_strokes() -> list:": "def typical_strokes() -> list[TypicalStroke]:",
    "-> collections.abc.Iterator:": "-> collections.abc.Iterator[Character]:",
    "-> list:": "-> list[numpy.typing.NDArray[numpy.float64]]:",
}

#: The same of properties, by name and type.
PROPERTIES = {
    ("error", "typing.Any"): "BaseException | None",
    ("bytes", "bytes"): "builtins.bytes",  # within the class, bytes is the property
}


def simpler(text: str) -> str:
    for told, meant in TYPES.items():
        text = text.replace(told, meant)
    return re.sub(r"numpy\.ndarray(?!\[)", "numpy.typing.NDArray[numpy.void]", text)


def is_property(item: ast.stmt, kind: str) -> bool:
    if not isinstance(item, ast.FunctionDef):
        return False
    decorators = [ast.unparse(decorator) for decorator in item.decorator_list]
    return decorators == ["property"] if kind == "getter" else any(d.endswith(".setter") for d in decorators)


def function(item: ast.FunctionDef, indent: str) -> list[str]:
    item.body = [ast.Expr(ast.Constant(...))]
    lines = simpler(ast.unparse(item)).splitlines()
    return [indent + line for line in (*lines[:-2], lines[-2] + " ...")]


def enumeration(node: ast.ClassDef) -> list[str]:
    members = [
        item.target.id
        for item in node.body
        if isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name) and item.target.id != "__members__"
    ]
    extra = []
    if any(isinstance(item, ast.FunctionDef) and item.name == "__and__" for item in node.body):
        extra = [f"    def __{name}__(self, other: object) -> int: ..." for name in ("and", "or", "rand", "ror")]
    return [
        f"class {node.name}(_Enumeration):",
        *(f"    {member}: typing.ClassVar[{node.name}]" for member in members),
        *extra,
    ]


def annotation(setter: ast.FunctionDef | None, getter: ast.FunctionDef) -> tuple[str, str]:
    """Types as read and as written."""
    read = simpler(f"-> {ast.unparse(getter.returns)}:")[3:-1] if getter.returns else "typing.Any"
    written = read
    if setter is not None and setter.args.args[1].annotation is not None:
        written = simpler(ast.unparse(setter.args.args[1].annotation))
    return read, written


def class_(node: ast.ClassDef) -> list[str]:
    getters = {i.name: i for i in node.body if is_property(i, "getter")}
    setters = {i.name: i for i in node.body if is_property(i, "setter")}
    is_record = any(isinstance(i, ast.AnnAssign) and ast.unparse(i.target) == "fields" for i in node.body)
    bases = f"({', '.join(ast.unparse(base) for base in node.bases)})" if node.bases else ""
    lines = [f"class {node.name}{bases}:"]
    if any(isinstance(i, ast.FunctionDef) and i.name == "__eq__" for i in node.body):
        lines.append("    __hash__: typing.ClassVar[None]  # type: ignore[assignment]")
    if is_record:
        lines.append("    fields: typing.ClassVar[tuple[str, ...]]")
        words = [f"{n}: {annotation(setters.get(n), g)[1]} = ..." for n, g in getters.items()]
        lines.append(f"    def __init__(self, *, {', '.join(words)}) -> None: ...")
    for item in node.body:
        if not isinstance(item, ast.FunctionDef) or item.name in UNTOLD:
            continue
        if is_property(item, "setter") or (is_record and item.name == "__init__"):
            continue
        if is_property(item, "getter"):
            read, written = annotation(setters.get(item.name), item)
            read = PROPERTIES.get((item.name, read), read)
            if item.name in setters and read == written:
                lines.append(f"    {item.name}: {read}")
                continue
            lines += ["    @property", f"    def {item.name}(self) -> {read}: ..."]
            if item.name in setters:
                lines += [f"    @{item.name}.setter", f"    def {item.name}(self, value: {written}) -> None: ..."]
        else:
            lines += function(item, "    ")
    if node.name == "CharacterSet":  # has methods of these names
        lines = [re.sub(r"(?<!def )\b(list\[|bytes(?=[,)]))", r"builtins.\1", line) for line in lines]
        lines = [line.replace("(builtins.bytes", "(bytes") for line in lines]
    return lines if len(lines) > 1 else [lines[0] + " ..."]


def stubs() -> str:
    with tempfile.TemporaryDirectory() as directory:
        subprocess.run(
            [
                sys.executable, "-m", "pybind11_stubgen", "calligraphy._calligraphy", "-o", directory,
                "--enum-class-locations", ".*:calligraphy._calligraphy",
            ],
            check=True, capture_output=True,
        )  # fmt: skip
        tree = ast.parse((pathlib.Path(directory) / "calligraphy" / "_calligraphy.pyi").read_text(encoding="utf-8"))
    parts = []
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            text = ast.unparse(node)
            parts.append("\n".join(enumeration(node) if "__members__" in text else class_(node)))
        elif isinstance(node, ast.FunctionDef):
            parts.append("\n".join(function(node, "")))
    parts.append("__version__: str\nbackends: tuple[str, ...]")
    parts.append("sample_dtype: numpy.dtype[numpy.void]\ntick_dtype: numpy.dtype[numpy.void]")
    return HEADER + "\n".join(parts) + "\n"


if __name__ == "__main__":
    path = pathlib.Path(__file__).parent / "calligraphy" / "_calligraphy.pyi"
    if sys.argv[1:] == ["--check"]:
        sys.exit(0 if path.read_text(encoding="utf-8") == stubs() else f"{path} is not what the module says: run {__file__}")
    path.write_text(stubs(), encoding="utf-8")
