"""Overhead of Python: batched calls relative to the C++ loop, single calls, an experiment relative to real time.

usage: python python_overhead.py C++_PROGRAM     the program is benchmarks/python_batch, which prints its ns per query
Prints figures and asserts nothing.
"""

from __future__ import annotations

import subprocess
import sys
import time
import timeit

import numpy as np

import calligraphy as cal
from calligraphy import experiment

CUBIC = np.array([[0.0, 0.0], [0.01, 0.02], [0.02, -0.01], [0.03, 0.005]])


def queries(count: int) -> np.ndarray:
    """The queries of python_batch.cpp: a spiral around the curve."""
    i = np.arange(count)
    angle, radius = 0.7 * i, 0.005 + 0.01 * ((i * 37) % 1000) / 1000
    return np.column_stack([0.015 + radius * np.cos(angle), 0.004 + radius * np.sin(angle)])


def per_call(function, number: int) -> float:
    """Fastest of seven runs in processor time [s], the measure least disturbed by other programs."""
    return min(timeit.repeat(function, number=number, repeat=7, timer=time.process_time)) / number


def main() -> None:
    for count in (1_000, 100_000):
        asked, element = queries(count), cal.StrokeElement(CUBIC)
        rounds = max(1, 200_000 // count)
        for method in ("exact", "sampled", "wang2006"):
            mine = loop = np.inf
            for _ in range(5):  # alternating, so that other programs slow both
                mine = min(mine, per_call(lambda: cal.nearest_point(element, asked, method), rounds) / count * 1e9)
                told = subprocess.run([sys.argv[1], str(count), method], capture_output=True, text=True, check=True)
                loop = min(loop, float(told.stdout))
            print(f"{count:7} queries, {method:9} C++ {loop:6.1f} ns, Python {mine:6.1f} ns: ratio {mine / loop:.2f}")

    profile = cal.device_profile("desktop")
    page = cal.lay_out([cal.built_in_characters()["永"]])[0]
    mapping = cal.upright_page(page.width, page.height)
    renderer = cal.HapticRenderer(page.characters, mapping, profile)
    state = cal.DeviceState(position=(0, 0, 0.01))
    print(f"one nearest point   {1e6 * per_call(lambda: cal.nearest_point(CUBIC, CUBIC[:1]), 5000):6.2f} us")
    print(f"renderer.update     {1e6 * per_call(lambda: renderer.update(state), 20000):6.2f} us")
    positions = np.zeros((100_000, 3)) + [0, 0, 0.01]
    print(f"renderer.trace      {1e6 * per_call(lambda: renderer.trace(positions), 1) / 1e5:6.2f} us per tick")

    class Mine(cal.HapticDevice):
        def capabilities(self):
            return profile

        def read(self):
            return state

        def write(self, force):
            pass

        def close(self):
            pass

    clock = iter(range(10**9))
    device = cal.SimulatedDevice(profile)

    def tick(servo):
        device.advance(1e-3)
        servo.step(next(clock) * 1e-3)

    in_python, both = cal.Servo(device, lambda s: (0, 0, 0)), cal.Servo(Mine(), lambda s: (0, 0, 0))
    print(f"tick, law in Python {1e6 * per_call(lambda: tick(in_python), 20000):6.2f} us")
    print(f"and device          {1e6 * per_call(lambda: tick(both), 20000):6.2f} us")

    grid = experiment.Grid("永和九年", seeds=5)
    experiment.run(experiment.Grid("一"), progress=False)  # imports
    began = time.process_time()
    table = experiment.run(grid, progress=False)
    spent = time.process_time() - began
    simulated = float(np.sum(np.asarray(table["simulated_time"])))
    print(f"an experiment of {len(grid)} trials: {simulated:.0f} s written in {spent:.2f} s of one core, {simulated / spent:.0f} times real time")


if __name__ == "__main__":
    main()
