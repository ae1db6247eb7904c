"""Type stubs: complete, consistent with the module, and sufficient for mypy and pyright to check programs."""

import ast
import enum
import importlib.util
import inspect
import json
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

import calligraphy as cal
from pages import ROOT, python_blocks

PACKAGE = pathlib.Path(cal.__file__).parent


USER = """
import numpy as np
import numpy.typing as npt
import calligraphy as cal
result = cal.nearest_point([[0, 0], [1, 2], [3, 0]], np.zeros((5, 2)), method="exact", tolerance=1e-9)
points: npt.NDArray[np.float64] = result.point
state = cal.DeviceState(position=(0, 0, 0.01))
state.position = [1, 2, 3]
options = cal.RendererOptions(servo_rate=2000.0)
options.nearest.method = cal.NearestPointMethod["exact"]
options.nearest.method = "tracked"
mode: cal.FeedbackMode = cal.SessionOptions(mode="force").mode
class Mine(cal.HapticDevice):
    def read(self) -> cal.DeviceState:
        return state
servo = cal.Servo(Mine(), lambda state: 10.0 * state.position)
stroke: cal.Stroke = cal.built_in_characters()["永"].strokes()[0]
flags: cal.TickEvent = cal.TickEvent.lift | cal.TickEvent.contact
modes: list[cal.FeedbackMode] = list(cal.FeedbackMode)
with cal.PointerDevice(cal.device_profile("desktop")) as pointer:
    pointer.move(0.0, 0.0, 0.5)
if servo.error is not None:
    raise servo.error
"""
WRONG = """
import calligraphy as cal
cal.RendererOptions(servo_rat=1.0)
cal.GripImpedance(mass="heavy")
cal.nearest_pont
cal.FeedbackMode.blind
cal.SessionOptions(mode="blind")
cal.SessionOptions().mode = "blind"
"""


def checked(words, directory):
    environment = dict(os.environ)
    if PACKAGE.parent.name != "site-packages":  # where type checkers search by default
        environment.update(MYPYPATH=str(PACKAGE.parent), PYTHONPATH=str(PACKAGE.parent))
    return subprocess.run(words, capture_output=True, text=True, env=environment, cwd=directory)


def programs(directory):
    """All programs of examples and pages, and two user programs, in one directory; `wrong.py` has one mistake per line."""
    for path in (ROOT / "examples" / "python").glob("*.py"):
        shutil.copy(path, directory)
    for page, blocks in python_blocks().items():
        name = pathlib.Path(page).stem.lower().replace("-", "_")
        (directory / f"page_{name}.py").write_text("".join(blocks), encoding="utf-8")
    (directory / "user.py").write_text(USER, encoding="utf-8")
    (directory / "wrong.py").write_text(WRONG, encoding="utf-8")


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_mypy_finds_exactly_the_mistakes_in_programs(tmp_path):
    programs(tmp_path)
    words = [sys.executable, "-m", "mypy", "--config-file", str(ROOT / "pyproject.toml"), "--cache-dir", "cache"]
    found = checked([*words, "."], tmp_path)
    errors = [line for line in found.stdout.splitlines() if ": error:" in line]
    package = checked([*words, "-p", "calligraphy"], tmp_path)
    assert package.returncode == 0, package.stdout + package.stderr
    assert [line for line in errors if not line.startswith("wrong.py:")] == [], found.stdout + found.stderr
    assert [int(line.split(":")[1]) for line in errors] == [3, 4, 5, 6, 7, 8]


@pytest.mark.skipif(shutil.which("pyright") is None, reason="pyright is not installed")
def test_pyright_finds_exactly_the_mistakes_in_programs(tmp_path):
    programs(tmp_path)
    words = ["pyright", "--outputjson", "--pythonpath", sys.executable, "."]
    found = json.loads(checked(words, tmp_path).stdout)["generalDiagnostics"]
    errors = [(pathlib.Path(e["file"]).name, e["range"]["start"]["line"] + 1) for e in found if e["severity"] == "error"]
    assert sorted(set(errors)) == [("wrong.py", line) for line in (3, 4, 5, 6, 7, 8)], found


def test_the_stubs_cover_the_module_with_docstrings_and_units():
    """Names and signatures are generated from the module; this checks what make_stubs.py adds."""
    tree = ast.parse((PACKAGE / "_calligraphy.pyi").read_text(encoding="utf-8"))
    told = {item.name: item for item in tree.body if isinstance(item, (ast.ClassDef, ast.FunctionDef))}
    module = vars(cal._calligraphy)
    assert {name for name, value in module.items() if callable(value) and not name.startswith("__")} == set(told)
    untold = [name for name, item in told.items() if not ast.get_docstring(item)]
    for item in told.values():
        kind = module[item.name]
        if isinstance(kind, type) and "fields" in vars(kind):
            (made,) = (f for f in item.body if isinstance(f, ast.FunctionDef) and f.name == "__init__")
            assert tuple(argument.arg for argument in made.args.kwonlyargs) == kind.fields
        if isinstance(kind, enum.EnumMeta):
            members = {each.targets[0].id: each.value.value for each in item.body if isinstance(each, ast.Assign)}
            assert members == {member.name: member.value for member in kind}
        for part in item.body if isinstance(item, ast.ClassDef) else ():
            if isinstance(part, ast.FunctionDef) and [ast.unparse(d) for d in part.decorator_list] == ["property"]:
                untold += [] if ast.get_docstring(part) else [f"{item.name}.{part.name}"]
    assert untold == []
    (table,) = (f for f in told["Recording"].body if getattr(f, "name", "") == "to_pandas")  # a method of _display.py
    assert ast.unparse(table.returns) == "typing.Any"
    assert ast.get_docstring(table) == inspect.getdoc(cal.Recording.to_pandas)
    (mass,) = (f for f in told["SessionOptions"].body if getattr(f, "name", "") == "character_timeout" and f.args.args[1:] == [])
    assert ast.get_docstring(mass).endswith("[s]")
