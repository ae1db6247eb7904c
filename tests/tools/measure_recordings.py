"""Measures what is left of recordings when a program is killed, a disk is full or a file is damaged (docs/recordings.md).

usage: measure_recordings.py PROGRAM [--kills N --emulated EMULATED_PHANTOM] [--mutants N] [--seed N]

--kills kills the program while a person, simulated behind an emulated Phantom, writes with it, at random moments. How many
samples the device had sent until then is what the emulated device says, not the program.
"""
import argparse
import gzip
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

from measure_mutants import measure

#: Starts the program and notes its process.
SHIM = '#!/bin/sh\necho $$ > "$PID_FILE"\nexec "$PROGRAM" "$@"\n'


def replayed(program, path):
    done = subprocess.run([program, "replay", path, "--json"], capture_output=True, text=True)
    return done, json.loads(done.stdout)["recordings"][0] if done.stdout else None


def kill_once(program, emulated, directory, seconds):
    """How much longer the device had sent reports, 1000 a second, than there are in the recording [s]; ticks kept."""
    shim, pid = directory / "shim", directory / "pid"
    shim.write_text(SHIM)
    shim.chmod(0o755)
    out = directory / "out"
    running = subprocess.Popen([emulated, "--write", "永", "--", str(shim), "write", "永永永永", "--device", "phantom", "--out",
                                str(out)], cwd=directory, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               env={**os.environ, "PROGRAM": str(program), "PID_FILE": str(pid)})
    while not list(out.glob("*.part")):
        time.sleep(0.005)
    time.sleep(seconds)
    os.kill(int(pid.read_text()), signal.SIGKILL)
    _, told = running.communicate()
    sent = int(re.search(r"(\d+) reports sent", told).group(1))
    part, = out.glob("*.part")
    done, kept = replayed(program, part)
    assert done.returncode == 0 and kept["complete"] is False, done.stderr
    assert json.loads((out / "summary.json").read_text())["finished"] is False
    raw = part.read_bytes()
    text = zlib.decompressobj(wbits=31).decompress(raw).decode()
    first = float(text.partition("\nticks\n")[2].partition("\n")[0].partition(",")[0])
    subprocess.run([program, "replay", part, "--out", directory / "table", "--ticks"], check=True, capture_output=True)
    table, = (directory / "table").glob("*-ticks.csv")
    last = first + float(table.read_text().splitlines()[-1].partition(",")[0])
    return sent / 1000.0 - last, kept["ticks"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda text: Path(text).resolve())
    parser.add_argument("--emulated")
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--mutants", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    draw = random.Random(options.seed)
    if options.kills > 0:
        lost, ticks = [], 0
        for _ in range(options.kills):
            with tempfile.TemporaryDirectory() as directory:
                seconds, kept = kill_once(options.program, options.emulated, Path(directory), draw.uniform(2.0, 8.0))
            lost.append(seconds)
            ticks += kept
            print(f"{len(lost)}: {kept} ticks kept, {seconds:.3f} s lost", file=sys.stderr)
        print(f"killed {len(lost)} times, with {ticks} ticks kept: the device had sent at most {max(lost):.3f} s more than "
              "was kept")
    if options.mutants > 0:
        mutate(options.program, options.mutants, draw)


def mutate(program, count, draw):
    """Damages recordings, compressed and plain, and pen traces of version 2, and reads them."""
    with tempfile.TemporaryDirectory() as name:
        directory = Path(name)
        subprocess.run([program, "write", "十", "--mode", "force", "--out", directory / "out"], check=True,
                       capture_output=True)
        whole = (directory / "out/page-1-force-1.recording.gz").read_bytes()
        text = gzip.decompress(whole)
        plain = text[:text.index(b"\nticks\n") + 3000]
        traces = ("V 2\nC 十 5341 made-up 1000 2 1\nF pressure altitude azimuth twist height buttons\n"
                  "S 2 100 500 0 0.25 1.1 0.7 -2 0 1 900 480 330 0.5 1.1 0.7 -2 - 1\n"
                  "A 1 500 300 600 0 1 1 1 0.01 0\nS 2 500 80 900 0.25 1 1 1 0 33 500 940 1400 - 1 1 1 0 1\n").encode()
        seeds = {"recording.gz": whole, "recording": plain, "traces.txt": traces, "traces.gz": gzip.compress(traces)}
        measure([str(program), "replay", "{}", "--json"], seeds.items(), count // len(seeds), draw)


if __name__ == "__main__":
    main()
