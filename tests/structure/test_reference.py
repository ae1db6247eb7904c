#!/usr/bin/env python3
"""Every public name of the headers has a comment, and Doxygen understands each: scripts/docs.sh builds the reference
without a warning.

usage: test_reference.py SOURCE_DIRECTORY
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def main():
    if shutil.which("doxygen") is None:
        print("doxygen is missing: it is needed to find public names without a comment")
        return 1 if os.environ.get("CALLIGRAPHY_REQUIRE_DATA") else SKIPPED
    script = pathlib.Path(sys.argv[1]).resolve() / "scripts" / "docs.sh"
    with tempfile.TemporaryDirectory() as directory:
        return subprocess.run([script, directory], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
