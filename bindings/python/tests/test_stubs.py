"""Type stubs: complete, true to the module, and checked by mypy."""

import importlib.util
import os
import pathlib
import re
import subprocess
import sys

import pytest

import calligraphy as cal

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parents[2]
PACKAGE = pathlib.Path(cal.__file__).parent


def run(*arguments, directory=None):
    environment = dict(os.environ)
    if PACKAGE.parent.name != "site-packages":  # where mypy looks anyway
        environment.update(MYPYPATH=str(PACKAGE.parent), PYTHONPATH=str(PACKAGE.parent))
    return subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, env=environment, cwd=directory or ROOT
    )


def installed(name):
    return pytest.mark.skipif(importlib.util.find_spec(name) is None, reason=f"{name} is not installed")


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """Runs mypy; what it knows of NumPy is found out once."""
    cache = tmp_path_factory.mktemp("mypy")
    words = ["-m", "mypy", "--config-file", str(ROOT / "pyproject.toml"), "--cache-dir", str(cache)]
    return lambda *arguments, directory: run(*words, *arguments, directory=directory)


@installed("mypy")
def test_mypy_finds_nothing_in_the_package_and_in_a_program_of_a_user(tmp_path, mypy):
    (tmp_path / "user.py").write_text(
        "import numpy as np\n"
        "import numpy.typing as npt\n"
        "import calligraphy as cal\n"
        "result = cal.nearest_point([[0, 0], [1, 2], [3, 0]], np.zeros((5, 2)), method='exact', tolerance=1e-9)\n"
        "points: npt.NDArray[np.float64] = result.point\n"
        "state = cal.DeviceState(position=(0, 0, 0.01))\n"
        "state.position = [1, 2, 3]\n"
        "options = cal.RendererOptions(servo_rate=2000.0)\n"
        "options.stroke.nearest.method = cal.NearestPointMethod.exact\n"
        "class Mine(cal.HapticDevice):\n"
        "    def read(self) -> cal.DeviceState:\n"
        "        return state\n"
        "servo = cal.Servo(Mine(), lambda state: 10.0 * state.position)\n"
        "stroke: cal.Stroke = cal.built_in_characters()['永'].strokes()[0]\n"
    )
    checked = mypy("-p", "calligraphy", directory=tmp_path)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    checked = mypy(str(tmp_path / "user.py"), directory=tmp_path)
    assert checked.returncode == 0, checked.stdout + checked.stderr


@installed("mypy")
def test_mypy_finds_what_a_user_does_wrong(tmp_path, mypy):
    (tmp_path / "wrong.py").write_text(
        "import calligraphy as cal\ncal.RendererOptions(servo_rat=1.0)\ncal.GripImpedance(mass='heavy')\ncal.nearest_pont\n"
    )
    checked = mypy(str(tmp_path / "wrong.py"), directory=tmp_path)
    assert {int(line) for line in re.findall(r"wrong\.py:(\d+): error", checked.stdout)} == {2, 3, 4}


@installed("mypy")
def test_the_stubs_name_what_the_module_has(tmp_path):
    allowed = tmp_path / "allowed"
    # pybind11's metaclass, and what a class without a constructor or with an order inherits.
    allowed.write_text(r"calligraphy\._calligraphy\.[A-Z]\w+" "\n" r".*\.__(copy|deepcopy|init|lt|le|gt|ge)__" "\n")
    checked = run(
        "-m", "mypy.stubtest", "calligraphy._calligraphy", "--concise", "--allowlist", str(allowed),
        "--ignore-unused-allowlist", directory=tmp_path,
    )  # fmt: skip
    assert checked.returncode == 0, checked.stdout + checked.stderr


@installed("pybind11_stubgen")
def test_the_stubs_are_what_the_module_says_of_itself():
    checked = run(str(HERE.parent / "make_stubs.py"), "--check")
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_every_public_name_says_what_it_is():
    untold = []
    for name in dir(cal):
        value = getattr(cal, name)
        if name.startswith("_") or not callable(value) or hasattr(value, "__members__"):
            continue
        told = (value.__doc__ or "").strip()
        if not isinstance(value, type):
            told = re.sub(r"^[^\n]*->[^\n]*", "", told).strip()
        if not told:
            untold.append(name)
    assert untold == []
