#!/usr/bin/env python3
"""Every block in C, Rust or C# of the documentation is compiled against the C interface, and runs.

usage: run_c_interface_blocks.py LANGUAGE COMPILER SOURCE_DIRECTORY LIBRARY WORK_DIRECTORY

The blocks of a page in C are one program, and each one in Rust or C# is one. It succeeds and prints the lines that its
comments `// prints: ...` say. 77: there is no such compiler.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from page_blocks import blocks


def c_program(root, page_blocks):
    """One main() of the blocks of a page, before which stand those that define functions; compilers report the page's
    lines."""
    includes, functions, body = [], [], []
    for block in page_blocks:
        is_function = re.search(r"^static .*\{$", block.text, re.MULTILINE)
        for part, lines in ((block.given, functions), (block.text, functions if is_function else body)):
            includes += re.findall(r"^#include .*", part, re.MULTILINE)
            place = f'#line {block.line} "{root / block.page}"\n' if part is block.text else ""
            lines.append(place + re.sub(r"^#include .*", "", part, flags=re.MULTILINE))
    return "\n".join([*includes, *functions, "int main(void) {", *body, "}\n"])


def programs(root, language):
    """The programs in a language, each with the place of its first line."""
    found = [block for block in blocks(root) if block.language == language]
    if language != "c":
        return [(f"{block.page}:{block.line}", block.text) for block in found]
    pages = {block.page: [other for other in found if other.page == block.page] for block in found}
    return [(page, c_program(root, of_page)) for page, of_page in pages.items()]


def commands(language, compiler, root, library, source):
    """How a source file is compiled, and how it runs."""
    program = source.with_suffix(".exe")
    if language == "c":
        return [compiler, "-std=c11", "-Wall", "-Wextra", "-pedantic", "-Werror", "-I", root / "include", source,
                library, "-lm", "-o", program], [program]
    if language == "rust":
        return [compiler, "-D", "warnings", "-L", library.parent, source, "-o", program], [program]
    return [compiler, "-warnaserror", f"-out:{program}", source], ["mono", program]


def main():
    language, compiler = sys.argv[1:3]
    root, library, work = (pathlib.Path(path).absolute() for path in sys.argv[3:6])
    missing = [name for name in (compiler, *(["mono"] if language == "csharp" else [])) if not shutil.which(name)]
    if missing:
        print(f"skipped: {missing[0]} is not installed")
        return 77
    work.mkdir(parents=True, exist_ok=True)
    environment = {**os.environ, "LD_LIBRARY_PATH": str(library.parent)}
    found, failed = programs(root, language), 0
    for number, (place, text) in enumerate(found):
        source = work / f"block_{number}.{ {'rust': 'rs', 'csharp': 'cs'}.get(language, language) }"
        source.write_text(text, encoding="utf-8")
        for command in commands(language, compiler, root, library, source):
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
            if done.returncode != 0:
                break
        prints = re.findall(r"// prints: (.*)", text)
        if done.returncode != 0 or any(line not in done.stdout.splitlines() for line in prints):
            failed += 1
            print(f"{place}: {' '.join(map(str, command))} ended with {done.returncode}, "
                  f"expected 0 and {prints}:\n{done.stdout}")
    if not found:
        print(f"no block is in {language}")
    return 1 if failed or not found else 0


if __name__ == "__main__":
    sys.exit(main())
