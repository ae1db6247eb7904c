#!/usr/bin/env python3
"""Prints a page as Doxygen needs it: with an anchor for every heading, and links that lead on within the reference.

usage: doxygen_pages.py PAGE
"""
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
HTML = pathlib.Path(os.environ.get("CALLIGRAPHY_REFERENCE", ROOT / "build-docs")).resolve() / "html"


def label(page, heading):
    """Doxygen's label of a heading, from its text or from the anchor that Git hosting services give it."""
    anchor = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
    return f"{page.stem.lower()}-{anchor}".encode("ascii", "ignore").decode()


def link(page, target):
    path, _, anchor = target.partition("#")
    file = (page.parent / path).resolve() if path else page
    if re.match(r"\w+:", target) or (file.suffix == ".md" and file.exists() and not anchor):
        return target
    if anchor:
        return f"@ref {label(file, anchor)}"
    header = file.relative_to(ROOT).as_posix()
    if header.startswith("include/calligraphy/") and file.suffix == ".hpp":
        return f"@ref {header.removeprefix('include/')}"
    return os.path.relpath(file, HTML)


def main():
    page = pathlib.Path(sys.argv[1]).resolve()
    parts = re.split(r"(^```.*?^```$)", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    for i in range(0, len(parts), 2):  # every other part is a block of code
        parts[i] = re.sub(r"^(##+ )(.+)$", lambda found: f"{found[0]} {{#{label(page, found[2])}}}", parts[i],
                          flags=re.MULTILINE)
        parts[i] = re.sub(r"(?<=\]\()[^)\s]+(?=\))", lambda found: link(page, found[0]), parts[i])
    sys.stdout.buffer.write("".join(parts).encode())


if __name__ == "__main__":
    main()
