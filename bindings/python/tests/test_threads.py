"""Threads: the GIL is released wherever C++ works for long, and what runs at the same time is not mixed up."""

import concurrent.futures
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
OPTIONS = cal.SessionOptions(device=PROFILE, renderer=cal.RendererOptions.for_device(PROFILE.capabilities))
RECORDING = cal.write_page(SHORT, OPTIONS)
CUBIC = np.array([[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 0.5]])
LOOP = cal.SampledLoop(mass=0.045, damping=0.1)
LINE = np.column_stack([np.linspace(0.1, 0.9, 30), np.full(30, 0.5)])
TRACE = cal.PenTrace("一", [np.column_stack([LINE, np.linspace(0, 1, 30)])], set="made")
SMALL_MAP = cal.StabilityMapOptions(
    with_sweeps=False, per_decade=1, dampings=[0.5], rates=[1000.0], delays=[0], encoder_steps=[0.0],
    wall_dampings=[0.0], grips=[cal.GripImpedance(mass=0, damping=0, stiffness=0)],
    contact=cal.WallContact(seconds=0.1),
)  # fmt: skip


def renderer():
    return cal.HapticRenderer(PAGE.characters, MAPPING, PROFILE.capabilities)


def others_run_while(call):
    """Whether another thread of Python gets its turn within the call.

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
    """Calls that must let other threads run."""
    file, text, characters = tmp_path / "one.csv", RECORDING.to_csv(), tmp_path / "characters.txt"
    traces = tmp_path / "traces.txt"
    cal.write_recording(file, RECORDING)
    cal.write_characters(str(characters), CHARACTERS)
    cal.write_pen_traces(traces, [TRACE])
    whole, states, many = renderer(), np.zeros((2000, 3)), np.zeros((1000, 2))  # NumPy's zeros release it, too
    stored = cal.CharacterSet(CHARACTERS)
    placed = PAGE.characters[0]
    replayed = cal.device_states(RECORDING, cal.upright_page(SHORT.width, SHORT.height))
    return {
        "nearest_point": lambda: cal.nearest_point(CUBIC, many),
        "trace": lambda: whole.trace(states),
        "write_page": lambda: cal.write_page(SHORT, OPTIONS),
        "follow_trace": lambda: cal.follow_trace(SHORT, TRACE, OPTIONS),
        "replay_page": lambda: cal.replay_page(SHORT, cal.ReplayDevice(replayed, PROFILE.capabilities), OPTIONS),
        "score": lambda: cal.score_page(SHORT, RECORDING),
        "to_csv": RECORDING.to_csv,
        "write_recording": lambda: cal.write_recording(file, RECORDING),
        "read_recording": lambda: cal.read_recording(file),
        "read_csv_text": lambda: cal.read_csv_text(text),
        "read_pen_traces": lambda: cal.read_pen_traces(str(traces)),
        "write_pen_traces": lambda: cal.write_pen_traces(traces, [TRACE]),
        "page_picture": lambda: cal.page_picture(SHORT, RECORDING, 0, "title"),
        "typical_strokes_picture": cal.typical_strokes_picture,
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
        "fit_stroke": lambda: cal.fit_stroke(LINE),
        "stroke_warnings": lambda: cal.stroke_warnings(CHARACTERS["永"]),
    }


def test_the_gil_is_released_wherever_cpp_works_for_long(tmp_path):
    kept = [name for name, call in released(tmp_path).items() if not others_run_while(call)]
    assert kept == []


def test_the_gil_is_kept_where_giving_it_away_would_cost_more_than_the_call():
    element, few = cal.StrokeElement(CUBIC), np.zeros((8, 2))
    assert not others_run_while(lambda: cal.nearest_point(element, few))


def test_several_renderers_in_several_threads_do_what_one_does():
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


def test_several_sessions_are_under_way_at_the_same_time():
    expected = cal.run_session(SHORT, OPTIONS, straight_down(lambda: None)).samples
    together = threading.Barrier(3)  # broken unless every session is in its middle

    def write(_):
        return cal.run_session(SHORT, OPTIONS, straight_down(lambda: together.wait(60))).samples

    with concurrent.futures.ThreadPoolExecutor(3) as pool:
        for samples in pool.map(write, range(3)):
            assert np.array_equal(samples, expected)


def straight_down(in_the_middle):
    """A motion of 100 ticks; half way it does what it is told to."""
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


def test_one_set_of_characters_serves_several_threads():
    stored = cal.CharacterSet(CHARACTERS)
    expected = {c.code: c for c in stored.list().characters}

    def read(code):
        return stored[code] == expected[code] and stored.find(code).character() == expected[code]

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        assert all(pool.map(read, list(expected) * 4))


@pytest.mark.parametrize("where", ["session", "map", "tradeoff"])
def test_what_a_callback_raises_comes_back_from_another_thread(where):
    def broken(*_):
        raise ZeroDivisionError(where)

    calls = {
        "session": lambda: cal.run_session(SHORT, OPTIONS, broken),
        "map": lambda: cal.stability_map(SMALL_MAP, broken),
        "tradeoff": lambda: cal.nearest_point_tradeoff([CHARACTERS["永"]], queries=64, rounds=1, progress=broken),
    }
    with concurrent.futures.ThreadPoolExecutor(1) as pool, pytest.raises(ZeroDivisionError, match=where):
        pool.submit(calls[where]).result()
