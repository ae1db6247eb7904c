#!/usr/bin/env python3
"""The tick of two trees in one run: compare.py BEFORE AFTER [--rounds N] ...; started by compare.sh.

Both programs replay the same pens and stay alive; in each round either does the same work, one directly after the
other, so that what the machine does besides falls on both. A ratio is the median of the ratios of the rounds.
"""
import argparse
import re
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("before")
parser.add_argument("after")
parser.add_argument("--rounds", type=int, default=60, help="fewer than 10 say little")
parser.add_argument("--cold-rounds", type=int, default=12, help="with caches emptied before a tick")
parser.add_argument("--options", default="default,everything", help="those whose time is measured, joined by ,")
parser.add_argument("--noise", type=float, default=0.0, help="added to the pens' positions [um]")
parser.add_argument("--step", type=float, default=0.0, help="of a coarser encoder [um]")
parser.add_argument("--no-instructions", action="store_true")
parser.add_argument("--lines", type=int, default=0, help="ticks in which cache lines are counted: 3500 take minutes")
parser.add_argument("--stages", type=int, default=14, help="number of files to list")
arguments = parser.parse_args()
programs = [arguments.before, arguments.after]
measured = arguments.options.split(",")
if arguments.rounds < 1 or arguments.cold_rounds < 0 or arguments.noise < 0.0 or arguments.step < 0.0:
    parser.error("--rounds must be at least 1; --cold-rounds, --noise and --step at least 0")
# The result of `tracked` depends on how a revision finds it, within its tolerance; `exact` shows the rest.
everything = ["default", "everything", "wang2006"]
everything += [name + "+exact" for name in ("default", "friction", "saturating", "guide_to_start",
                                            "assist", "budget", "thermal", "everything")]
folder = tempfile.TemporaryDirectory()
pens = str(Path(folder.name) / "pens")
subprocess.run([programs[0], "record", pens, str(arguments.noise), str(arguments.step)], check=True)


class Server:
    def __init__(self, program):
        self.process = subprocess.Popen([program, "serve", pens], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        text=True)

    def ask(self, *words):
        self.process.stdin.write(" ".join(words) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        return [float(word) for word in answer.split()] if answer else sys.exit(1)  # it has said why


servers = [Server(program) for program in programs]


def in_turn(number, *command):
    """The answers of both, the order alternating."""
    answers = {}
    for i in ([0, 1] if number % 2 == 0 else [1, 0]):
        answers[i] = servers[i].ask(*command)
    return answers[0], answers[1]


def table(header, rows):
    print(f"\n| {' | '.join(header)} |\n{'|---' * len(header)}|")
    for row in rows:
        print(f"| {' | '.join(row)} |", flush=True)


def row(name, pairs):
    """Medians of both, and the median of the ratios with their quartiles."""
    ratios = sorted(after / before for before, after in pairs)
    before, after = (statistics.median(side) for side in zip(*pairs))
    quarter = len(ratios) // 4
    quartiles = f"{ratios[quarter]:.3f} to {ratios[-1 - quarter]:.3f}" if len(ratios) > 1 else ""
    return [name, f"{before:.1f}", f"{after:.1f}", f"{statistics.median(ratios):.3f}", quartiles]


def instructions(program, options):
    """Per tick, by source file: inlined code counts where it is written, that of other libraries where it is used."""
    out = Path(folder.name) / "callgrind"
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", "--collect-atstart=no",
               "--toggle-collect=measured", program, "count", pens, options]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    ticks = int(result.stdout.split()[-1])
    names, functions, costs, calls, stage, called, is_call = {}, {}, {}, {}, "", "", False
    for line in out.read_text().splitlines():
        found = re.match(r"(fl|fi|fe|cfl|cfi)=\((\d+)\)(?: (.*))?", line)
        if found:
            if found[3]:
                names[found[2]] = found[3]
            if not found[1].startswith("c"):  # the file of a called function, whose cost is listed there
                file = names[found[2]]
                if re.search("/calligraphy/|/src/", file) and "/Eigen/" not in file:
                    stage = Path(file).stem
                elif found[1] == "fl":
                    stage = "other libraries"
        elif found := re.match(r"cfn=\((\d+)\)(?: (.*))?", line):
            if found[2]:
                functions[found[1]] = found[2]
            called = functions.get(found[1], "")
        elif found := re.match(r"fn=\((\d+)\) (.*)", line):
            functions[found[1]] = found[2]
        elif line.startswith("calls="):
            calls[called] = calls.get(called, 0) + int(line[6:].split()[0])
            is_call = True
        elif re.match(r"[+\-*\d]", line):
            if not is_call:
                costs[stage] = costs.get(stage, 0.0) + int(line.split()[1]) / ticks
            is_call = False

    def calls_of(kind):
        return sum(count for name, count in calls.items() if kind in name)

    asked = max(calls_of("::tracked<"), calls_of("::tracked_nearest_point("),  # one may be inlined into the other
                calls_of("::tracked_avx2<") + calls_of("::tracked_baseline<"))
    searched = calls_of("::certified_avx2<") + calls_of("::certified_baseline<")
    return costs, 1.0 - searched / asked


def touched_lines(program, options):
    """Cache lines of 64 bytes that a tick touches, of code and of data: the means in the air, of writing, and of what
    begins it."""
    symbols = subprocess.run(["nm", program], capture_output=True, text=True, check=True).stdout
    begins, ends = (int(re.search(rf"(\w+) T {name}$", symbols, re.M)[1], 16) for name in ("tick_begins", "tick_ends"))
    command = ["valgrind", "--tool=lackey", "--trace-mem=yes", "--log-fd=2", program, "trace", pens, options,
               str(arguments.lines)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    kinds = {"0 0": "in the air", "3 0": "writing", "2 1": "contact", "3 4": "the first of a stroke"}
    means, inside = {kind: [] for kind in kinds.values()}, False
    begins, ends = (f"I  {address:08x}," for address in (begins, ends))
    for line in process.stderr:
        if line.startswith(begins):
            code, data, inside = set(), set(), True
        elif line.startswith(ends):
            inside = False
        elif inside and line[1:2] in " LSM":
            address, size = line[3:].split(",")
            first = int(address, 16)
            (code if line[0] == "I" else data).update(range(first // 64, (first + int(size) - 1) // 64 + 1))
        elif line.startswith("tick ") and line[5:].strip() in kinds:
            means[kinds[line[5:].strip()]].append((len(code), len(data)))
    return {kind: [statistics.mean(side) for side in zip(*counts)] for kind, counts in means.items() if counts}


for options in measured:
    servers[1].ask("strokes", options)  # stops here if there are no such options

print("pens: " + "; ".join(f"{int(strokes)} strokes finished in {int(ticks)} ticks"
                           for strokes, ticks in (server.ask("strokes", "default") for server in servers)))

rows = []
for options in everything:
    files = [str(Path(folder.name) / f"{options}-{i}") for i in (0, 1)]
    results = []
    for server, file in zip(servers, files):
        server.ask("forces", options, file)
        results.append(list(struct.iter_unpack("=7d", Path(file).read_bytes())))
        Path(file).unlink()
    change = max(max(abs(a - b) for a, b in zip(x[:3], y[:3])) for x, y in zip(*results))
    others = sum(x[3:] != y[3:] for x, y in zip(*results))
    rows.append([options, f"{change:.2g}", str(others)])
table(["options", "largest change of a force in a tick [N]", "ticks with another state, event, hint or stroke"], rows)

rows = []
for options in measured:
    rows.append(row(f"{options}: ticks in one piece",
                    [tuple(a[0] for a in in_turn(i, "whole", options)) for i in range(arguments.rounds)]))
    rounds = [in_turn(i, "ticks", options) for i in range(arguments.rounds)]
    for k, name in enumerate(["p50", "p99", "p99.9"]):
        rows.append(row(f"{options}: {name} of a round", [(a[k], b[k]) for a, b in rounds]))
    means = in_turn(0, "means", options)
    for k, name in enumerate(["p50", "p99", "p99.9"]):
        rows.append(row(f"{options}: {name} of the ticks' means", [(means[0][k], means[1][k])]))
    if arguments.cold_rounds:
        rows.append(row(f"{options}: cold, median of a round",
                        [tuple(a[0] for a in in_turn(i, "cold", options)) for i in range(arguments.cold_rounds)]))
        means = in_turn(0, "mean_cold", options)
        rows.append(row(f"{options}: cold, median of the ticks' means", [(means[0][0], means[1][0])]))
table(["time [ns]", "before", "after", "ratio", "quartiles"], rows)

if arguments.no_instructions or not shutil.which("valgrind"):
    print("\nleft out: instructions" + ("" if arguments.no_instructions else " (needs valgrind)"))
else:
    for options in measured:
        (before, tracked_before), (after, tracked_after) = (instructions(program, options) for program in programs)
        totals = [sum(costs.values()) for costs in (before, after)]
        rows = [["all", f"{totals[0]:.0f}", f"{totals[1]:.0f}", f"{totals[1] / totals[0]:.3f}"]]
        names = sorted(before | after, key=lambda name: -max(before.get(name, 0.0), after.get(name, 0.0)))
        for name in names[:arguments.stages]:
            rows.append([name, f"{before.get(name, 0.0):.0f}", f"{after.get(name, 0.0):.0f}", ""])
        rows.append(["nearest points on curves without a general search [%]", f"{100 * tracked_before:.1f}",
                     f"{100 * tracked_after:.1f}", ""])
        table([f"instructions per tick, {options}, by file", "before", "after", "ratio"], rows)
if arguments.lines and shutil.which("valgrind"):
    for options in measured:
        before, after = (touched_lines(program, options) for program in programs)
        rows = [[kind, *(f"{code:.0f} + {data:.0f}" for code, data in (before[kind], after[kind])),
                 f"{sum(after[kind]) / sum(before[kind]):.3f}"] for kind in before if kind in after]
        table([f"cache lines of a tick, {options}: of code + of data", "before", "after", "ratio"], rows)
