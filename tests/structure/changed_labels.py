#!/usr/bin/env python3
"""Prints the CTest labels, and "python", of what may be wrong after a change of the files named on standard input: their
components and those above. The program, the Python module and the examples are only named if their own files changed.

usage: git diff --name-only main | changed_labels.py
"""
import pathlib
import sys

from test_components import BELOW, component_of

JUDGES = ["guidance", "stability"]  # of render, from outside
FOLDERS = {"tools": "tools", "bindings": "python", "examples": "practice", "docs": "structure", "tests/tools": "tools",
           "tests/consumer": "consumer", "tests/structure": "structure", "tests/fuzz": "collision",
           "tests/soak": "practice", "tests/guidance": "guidance", "tests/stability": "stability"}


def component_in(parts):
    """The component of a file, or of the tests of one; None if it is that of no one component."""
    if parts[:2] == ("include", "calligraphy"):
        return component_of(parts[2:])
    return component_of(parts[1:]) if parts[0] in ("src", "tests") and len(parts) > 2 else None


def labels(paths):
    """The labels, in no order; "everything" if a file belongs to everything."""
    found = set()
    for path in paths:
        parts = pathlib.PurePosixPath(path).parts
        own = component_in(parts)
        folder = FOLDERS.get(parts[0]) or FOLDERS.get("/".join(parts[:2]))
        if own and parts[0] == "tests":
            found.add(own)
        elif own:
            above = [name for name in BELOW if name == own or own in BELOW[name]]
            found.update(above, JUDGES if "render" in above else [])
        elif folder or path.endswith(".md"):
            found.add(folder or "structure")
        else:
            return {"everything"}
    return found


if __name__ == "__main__":
    print(*sorted(labels(sys.stdin.read().split("\n")[:-1])))
