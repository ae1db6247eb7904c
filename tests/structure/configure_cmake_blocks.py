#!/usr/bin/env python3
"""Every block of CMake in the documentation configures a project against an installed copy of the library.

usage: configure_cmake_blocks.py SOURCE_DIRECTORY PREFIX WORK_DIRECTORY GENERATOR COMPILER

A block without project() belongs into that of the reader, with an executable `app`.
"""
import pathlib
import shutil
import subprocess
import sys

from page_blocks import blocks


def main():
    root, prefix, work = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
    failed = 0
    for number, text in enumerate(dict.fromkeys(block.text for block in blocks(root) if block.language == "cmake")):
        project = work / str(number)
        shutil.rmtree(project, ignore_errors=True)
        project.mkdir(parents=True)
        (project / "main.cpp").write_text("int main() {}\n")
        shutil.copy(root / "examples" / "test_force_law.cpp", project)
        begin = "cmake_minimum_required(VERSION 3.22)\nproject(documented LANGUAGES CXX)\nadd_executable(app main.cpp)\n"
        (project / "CMakeLists.txt").write_text(text if "project(" in text else begin + text, encoding="utf-8")
        done = subprocess.run(["cmake", "-S", project, "-B", project / "build", "-G", sys.argv[4],
                               f"-DCMAKE_CXX_COMPILER={sys.argv[5]}", f"-DCMAKE_PREFIX_PATH={prefix}"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            failed += 1
            print(f"this block does not configure:\n{text}\n{done.stdout}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
