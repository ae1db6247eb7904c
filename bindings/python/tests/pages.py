"""The blocks of Python in README.md and the pages in docs/."""

import pathlib
import sys

ROOT = pathlib.Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "tests" / "structure"))
from page_blocks import blocks  # noqa: E402


def python_blocks():
    """Name of each page with blocks of Python -> their texts, which are one program."""
    found = {}
    for block in blocks(ROOT):
        if block.language == "python":
            found.setdefault(block.page, []).append(block.text)
    return found
