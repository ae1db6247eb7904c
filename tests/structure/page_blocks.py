"""The code blocks of README.md and of the pages in docs/, for the tests that compile and run them.

Every fence has one of the LANGUAGES. An HTML comment `<!-- given: ... -->` on the lines above a fence says what the
block stands on, to the test alone; blocks of one page in Python are one program, so they need none. Those in C are one
main() too, before which stands what is given, and what defines functions.
"""
import dataclasses
import re

LANGUAGES = {"c", "cmake", "cpp", "csharp", "js", "python", "rust", "sh", "text"}
FENCE = re.compile(r"(?:^<!-- given:\n(?P<given>.*?)-->\n)?^```(?P<language>[^\n]*)\n(?P<text>.*?)^```$",
                   re.DOTALL | re.MULTILINE)


@dataclasses.dataclass
class Block:
    page: str  # relative to the source directory
    line: int  # that of the first line of its text
    language: str
    text: str
    given: str


def pages(root):
    return [root / "README.md", *sorted((root / "docs").glob("*.md"))]


def blocks(root):
    """All blocks of all pages, in order."""
    found = []
    for page in pages(root):
        text = page.read_text(encoding="utf-8")
        for match in FENCE.finditer(text):
            line = text.count("\n", 0, match.start("text")) + 1
            name, given = str(page.relative_to(root)), match["given"] or ""
            found.append(Block(name, line, match["language"], match["text"], given))
    return found
