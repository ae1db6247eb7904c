#!/usr/bin/env python3
"""Writes the C++ blocks of the documentation as source files, for CMake to compile; compilers report the page's lines.

usage: write_cpp_blocks.py SOURCE_DIRECTORY OUTPUT_DIRECTORY

Writes fragments.cpp, in which each block without main() is a function of its own; and per block with main() a file of
its own, unless it is a file of examples/, which is compiled anyway. Prints a line for each of those: its name, `#` and
what it prints, which a comment `// prints: ...` in the block says.
"""
import pathlib
import re
import sys

from page_blocks import blocks


def main():
    root, output = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    output.mkdir(parents=True, exist_ok=True)
    examples = {path.read_text(encoding="utf-8") for path in (root / "examples").glob("*.cpp")}
    includes, functions, programs = ["#include <calligraphy/calligraphy.hpp>"], [], 0
    for block in blocks(root):
        place = f'#line {block.line} "{root / block.page}"\n'
        if block.language != "cpp" or block.text in examples:
            continue
        if re.search(r"^int main\(", block.text, re.MULTILINE):
            (prints,) = re.findall(r"// prints: (.*)", block.text)
            programs += 1
            write(output / f"program_{programs}.cpp", place + block.text)
            print(f"program_{programs}#{prints}")
        else:
            includes += re.findall(r"^#include .*", block.given + block.text, re.MULTILINE)
            given, text = (re.sub(r"^#include .*", "", part, flags=re.MULTILINE) for part in (block.given, block.text))
            head = f"void fragment_{len(functions)}() {{\nusing namespace calligraphy;\n"
            functions.append(f"{head}{given}\n{place}{text}}}\n")
    write(output / "fragments.cpp", "\n".join([*includes, *functions]))


def write(path, text):
    """Leaves a file alone that has this text already, so that it is not compiled again."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
