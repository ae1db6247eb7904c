#!/usr/bin/env python3
"""Runs the commands of docs/measured.md, in a build directory, and says which figures differ from the page's.

Prints a line for each row of the page and ends with "N same, N differ, N depend on the machine, N could not be
measured". Times and their ratios depend on the machine: they are printed, and never differ. Exit code 1 if a figure
differs or could not be measured.
"""

import argparse
import functools
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

REPOSITORY = Path(__file__).resolve().parent.parent
PAGE = REPOSITORY / "docs/measured.md"
NUMBER = re.compile(r"\d+(?:,\d{3})*(?:\.\d+)?")  # as printed on the page
SUFFIXES = {"": 1.0, "m": 1e-3, "u": 1e-6, "n": 1e-9, "k": 1e3, "M": 1e6}  # of Google Benchmark's counters
SKIPPED = 77  # exit code of a test that was skipped


class NotMeasured(Exception):
    """Begins with "failed" or "not available"."""


class Row(NamedTuple):
    what: str
    figure: str
    command: str


class Rule(NamedTuple):
    """How to find the numbers of a row's figure, in their order, in the output of its command."""

    key: str  # part of what the row says, and of no other row
    # A pattern whose groups they are, or a function. A pattern without groups is of a program that checks the figure.
    find: str | Callable[[str], list[float]]
    machine: bool = False  # a time, or a ratio of times
    slow: bool = False  # the command takes more than a minute
    code: int = 0  # exit code of the command where the figure is the page's


def found(pattern: str, output: str) -> list[float]:
    """The groups, or those named first and second where the output has them in the other order."""
    match = re.search(pattern, output, re.MULTILINE)
    if match is None:
        raise NotMeasured("failed: no figure found in the output")
    named = match.groupdict()
    return [float(number) for number in ([named["first"], named["second"]] if named else match.groups())]


def counters(benchmark: str, *names: str) -> Callable[[str], list[float]]:
    """Counters of a line of Google Benchmark."""

    def find(output: str) -> list[float]:
        line = re.search(rf"^{re.escape(benchmark)}\b.*", output, re.MULTILINE)
        values = dict(re.findall(r"(\w+)=(\S+)", line[0] if line else ""))
        if not set(names) <= set(values):
            raise NotMeasured("failed: no figure found in the output")
        parts = [re.fullmatch(r"(.+?)([munkM]?)", values[name]) for name in names]
        return [float(part[1]) * SUFFIXES[part[2]] for part in parts]

    return find


def largest_half(output: str) -> list[float]:
    return [max(found(rf"^the {half} half .*\( *([\d.]+)", output)[0] for half in ("first", "middle", "second"))]


def within_2_percent(output: str) -> list[float]:
    """The share of strokes to more digits than the report prints, from its list of the ten largest errors."""
    count = found(r"(\d+) strokes from", output)[0]
    listed = output.partition("largest errors")[2].partition("\n\n")[0]
    beyond = sum(float(error) > 2 for error in re.findall(r"^ +(\d+\.\d+) ", listed, re.MULTILINE))
    if beyond == 10:
        raise NotMeasured("failed: too many errors above 2 % for the report to list")
    return [100 * (count - beyond) / count, count]


def size_of_character(output: str) -> list[float]:
    size, error = counters("size/standard", "bytes_each", "point_error_em")(output)
    return [size, 100 * error]


def set_times(output: str) -> list[float]:
    opening = counters("open/standard", "p50_us")(output)
    finding = counters("find/standard", "set_p50_ns")(output)
    preparing = counters("stroke/standard", "prepared_p50_ns")(output)
    return [*opening, *finding, preparing[0] / 1e3]


def period(output: str) -> list[float]:
    return [microseconds / 1e3 for microseconds in found(r"^period +\S+ +(\S+) +(\S+)", output)]


def peers(output: str) -> list[float]:
    """Of the first column, real strokes near them; a peer that could not be had is not in the table."""
    libraries = ("kurbo nearest 1e-9", "lib2geom nearest_time", "bezier.js project")
    methods = ("exact", "exact, batched", "wang2006 1e-6", *libraries)
    return [found(rf"^\| {re.escape(method)} +\| +([\d.]+)", output)[0] for method in methods]


FARTHER_OFF = r"> 2 mm in (\d+) of (\d+)"
RECOGNISED = r"geometry alone recognises \d+ as labelled \((\S+) %\)"
AT_REST = r"^all +(?P<second>\d+) +\d+ +(?P<first>\d+)"
KEPT = "(?:.*\n)*? +".join(
    [r"(\d+) faults", "no allocations +kept", "every force is finite +kept", "no force step above the limit +kept"]
)

RULES = (
    Rule("RMS lateral error of a novice", r"RMS error smaller by (\S+) \+- (\S+) %"),
    Rule("time of the same pairs", r"time by (\S+) \+- (\S+) %"),
    Rule("strokes that an Omni's novice", r"^omni, .*\n(?:.*\n){3} +30 % .*?\| +(\S+) +(\S+)"),
    Rule("honest strokes", r"distorted by 3 % +\d+ of +(?P<second>\d+) \( *(?P<first>\S+)"),
    Rule("half a stroke", largest_half, slow=True),
    Rule("farther off than vision, Desktop", FARTHER_OFF, slow=True),
    Rule("the same, Omni", FARTHER_OFF, slow=True),
    Rule("random hands", AT_REST, slow=True),
    Rule("the same, other hands", AT_REST, slow=True, code=1),
    Rule("releases of guidance", r"^all +(?P<second>\d+) +(?P<first>\d+)"),
    Rule("net energy", r"^all +(?P<second>\d+) +0 +(?P<first>\S+)", slow=True),
    Rule("24 h of virtual time", KEPT, slow=True),
    Rule("largest force step", r"default (\S+) N, wang2006 (\S+) N"),
    Rule("stiffest stable wall", r"^ +none(?: +\d+){4} +(\d+) +(\d+)"),
    Rule("emulated Phantom", "All tests passed"),
    Rule("allocations in a million ticks", "All tests passed"),
    Rule("renderer tick", counters("whole_tick/default_rules", "p50_ns", "p99_ns", "p999_ns"), machine=True),
    Rule("all optional stages", counters("tick_with/everything", "added_ns"), machine=True),
    Rule("the same tick through", counters("tick_through_c", "added_ns"), machine=True),
    Rule("nearest point on real strokes", peers, machine=True, slow=True),
    Rule("wrong nearest points", r"^(\d+) failures", slow=True),
    Rule("period of the servo thread", period, machine=True),
    Rule("batched nearest points in Python", r"100000 queries, exact .* ratio (\S+)", machine=True),
    Rule("hanzi-writer-data: strokes", within_2_percent, slow=True),
    Rule("against cnchar-order's letters", RECOGNISED, slow=True),
    Rule("KanjiVG: strokes", within_2_percent),
    Rule("against its labels", RECOGNISED),
    Rule("size of a character", size_of_character),
    Rule("opening a set", set_times, machine=True),
)


def rows_of_page() -> list[tuple[Row, Rule]]:
    """The rows with their rules, which must fit one to one."""
    rows = []
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        cells = re.fullmatch(r"\| (.+) \| (.+) \| `(.+)` \|", line)
        if cells:
            rows.append(Row(*cells.groups()))
        elif line.startswith("| ") and line != "| what | figure | command |":
            sys.exit(f"{PAGE.name}: not a row of what, figure and `command`: {line}")
    pairs = [(row, rule) for row in rows for rule in RULES if rule.key in row.what]
    loose = [f"row: {row.what}" for row in rows if sum(row is other for other, _ in pairs) != 1]
    loose += [f"rule: {rule.key}" for rule in RULES if sum(rule is other for _, other in pairs) != 1]
    if loose:
        sys.exit("\n".join([f"{PAGE.name} and the rules of {Path(__file__).name} do not fit one to one:", *loose]))
    return pairs


@functools.cache
def run(words: tuple[str, ...], build: Path) -> subprocess.CompletedProcess:
    # By env, because a command may begin with assignments.
    return subprocess.run(
        ["env", *words], cwd=build, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8", errors="replace"
    )


def output_of(command: str, build: Path, code: int) -> str:
    words = [word.replace("../../", f"{REPOSITORY}/") for word in shlex.split(command)]
    for word in words:
        path = word.partition("=")[2] or word
        if "/" in path and not word.startswith("-") and not (build / path).exists():
            raise NotMeasured(f"not available: {path} is missing")
    done = run(tuple(words), build)
    last_line = done.stdout.strip().rpartition("\n")[2]
    if done.returncode == SKIPPED:
        raise NotMeasured(f"not available: {last_line}")
    if done.returncode not in (0, code):
        raise NotMeasured(f"failed: exit code {done.returncode}: {last_line}")
    return done.stdout


def measured(row: Row, rule: Rule, build: Path) -> str:
    """The page's figure with the measured numbers, rounded like the page's, in place of the first of them."""
    output = output_of(row.command, build, rule.code)
    values = iter(found(rule.find, output) if isinstance(rule.find, str) else rule.find(output))

    def as_printed(number: re.Match) -> str:
        value = next(values, None)
        if value is None:
            return number[0]
        return f"{value:{',' if ',' in number[0] else ''}.{len(number[0].partition('.')[2])}f}"

    figure = NUMBER.sub(as_printed, row.figure)
    if next(values, None) is not None:
        sys.exit(f"{PAGE.name}: the rule finds more numbers than the figure has: {row.what}")
    return figure


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", metavar="DIRECTORY", help="where the commands run, build-tests/release by default")
    parser.add_argument("--quick", action="store_true", help="omit the rows that take more than a minute")
    parser.add_argument("words", nargs="*", metavar="WORD", help="only the rows that contain one of these")
    arguments = parser.parse_args()
    build = Path(arguments.build or REPOSITORY / "build-tests/release").resolve()
    if not build.is_dir():
        parser.error(f"{build} is not a directory; docs/measured.md tells how to build it")
    words = [word.casefold() for word in arguments.words]
    count = {"same": 0, "differs": 0, "machine": 0, "not measured": 0}
    for row, rule in rows_of_page():
        text = f"{row.what} {row.command}".casefold()
        if (arguments.quick and rule.slow) or (words and not any(word in text for word in words)):
            continue
        try:
            figure = measured(row, rule, build)
        except NotMeasured as why:
            count["not measured"] += 1
            print(f"{why}: {row.what}", flush=True)
            continue
        result = "machine" if rule.machine else "same" if figure == row.figure else "differs"
        count[result] += 1
        figures = row.figure if result == "same" else f"{row.figure} on the page, measured {figure}"
        print(f"{result}: {row.what}: {figures}", flush=True)
    if not any(count.values()):
        parser.error("no row contains any of the words")
    print(
        f"{count['same']} same, {count['differs']} differ, {count['machine']} depend on the machine, "
        f"{count['not measured']} could not be measured"
    )
    return 1 if count["differs"] or count["not measured"] else 0


if __name__ == "__main__":
    sys.exit(main())
