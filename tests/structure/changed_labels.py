#!/usr/bin/env python3
"""Prints the CTest labels, and "python", of what may be wrong after a change of the files named on standard input:
their components and those above. The program, the Python module and the examples only if their own files changed.

usage: git diff --name-only main | changed_labels.py
"""
import pathlib
import sys

from test_components import BELOW, component_of

#: What the tests with a label use beside what their component may include, and what the judges of render use.
ALSO_USED = {"judge": ["importers"], "practice": ["importers"], "pictures": ["importers"], "experiments": ["importers"],
             "collision": ["experiments"], "openhaptics": ["practice"],
             "guidance": ["practice", "importers"], "stroke_judge": ["practice", "importers"], "stability": ["render"]}
#: The labels of other files, by the start of their path; the longest that fits.
OTHERS = {"tools/": ["tools"], "bindings/": ["python"], "examples/": ["c", "collision", "devices", "model", "practice"],
          "examples/python/": ["python"], "docs/": ["python", "tools"],
          "docs/own-backend.md": ["devices", "python", "tools"], "README.md": ["python", "tools"], "CHANGELOG.md": [],
          "web/": [], "tests/web/": [],
          "tests/tools/": ["tools"], "tests/consumer/": ["consumer"], "tests/structure/": ["tools"],
          "tests/refused/": ["devices", "render"], "tests/fuzz/": ["collision"], "tests/soak/": ["practice"],
          "tests/guidance/": ["guidance"], "tests/stroke_judge/": ["stroke_judge", "guidance"],
          "tests/stability/": ["stability", "guidance"],
          "tests/devices/phantom/emulator/": ["phantom", "openhaptics", "tools", "python"],
          "tests/devices/openhaptics/": ["openhaptics", "tools", "python"],
          "tests/judge/": ["judge", "practice", "stroke_judge", "guidance"],
          "tests/practice/": ["practice", "pictures", "experiments", "stroke_judge"]}


def used(label):
    """The components on which the tests with a label depend."""
    direct = [label, *ALSO_USED.get(label, [])]
    return {name for one in direct if one in BELOW for name in [one, *BELOW[one]]}


def labels(paths):
    """The labels of what may be wrong after a change of the files; "everything" if one belongs to everything."""
    found = {"structure"} if paths else set()
    for path in paths:
        parts = pathlib.PurePosixPath(path).parts
        fitting = [start for start in OTHERS if path.startswith(start)]
        if parts[:2] == ("include", "calligraphy") or parts[0] == "src":
            own = component_of(parts[2 if parts[0] == "include" else 1:])
            if own is None:
                return {"everything"}
            found.update(label for label in [*BELOW, *ALSO_USED] if own in used(label))
        elif fitting:
            found.update(OTHERS[max(fitting, key=len)])
        elif parts[0] == "tests" and len(parts) > 2 and component_of(parts[1:]):
            found.add(component_of(parts[1:]))
        else:
            return {"everything"}
    return found


if __name__ == "__main__":
    print(*sorted(labels(sys.stdin.read().split("\n")[:-1])))
