#!/usr/bin/env python3
"""Components include only those below them, and all lists of components agree.

usage: test_components.py SOURCE_DIRECTORY
"""
import pathlib
import re
import sys

# Every component with those whose headers it may include, bottom up (README.md).
BELOW = {
    "base": [],
    "model": ["base"],
    "judge": ["base", "model"],
    "importers": ["base", "model", "judge"],
    "devices": ["base"],
    "phantom": ["base", "devices"],
    "openhaptics": ["base", "devices"],
    "collision": ["base", "model"],
    "render": ["base", "model", "devices", "collision"],
    "practice": ["base", "model", "judge", "devices", "collision", "render"],
    "pictures": ["base", "model", "judge", "devices", "collision", "render", "practice"],
    "experiments": ["base", "model", "judge", "devices", "collision", "render", "practice", "pictures"],
    "c": ["base", "model", "judge", "devices", "collision", "render", "practice"],
}
BACKENDS = ["phantom", "openhaptics"]  # folders beneath devices

# The folders of a component, each with those of them whose headers it may include.
FOLDERS = {"importers": {"read": [], "fit": [], "check": ["read", "fit"]},
           "judge": {"pens": [], "reading": ["pens"], "form": ["pens", "reading"],
                     "remarks": ["pens", "reading", "form"]}}

# From devices, render may include only plain structs and the arithmetic of one estimator: no device, no loop.
PLAIN_DEVICE_HEADERS = {"capabilities", "device_state", "velocity_estimator"}


def component_of(parts):
    """The component of a path below include/calligraphy or src, or None."""
    if parts[0] == "devices" and len(parts) > 2 and parts[1] in BACKENDS:
        return parts[1]
    return parts[0] if parts[0] in BELOW and len(parts) > 1 else None


def includes(path):
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(encoding="utf-8"), re.MULTILINE)


def arrows(root):
    """The invalid includes below root, each with its place."""
    found = []
    for folder in ("include/calligraphy", "src"):
        for path in sorted(path for ending in ("h", "hpp", "cpp") for path in (root / folder).rglob(f"*.{ending}")):
            parts = path.relative_to(root / folder).parts
            own = component_of(parts)
            if own is None:
                if len(parts) > 1:
                    found.append(f"{path}: this folder belongs to no component")
                for name in includes(path):  # calligraphy.hpp
                    if "/detail/" in name:
                        found.append(f"{path}: {name} is not a public header")
                continue
            for name in includes(path):
                if name == "calligraphy/calligraphy.hpp" or re.search(r"(^|/)(\.{1,2}|)/", name):
                    found.append(f"{path}: {name} hides which component it belongs to")
                public = name.startswith("calligraphy/")
                target = component_of(pathlib.PurePosixPath(name.removeprefix("calligraphy/")).parts)
                if target is None:
                    continue
                if target not in BELOW[own] + [own]:
                    found.append(f"{path}: {own} includes {name}, and {target} is not below it")
                if own == "render" and target == "devices" and pathlib.PurePosixPath(name).stem not in PLAIN_DEVICE_HEADERS:
                    found.append(f"{path}: render includes {name}, which is not a plain struct of devices")
                inner, other = parts[1], pathlib.PurePosixPath(name).parts[1]
                if own == target and inner in FOLDERS.get(own, {}) and other in FOLDERS[own]:
                    if other not in FOLDERS[own][inner] + [inner]:
                        found.append(f"{path}: {own}/{inner} includes {name}")
                if folder.startswith("include") and not public:
                    found.append(f"{path}: a public header includes the private {name}")
    return found


def order_in(text, pattern):
    """The components in the order in which the pattern first names them."""
    names = re.findall(pattern, text, re.MULTILINE)
    return list(dict.fromkeys(name for name in names if name in BELOW))


def lists(root):
    """The lists of components that differ from the one in this file."""
    expected = list(BELOW)
    found = []
    for place, pattern in {
        "CMakeLists.txt": r"^\s*calligraphy_component\((\w+)",
        "README.md": r"\[`(\w+)`\]\(include/calligraphy/[\w/]+\)",
    }.items():
        text = (root / place).read_text(encoding="utf-8")
        order = order_in(text, pattern)
        if order != expected:
            found.append(f"{place} lists {order}, expected {expected}")
    for name in BELOW:
        folder = f"devices/{name}" if name in BACKENDS else name
        for place in ("src", "tests") if name == "base" else ("include/calligraphy", "src", "tests"):
            if not (root / place / folder).is_dir():
                found.append(f"{place}/{folder} does not exist")
    return found


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = arrows(root) + lists(root)
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
