"""The blocks of Python in README.md and the pages in docs/."""

import pathlib
import re

ROOT = pathlib.Path(__file__).parents[3]


def python_blocks():
    """Name of each page with blocks of Python -> their texts, which are one program."""
    found = {}
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))):
        blocks = re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
        if blocks:
            found[str(page.relative_to(ROOT))] = blocks
    return found
