"""The examples run, and so do the code blocks of README.md and the pages in docs/, those of a page as one program."""

import json
import os
import pathlib
import subprocess
import sys

import pytest

import calligraphy as cal
from pages import ROOT, python_blocks

EXAMPLES = {
    "table_5_and_figures": ["figure-31.png", "figures-32-36.png", "figures-37-38.png"],
    "speed_accuracy_tradeoff": ["speed-accuracy-tradeoff.png"],
    "stability_map": ["stability-map.png"],
    "own_force_law": ["own-force-law.png"],
    "own_guidance_law": ["own-guidance-law.png"],
    "four_laws": ["four-laws.png"],
    "replay_trace": ["replay-trace.png"],
    "live_writing": ["live-writing.png"],
    "ink": ["ink.png"],
}
BLOCKS = python_blocks()

#: Runs each program in its own process, forked from one with the slow imports done; prints the exit codes.
RUN_ALL = """
import json, os, runpy, sys
import calligraphy, matplotlib.pyplot, numpy, pandas
codes = {}
for name, (program, directory) in json.loads(sys.argv[1]).items():
    child = os.fork()
    if child == 0:
        os.chdir(directory)
        told = os.open("told.txt", os.O_WRONLY | os.O_CREAT, 0o644)
        os.dup2(told, 1), os.dup2(told, 2)
        sys.argv, sys.path[0] = [program, "--out", "."], os.path.dirname(program)
        try:
            runpy.run_path(program, run_name="__main__")
        except SystemExit as end:
            sys.exit(end.code)
        sys.exit(0)
    codes[name] = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
print(json.dumps(codes))
"""


@pytest.fixture(scope="module")
def ended(tmp_path_factory):
    """Results of all programs of examples and pages: exit code, output and directory of each."""
    for module in ("matplotlib", "pandas"):
        pytest.importorskip(module)
    programs = {name: str(ROOT / "examples" / "python" / f"{name}.py") for name in EXAMPLES}
    directories = {name: tmp_path_factory.mktemp(name.replace("/", "-")) for name in (*EXAMPLES, *BLOCKS)}
    for page, blocks in BLOCKS.items():
        programs[page] = str(directories[page] / "pasted.py")
        pathlib.Path(programs[page]).write_text("".join(blocks), encoding="utf-8")
    both = json.dumps({name: [program, str(directories[name])] for name, program in programs.items()})
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(cal.__file__).parents[1]), "PYTHONIOENCODING": "utf-8"}
    done = subprocess.run([sys.executable, "-c", RUN_ALL, both], capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr
    codes = json.loads(done.stdout.splitlines()[-1])
    return {
        name: (codes[name], (directory / "told.txt").read_text(encoding="utf-8"), directory)
        for name, directory in directories.items()
    }


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_runs_and_writes_its_pictures(name, ended):
    code, told, directory = ended[name]
    assert code == 0, told
    import matplotlib.image

    for picture in EXAMPLES[name]:
        assert picture in told
        pixels = matplotlib.image.imread(directory / picture)
        assert pixels.shape[0] > 300 and pixels.shape[1] > 300 and pixels[..., :3].std() > 0.02


def test_every_example_is_tested():
    scripts = {path.stem for path in (ROOT / "examples" / "python").glob("*.py")} - {"plotting", "test_force_law"}
    assert scripts == set(EXAMPLES)


def test_the_unit_tests_of_a_force_law_pass():
    program = ROOT / "examples" / "python" / "test_force_law.py"
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(program)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=program.parent)
    assert done.returncode == 0 and "3 passed" in done.stdout, done.stdout + done.stderr


@pytest.mark.parametrize("page", BLOCKS)
def test_the_code_blocks_of_a_page_run(page, ended):
    code, told, _ = ended[page]
    assert code == 0, told


def test_the_readme_shows_a_guided_stroke_in_at_most_eight_lines():
    code = [line for line in BLOCKS["README.md"][0].splitlines() if line]
    assert len(code) <= 8
