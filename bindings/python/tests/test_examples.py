"""The examples and the lines of README.md and docs/python.md do what they say."""

import os
import pathlib
import re
import subprocess
import sys

import pytest

import calligraphy as cal

ROOT = pathlib.Path(__file__).parents[3]
EXAMPLES = {
    "table_5_and_figures": ["figure-31.png", "figures-32-36.png", "figures-37-38.png"],
    "speed_accuracy_tradeoff": ["speed-accuracy-tradeoff.png"],
    "stability_map": ["stability-map.png"],
    "own_force_law": ["own-force-law.png"],
    "replay_trace": ["replay-trace.png"],
    "live_writing": ["live-writing.png"],
}


def run(arguments, directory):
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(cal.__file__).parents[1]), "PYTHONIOENCODING": "utf-8"}
    done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, cwd=directory, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def blocks(page):
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_runs_and_leaves_its_pictures(name, tmp_path):
    pytest.importorskip("matplotlib")
    told = run([str(ROOT / "examples" / "python" / f"{name}.py"), "--out", str(tmp_path)], tmp_path)
    import matplotlib.image

    for picture in EXAMPLES[name]:
        assert picture in told
        pixels = matplotlib.image.imread(tmp_path / picture)
        assert pixels.shape[0] > 300 and pixels.shape[1] > 300 and pixels[..., :3].std() > 0.02


def test_every_example_is_tried():
    scripts = {path.stem for path in (ROOT / "examples" / "python").glob("*.py")} - {"plotting"}
    assert scripts == set(EXAMPLES)


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
def test_the_lines_of_a_page_work_when_pasted(page, tmp_path):
    if page != "README.md":
        pytest.importorskip("matplotlib")
    lines = "".join(blocks(page))
    assert lines
    (tmp_path / "pasted.py").write_text(lines, encoding="utf-8")
    run(["pasted.py"], tmp_path)


def test_the_readme_has_ten_lines():
    (block,) = blocks("README.md")
    assert len(block.splitlines()) <= 12
