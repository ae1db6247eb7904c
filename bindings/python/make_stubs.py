"""usage: make_stubs.py MODULE_FILE STUB_FILE     writes type stubs with docstrings; CMakeLists.txt runs it."""

from __future__ import annotations

import ast
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

#: Replacements for types that signatures in docstrings cannot express.
TYPES = {
    r"typing\.SupportsFloat \| typing\.SupportsIndex": "float",
    r"typing\.SupportsInt \| typing\.SupportsIndex": "int",
    r"os\.PathLike(?!\[)": "os.PathLike[str]",
    r"\btuple(?=\]|:| =)": "tuple[typing.Any, ...]",
    r"\blist\[": "builtins.list[",  # a method named list hides the built-in
    r"\*args\)": "*args: object)",
    r"def write\(self, force: [\w.]+": "def write(self, force: typing.Any",  # subclasses override it with other types; called with an array
    r"numpy\.ndarray(?!\[)": "numpy.typing.NDArray[typing.Any]",
    r"\bdict\b(?=[\]:|])": "dict[str, typing.Any]",
    r"numpy\.bool\b": "numpy.bool_",
    r"def __enter__\(self\) -> \w+(\.\w+)?": "def __enter__(self: Self) -> Self",
    r"-> Any:": "-> typing.Any:",
    r"npt\.NDArray\[Any\]": "numpy.typing.NDArray[typing.Any]",
    r"def error\(self\) -> [\w.]+": "def error(self) -> BaseException | None",
}
MEMBERS = """
import calligraphy._calligraphy as module, enum
kinds = [kind for kind in vars(module).values() if isinstance(kind, enum.EnumMeta)]
print({kind.__name__: {member.name: member.value for member in kind} for kind in kinds})
"""
#: pybind11-stubgen prefers Python's signatures, which have no types, to the first lines of docstrings.
GENERATE = """
import inspect, pybind11_stubgen
def refuse(function): raise TypeError
inspect.getfullargspec = refuse
pybind11_stubgen.main()
"""


def added_methods(source: pathlib.Path) -> dict[str, list[ast.stmt]]:
    """Stubs of the functions that `@_method(cal.Class, "name")` makes methods, by class."""
    added: dict[str, list[ast.stmt]] = {}
    for item in ast.parse(source.read_text(encoding="utf-8")).body:
        for decorator in item.decorator_list if isinstance(item, ast.FunctionDef) else ():
            kind, name = decorator.args
            text = f"def {name.value}(self) -> {ast.unparse(item.returns)}: {ast.get_docstring(item, clean=False)!r}"
            added.setdefault(kind.attr, []).extend(ast.parse(text).body)
    return added


class Finish(ast.NodeTransformer):
    """Adds values to the members of enumerations, keywords to the constructors of structs and methods of _display.py."""

    def __init__(self, enumerations: dict[str, dict[str, int]], added: dict[str, list[ast.stmt]]) -> None:
        self.enumerations = enumerations
        self.added = added

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.ClassDef:
        node.body = [item for item in node.body if getattr(item, "name", "") != "__str__"]  # as every object has it
        functions = [item for item in node.body if isinstance(item, ast.FunctionDef)]
        if node.name in self.enumerations:
            members = "\n".join(f"{name} = {value}" for name, value in self.enumerations[node.name].items())
            node.body = [*node.body[:1], *ast.parse(members).body]
        fields = []
        for item in (i for i in node.body if ast.unparse(i).startswith("fields:")):
            names = ast.literal_eval(item.value)
            fields.append(names if isinstance(names, tuple) else (names,))  # pybind11-stubgen writes ("only") for ("only",)
            item.value = ast.parse(repr(fields[-1]), mode="eval").body
        if fields:
            types = {f.name: ast.unparse(f.args.args[1].annotation) for f in functions if len(f.args.args) == 2}
            words = ", ".join(f"{name}: {types[name]} = ..." for name in fields[0])
            made = next(item for item in functions if item.name == "__init__")
            made.args = ast.parse(f"def f(self, *, {words}): ...").body[0].args
        node.body += self.added.get(node.name, [])
        return node


def main(module: pathlib.Path, stub: pathlib.Path) -> None:
    with tempfile.TemporaryDirectory() as directory:
        package = pathlib.Path(directory) / "calligraphy"  # without the Python package, whose additions hide the signatures
        package.mkdir()
        (package / "__init__.py").touch()
        shutil.copy(module, package)
        paths = os.pathsep.join([directory, *filter(None, sys.path)])  # NumPy may be of an isolated build alone
        run = {"check": True, "env": {**os.environ, "PYTHONPATH": paths}, "cwd": directory, "text": True}
        told = subprocess.run([sys.executable, "-c", MEMBERS], stdout=subprocess.PIPE, **run).stdout
        words = ["-c", GENERATE, "calligraphy._calligraphy", "-o", ".", "--enum-class-locations", ".*:calligraphy._calligraphy"]
        subprocess.run([sys.executable, *words], stderr=subprocess.DEVNULL, **run)
        tree = ast.parse((package / "_calligraphy.pyi").read_text(encoding="utf-8"))
    enumerations = ast.literal_eval(told)
    added = added_methods(pathlib.Path(__file__).parent / "calligraphy" / "_display.py")
    text = ast.unparse(Finish(enumerations, added).visit(tree))
    names = {rf"\b{kind} \| str\b": f"{kind} | typing.Literal{list(members)}" for kind, members in enumerations.items()}
    for found, meant in (TYPES | names).items():
        text = re.sub(found, meant, text)
    text = text.replace("import typing\n", "import builtins\nimport typing\nSelf = typing.TypeVar('Self')\n", 1)
    stub.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:]))
