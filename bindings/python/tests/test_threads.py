"""Threads: the GIL is released during long C++ calls, and concurrent calls do not interfere."""

import concurrent.futures
import os
import pathlib
import subprocess
import sys
import threading

import numpy as np
import pytest

import calligraphy as cal

PROFILE = cal.device_profile("desktop")
CHARACTERS = cal.built_in_characters()
PAGE = cal.lay_out([CHARACTERS["永"]])[0]
SHORT = cal.lay_out([CHARACTERS["一"]])[0]
MAPPING = cal.upright_page(PAGE.width, PAGE.height)
OPTIONS = cal.SessionOptions(device=PROFILE, renderer=cal.RendererOptions.for_device(PROFILE))
RECORDING = cal.write_page(SHORT, OPTIONS)
WRITING = cal.LessonWriting(page=SHORT, strokes=[cal.LessonStroke(fate="accepted", pen_down=0)], recording=RECORDING)
CUBIC = np.array([[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 0.5]])
LOOP = cal.SampledLoop(device=cal.Capabilities(apparent_mass=0.045, viscous_friction=0.1, peak_force=7.9))
LINE = np.column_stack([np.linspace(0.1, 0.9, 30), np.full(30, 0.5)])
TRACE = cal.PenTrace("一", [np.column_stack([LINE, np.linspace(0, 1, 30)])], set="made")
SMALL_MAP = cal.StabilityMapOptions(
    with_sweeps=False, per_decade=1, dampings=[0.5], rates=[1000.0], delays=[0], encoder_steps=[0.0],
    wall_dampings=[0.0], grips=[cal.GripImpedance(mass=0, damping=0, stiffness=0)], contact=cal.WallContact(seconds=0.1),
)  # fmt: skip


def renderer():
    return cal.HapticRenderer(PAGE.characters, MAPPING, PROFILE)


def others_run_while(call):
    """Whether another Python thread runs during the call.

    Threads of Python take turns by the clock; here they never do, so that another one runs only when this one lets it:
    by giving the GIL away, or at its end. The other one waits for its turn; that the system wakes it in time is no
    promise, so there are many calls.
    """
    interval = sys.getswitchinterval()
    begun, ran = threading.Lock(), []
    seen = []
    begun.acquire()

    def other():
        begun.acquire()
        ran.append(True)

    def worker():
        begun.release()
        for _ in range(3000):
            call()
            if ran:
                break
        seen.append(bool(ran))

    threads = [threading.Thread(target=other), threading.Thread(target=worker)]
    sys.setswitchinterval(1e3)
    try:
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        sys.setswitchinterval(interval)
    return seen[0]


def released(tmp_path):
    """Calls that must release the GIL."""
    file, characters = tmp_path / "one.recording.gz", tmp_path / "characters.txt"
    traces = tmp_path / "traces.txt"
    cal.write_recording(file, RECORDING)
    cal.write_characters(str(characters), CHARACTERS)
    cal.write_pen_traces(traces, [TRACE])
    whole, states, many = renderer(), np.zeros((2000, 3)), np.zeros((1000, 2))  # NumPy's zeros also release the GIL
    stored = cal.CharacterSet(CHARACTERS)
    placed = PAGE.characters[0]
    replayed = cal.device_states(RECORDING, cal.upright_page(SHORT.width, SHORT.height))
    return {
        "nearest_point": lambda: cal.nearest_point(CUBIC, many),
        "nearest_points": lambda: cal.nearest_points(placed.character, many, placed.placement),
        "trace": lambda: whole.trace(states),
        "write_page": lambda: cal.write_page(SHORT, OPTIONS),
        "follow_trace": lambda: cal.follow_trace(SHORT, TRACE, OPTIONS),
        "replay_page": lambda: cal.replay_page(SHORT, cal.ReplayDevice(replayed, PROFILE), OPTIONS),
        "score": lambda: cal.score_page(SHORT, RECORDING),
        "score_lesson": lambda: cal.score_lesson(WRITING),
        "write_recording": lambda: cal.write_recording(file, RECORDING),
        "read_recording": lambda: cal.read_recording(file),
        "replayed": lambda: cal.replayed(RECORDING),
        "write_ticks": lambda: cal.write_ticks(tmp_path / "ticks.csv", RECORDING),
        "read_pen_traces": lambda: cal.read_pen_traces(str(traces)),
        "write_pen_traces": lambda: cal.write_pen_traces(traces, [TRACE]),
        "import_characters": lambda: cal.import_characters(characters),
        "simulate_wall_contact": lambda: cal.simulate_wall_contact(LOOP, 100.0, cal.WallContact(seconds=0.5)),
        "stability_map": lambda: cal.stability_map(SMALL_MAP),
        "nearest_point_tradeoff": lambda: cal.nearest_point_tradeoff([CHARACTERS["永"]], queries=64, rounds=1),
        "guidance_field": lambda: cal.guidance_field(placed, 0, 0.2, placed.placement.origin, 0.04, columns=12),
        "critical_stiffness": lambda: cal.critical_stiffness(LOOP),
        "advise_stiffness": lambda: cal.advise_stiffness(LOOP),
        "read_characters": lambda: cal.read_characters(str(characters)),
        "write_characters": lambda: cal.write_characters(str(characters), CHARACTERS),
        "encode_character_set": lambda: cal.encode_character_set(CHARACTERS),
        "CharacterSet": lambda: cal.CharacterSet(CHARACTERS),
        "CharacterSet.open": lambda: cal.CharacterSet.open(str(characters)),
        "CharacterSet.list": stored.list,
        "CharacterSet.check": stored.check,
    }


def test_the_gil_is_released_during_long_cpp_calls(tmp_path):
    kept = [name for name, call in released(tmp_path).items() if not others_run_while(call)]
    assert kept == []


def test_the_gil_is_kept_if_releasing_it_would_cost_more_than_the_call():
    element, few = cal.StrokeElement(CUBIC), np.zeros((8, 2))
    assert not others_run_while(lambda: cal.nearest_point(element, few))


def test_renderers_in_several_threads_give_the_same_results_as_one():
    recording = cal.write_page(PAGE, OPTIONS)
    positions = [s.position for s in cal.device_states(recording, MAPPING)]
    expected = renderer().trace(positions)["force"]
    assert np.abs(expected).max() > 0.1
    together = threading.Barrier(4)

    def forces(_):
        together.wait(60)
        return renderer().trace(positions)["force"]

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for result in pool.map(forces, range(8)):
            assert np.array_equal(result, expected)


def test_several_sessions_run_concurrently():
    expected = cal.run_session(SHORT, OPTIONS, straight_down(lambda: None)).samples
    together = threading.Barrier(3)  # breaks unless all sessions are under way

    def write(_):
        return cal.run_session(SHORT, OPTIONS, straight_down(lambda: together.wait(60))).samples

    with concurrent.futures.ThreadPoolExecutor(3) as pool:
        for samples in pool.map(write, range(3)):
            assert np.array_equal(samples, expected)


def straight_down(in_the_middle):
    """A motion of 100 ticks, which calls the given function half-way."""
    ticks = 0

    def motion(tick, seconds):
        nonlocal ticks
        ticks += 1
        if ticks == 50:
            in_the_middle()
        if ticks > 100:
            return None
        return cal.Intention(position=(SHORT.width / 2, SHORT.height / 2, 0.01 - 2e-4 * ticks))

    return motion


def test_a_renderer_can_be_used_by_only_one_thread_at_a_time():
    positions = np.tile([s.position for s in cal.device_states(RECORDING, MAPPING)], (150, 1))
    expected, shared, traced, refused = renderer().trace(positions), renderer(), [], []
    thread = threading.Thread(target=lambda: traced.append(shared.trace(positions)))
    thread.start()
    state = cal.DeviceState(position=(0, 0, 0.01))
    uses = [lambda: shared.update(state), lambda: shared.trace(positions[:3]), lambda: shared.last]
    uses += [shared.restart, shared.skip_stroke]
    while thread.is_alive() and len(refused) < len(uses):
        try:
            shared.last  # no effect if it is not rejected
        except cal.Error:
            for use in uses:
                with pytest.raises(cal.Error, match="the renderer is in use by another thread"):
                    use()
                refused.append(use)
    thread.join()
    assert len(refused) == len(uses) and np.array_equal(traced[0], expected)
    shared.restart()
    assert np.array_equal(shared.trace(positions[:100]), expected[:100])


#: Freed memory is filled with a pattern, so that a read after free does not find the old values.
FILLED = {**os.environ, "MALLOC_PERTURB_": "165", "PYTHONPATH": str(pathlib.Path(cal.__file__).parents[1])}
ASSIGNING = """
import sys, threading
import calligraphy as cal

device, characters = cal.device_profile("desktop"), cal.built_in_characters()
page = cal.lay_out([characters["一"]])[0]
options = cal.SessionOptions(device=device, renderer=cal.RendererOptions.for_device(device))
written = cal.write_page(page, options)
recording = cal.Recording(written.rate, written.samples)  # of any page
many, everything = page.characters * 50, list(characters)
calls = {
    "score": (lambda page: repr(cal.score_page(page, recording)), cal.PracticePage(width=0.16, height=0.12), many),
    "encode_character_set": (cal.encode_character_set, cal.CharacterList(), everything),
    "CharacterSet": (lambda of: len(cal.CharacterSet(of)), cal.CharacterList(), everything),
    "write_characters": (lambda of: cal.write_characters(sys.argv[1], of), cal.CharacterList(), everything),
}
sys.setswitchinterval(1e-5)
for name, (call, owner, full) in calls.items():
    owner.characters = full
    expected, ended = call(owner), threading.Event()
    def assign():
        while not ended.is_set():
            owner.characters = full
    other = threading.Thread(target=assign)
    other.start()
    try:
        for _ in range(30):
            assert call(owner) == expected, name
    finally:
        ended.set()
        other.join()
"""


def test_another_thread_may_assign_to_the_arguments_of_a_running_call(tmp_path):
    """In a separate process, because reading freed memory may kill it by a signal."""
    done = subprocess.run(
        [sys.executable, "-c", ASSIGNING, str(tmp_path / "written")], capture_output=True, text=True, env=FILLED, timeout=300
    )
    assert done.returncode == 0, done.stderr[-2000:]


def test_one_set_of_characters_serves_several_threads():
    stored = cal.CharacterSet(CHARACTERS)
    expected = {c.code: c for c in stored.list().characters}

    def read(code):
        return stored[code] == stored.find(code) == expected[code]

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        assert all(pool.map(read, list(expected) * 4))


@pytest.mark.parametrize("where", ["session", "map", "tradeoff"])
def test_an_exception_of_a_callback_propagates_from_another_thread(where):
    def broken(*_):
        raise ZeroDivisionError(where)

    calls = {
        "session": lambda: cal.run_session(SHORT, OPTIONS, broken),
        "map": lambda: cal.stability_map(SMALL_MAP, broken),
        "tradeoff": lambda: cal.nearest_point_tradeoff([CHARACTERS["永"]], queries=64, rounds=1, progress=broken),
    }
    with concurrent.futures.ThreadPoolExecutor(1) as pool, pytest.raises(ZeroDivisionError, match=where):
        pool.submit(calls[where]).result()
