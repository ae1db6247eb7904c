"""Damages files and lets a program read them: how it ends, how long it takes and how much memory, at most.

usage: measure_mutants.py PROGRAM COUNT "COMMAND ... {} ..." SEED_FILE... [--seed N] [--in-zip] [--most-memory MIB]
                          [--most-time S]

{} in the command stands for the damaged file, which has the name of the seed file; COUNT mutants are made of each seed.
With --in-zip the program gets an undamaged zip of the damaged file, whose checksum so does not protect it. Kept are
those that do not end with 0 or 1, or take too much.

example: measure_mutants.py calligraphy 20000 "traces --text 永 -o /dev/null {}" pen.svc pen.inkml
"""
import argparse
import os
import random
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

PIECES = (b"9" * 20, b"-1", b"nan", b"inf", b"1e308", b",,,", b"\n", b"\0", b"<", b">", b'"',
          b"[", b"]", b"{", b"'", b"#")


def damaged(whole, draw):
    """The bytes with one to twenty changes: a byte, a gap, a repeated part, or something odd put in."""
    data = bytearray(whole)
    for _ in range(draw.choice((1, 1, 2, 5, 20))):
        at = draw.randrange(len(data))
        kind = draw.randrange(4)
        if kind == 0:  # half of them still text, which gets farther
            data[at] = draw.choice((draw.randrange(256), draw.choice(b"0123456789.-e, ")))
        elif kind == 1:
            del data[at:at + draw.randrange(1, 40)]
        elif kind == 2:
            data[at:at] = data[draw.randrange(len(data)):][:draw.randrange(1, 200)]
        else:
            data[at:at] = draw.choice(PIECES)
        data = data or bytearray(b"x")
    return bytes(data)


def ended(command):
    """Exit code, processor time [s], which other programs do not lengthen, and largest memory [kB] of a command."""
    running = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(running.pid, 0)
    running.returncode = os.waitstatus_to_exitcode(status)
    return running.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss


def measure(command, seeds, count, draw, most_memory=64.0, most_time=2.0, in_zip=False):
    """Runs the command, whose {} is a mutant, `count` times for each of the seeds: pairs of a name and bytes. Prints a
    line a seed, keeps mutants beyond the limits, and returns their number."""
    beyond = 0
    with tempfile.TemporaryDirectory() as directory:
        for name, whole in seeds:
            worst_time, worst_memory, outcomes = 0.0, 0, {}
            path = Path(directory) / (name + ".zip" if in_zip else name)
            for i in range(count):
                data = damaged(whole, draw)
                if in_zip:
                    with zipfile.ZipFile(path, "w") as packed:
                        packed.writestr(name, data)
                else:
                    path.write_bytes(data)
                code, seconds, memory = ended([str(path) if word == "{}" else word for word in command])
                worst_time, worst_memory = max(worst_time, seconds), max(worst_memory, memory)
                outcomes[code] = outcomes.get(code, 0) + 1
                if code not in (0, 1) or memory > most_memory * 1024 or seconds > most_time:
                    beyond += 1
                    print(f"{name}, mutant {i}: exit {code}, {seconds:.2f} s, {memory} kB")
                    Path(f"mutant-{i}-{name}").write_bytes(data)
            print(f"{name}: {count} mutants, exit codes {outcomes}, at most {worst_time:.2f} s and "
                  f"{worst_memory / 1024:.0f} MiB", flush=True)
    return beyond


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda text: str(Path(text).resolve()))
    parser.add_argument("count", type=int)
    parser.add_argument("command", type=str.split)
    parser.add_argument("seed_files", metavar="seed_file", type=Path, nargs="+")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--in-zip", action="store_true")
    parser.add_argument("--most-memory", type=float, default=64.0)
    parser.add_argument("--most-time", type=float, default=2.0)
    options = parser.parse_args()
    if "{}" not in options.command:
        parser.error("the command has no {}")
    seeds = [(file.name, file.read_bytes()) for file in options.seed_files]
    return 1 if measure([options.program, *options.command], seeds, options.count, random.Random(options.seed),
                        options.most_memory, options.most_time, options.in_zip) else 0


if __name__ == "__main__":
    sys.exit(main())
