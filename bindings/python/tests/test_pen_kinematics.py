"""Speed, velocity peaks, smoothness and DTW distance of pens, against their definitions written again with NumPy."""

import math
import os
import pathlib

import numpy as np
import pytest

import calligraphy as cal
from pages import ROOT

SAME = 1e-9  # relative
TRACES = os.environ.get("CALLIGRAPHY_PEN_TRACES", "")
PEOPLE = pathlib.Path(TRACES) / "handwriting_zh_TW.txt"
people = pytest.mark.skipif(not TRACES, reason="CALLIGRAPHY_PEN_TRACES names no directory of pen traces")


def smoothed(samples):
    """The low-passed path at even steps, and the step."""
    times, first_of_reversed = np.unique(samples[::-1, 2], return_index=True)
    places = samples[::-1][first_of_reversed, :2]
    times = times - times[0]
    count = min(max(int(np.round(200 * times[-1])), 1), 4095) + 1
    grid, step = np.linspace(0, times[-1], count, retstep=True)
    even = np.column_stack([np.interp(grid, times, axis) for axis in (places - places[0]).T])
    sigma = math.sqrt(math.log(2)) / (2 * math.pi * 10) / step
    reach = math.floor(4 * sigma)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    padded = np.pad(even, ((reach, reach), (0, 0)), mode="reflect", reflect_type="odd")
    return np.column_stack([np.convolve(axis, kernel / kernel.sum(), mode="valid") for axis in padded.T]), step


def peaks_by_prominence(speed, least):
    """Local maxima one by one, each walked down from on both sides until something is higher."""
    profile = np.concatenate([[0.0], speed, [0.0]])
    found = 0
    for i in range(1, len(profile) - 1):
        if not profile[i - 1] < profile[i] >= profile[i + 1]:
            continue
        left = i
        while left > 0 and profile[left - 1] < profile[i]:
            left -= 1
        right = i
        while right < len(profile) - 1 and profile[right + 1] <= profile[i]:
            right += 1
        base = max(profile[left : i + 1].min(), profile[i : right + 1].min())
        found += profile[i] - base >= least
    return found


def sparc(speed, rate):
    size = 2 ** (math.ceil(math.log2(len(speed))) + 4)
    frequencies, magnitude = np.fft.rfftfreq(size, 1 / rate), np.abs(np.fft.rfft(speed, size))
    magnitude = magnitude[frequencies <= 10] / magnitude[0]
    last = np.flatnonzero(magnitude >= 0.05)[-1]
    frequencies = frequencies[: last + 1] / frequencies[last]
    return -np.hypot(np.diff(frequencies), np.diff(magnitude[: last + 1])).sum()


def expected(samples):
    path, step = smoothed(samples)
    duration, length = np.ptp(samples[:, 2]), np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
    speed = np.linalg.norm(np.gradient(path, step, axis=0), axis=1)
    return {
        "duration": duration,
        "path_length": length,
        "mean_speed": length / duration,
        "peak_speed": speed.max(),
        "velocity_peaks": peaks_by_prominence(speed, 0.05 * speed.max()),
        "smoothness": sparc(speed, 1 / step),
    }


def dtw(one, other, count=64):
    """The least sum of every pairing, top down: the last pair, and the best way to it."""

    def resampled(path):
        along = np.concatenate([[0.0], np.linalg.norm(np.diff(path, axis=0), axis=1).cumsum()])
        return np.column_stack([np.interp(np.linspace(0, along[-1], count), along, axis) for axis in path.T])

    rows, columns = resampled(np.asarray(one, float)), resampled(np.asarray(other, float))
    costs = np.linalg.norm(rows[:, None] - columns[None], axis=2)
    best = {}
    for i, j in np.ndindex(count, count):
        cost = costs[i, j]
        ways = [best[i - 1, j] + cost] if i else []
        ways += [best[i, j - 1] + cost] if j else []
        ways += [best[i - 1, j - 1] + 2 * cost] if i and j else []
        best[i, j] = min(ways, default=2 * cost)
    return best[count - 1, count - 1] / (2 * count)


def check(traces, least):
    """Compares every pen-down that moves for long enough, and every two neighbours; returns the measures."""
    measures = []
    for trace in traces:
        downs = [down for down in trace.strokes if np.ptp(down[:, 2]) >= 0.05 and np.ptp(down[:, :2], axis=0).any()]
        for down in downs:
            measured = cal.pen_kinematics(down)
            for name, value in expected(down).items():
                assert getattr(measured, name) == pytest.approx(value, rel=SAME, abs=0), name
            measures.append(measured)
        for one, other in zip(downs, downs[1:]):
            assert cal.dtw_distance(one[:, :2], other[:, :2]) == pytest.approx(
                dtw(one[:, :2], other[:, :2]), rel=SAME, abs=0
            )
    assert len(measures) >= least
    return measures


def test_written_examples_are_measured_as_defined():
    measures = check(cal.read_pen_traces(ROOT / "examples" / "pupil.txt"), least=6)
    assert all(-2.5 < each.smoothness < -1.3 and 1 <= each.velocity_peaks <= 5 for each in measures)


@pytest.mark.parametrize("seconds", [0.06, 0.3, 2.0, 26.0])
def test_restless_pens_are_measured_as_defined(seconds):
    """Random walks at uneven times, some of them repeated, also longer than what is sampled at 200 Hz."""
    random = np.random.default_rng(7)
    for _ in range(12):
        times = np.sort(np.round(random.uniform(0, seconds, int(120 * seconds)), 3))
        times[[0, -1]] = 0, seconds
        walk = random.normal(0, 0.01, (len(times), 2)).cumsum(axis=0)
        check([cal.PenTrace("一", [np.column_stack([walk, times + 80_000])])], least=1)


@people
def test_pens_of_people_are_measured_as_defined():
    traces = cal.read_pen_traces(PEOPLE)
    chosen = sorted(traces, key=lambda trace: sum(map(len, trace.strokes)))[:: max(1, len(traces) // 2)]
    assert len(chosen) >= 3
    check(chosen, least=10)
