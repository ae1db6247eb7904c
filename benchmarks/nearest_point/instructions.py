#!/usr/bin/env python3
"""Instructions per query by callgrind: instructions.py PROGRAM [WORKLOAD ...]"""
import re
import subprocess
import sys

program = sys.argv[1]
workloads = sys.argv[2:] or ["real strokes near", "random box", "hook", "collinear"]
queries = 2048


def instructions(method, workload):
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", "--collect-atstart=no",
               "--toggle-collect=measured", program, "--method", method, "--workload", workload,
               "--queries", str(queries)]
    result = subprocess.run(command, capture_output=True, text=True)
    found = re.search(r"Collected\s*:\s*(\d+)", result.stderr)
    if result.returncode != 0 or not found:
        sys.exit(f"{' '.join(command)}\n{result.stderr}")
    return int(found.group(1)) / queries


methods = subprocess.run([program, "--list"], capture_output=True, text=True, check=True).stdout.splitlines()
print("\n## Instructions per query, by callgrind\n")
print("| method | " + " | ".join(workloads) + " |")
print("|---" * (len(workloads) + 1) + "|")
for method in methods:
    print("| " + " | ".join([f"{method:<22}"] + [f"{instructions(method, w):.0f}" for w in workloads]) + " |", flush=True)
