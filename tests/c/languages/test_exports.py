#!/usr/bin/env python3
"""The shared library exports the functions of the C header and nothing else, under a SONAME of its minor version.

usage: test_exports.py LIBRARY HEADER
"""
import pathlib
import re
import subprocess
import sys


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def main():
    library, header = sys.argv[1:3]
    text = pathlib.Path(header).read_text(encoding="utf-8")
    declared = set(re.findall(r"^CALLIGRAPHY_API\b[^;]*?\b(calligraphy_\w+)\(", text, re.MULTILINE))
    exported = {line.split()[-1] for line in output("nm", "-D", "--defined-only", library).splitlines()}
    version = ".".join(re.search(rf"CALLIGRAPHY_VERSION_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR"))
    soname = re.search(r"SONAME\D*\[(.*)\]", output("readelf", "-d", library))[1]
    failures = [f"declared but not exported: {name}" for name in sorted(declared - exported)]
    failures += [f"exported but not declared: {name}" for name in sorted(exported - declared)]
    if soname != f"libcalligraphy_c.so.{version}":
        failures.append(f"SONAME {soname}, but the header is of version {version}")
    if len(declared) < 30:
        failures.append(f"only {len(declared)} functions found in {header}")
    print("\n".join(failures) or f"{len(declared)} functions")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
