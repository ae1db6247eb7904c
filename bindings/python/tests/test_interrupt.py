"""Ctrl-C within the calls that take long, and their progress."""

import os
import signal
import threading

import numpy as np
import pytest

import calligraphy as cal
from calligraphy import experiment

PROFILE = cal.device_profile("desktop")


@pytest.fixture(autouse=True)
def python_s_own_handler():
    """A shell that runs the tests in the background has Ctrl-C ignored, and so would they."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def ctrl_c():
    """Presses it once something is in the list. Lists and their append() never look for signals themselves."""
    threads, given_up = [], threading.Event()

    def press_when(seen):
        def run():
            while not seen and not given_up.wait(1e-3):
                pass
            if not given_up.is_set():
                os.kill(os.getpid(), signal.SIGINT)

        threads.append(threading.Thread(target=run))
        threads[-1].start()

    yield press_when
    given_up.set()
    for thread in threads:
        thread.join()


def session(**fields):
    return cal.SessionOptions(
        device=PROFILE,
        renderer=cal.RendererOptions.for_device(PROFILE),
        skill=cal.WriterSkill.novice(),
        **fields,
    )


def long_page(count=40):
    placed = cal.lay_out([cal.built_in_characters()["永"]])[0].characters[0]
    return cal.PracticePage(width=0.16, height=0.12, characters=[placed] * count)


def characters(count=1):
    return [cal.built_in_characters()["永"]] * count


def long_trace():
    points = np.tile([[0.5, 0.5]], (2, 1))
    return cal.PenTrace("永", [np.column_stack([points, [0.0, 2000.0]])])


def long_replay():
    state = cal.DeviceState
    down = np.array([0.0, 0.0, -1e-3])
    return cal.ReplayDevice([state(time=i * 1e-3, position=down) for i in range(200_000)], PROFILE)


def drawings(tmp_path, count=1000):
    heng = '{"medians":[[[100,400],[900,400]],[[512,800],[512,0]]]}'
    for i in range(count):
        (tmp_path / f"{chr(0x4E00 + i)}.json").write_text(heng, encoding="utf-8")
    return tmp_path


LONG = {
    "write_page": lambda progress, _: cal.write_page(long_page(), session(), progress),
    "follow_trace": lambda progress, _: cal.follow_trace(
        long_page(1), long_trace(), session(character_timeout=2000.0), progress
    ),
    "replay_page": lambda progress, _: cal.replay_page(
        long_page(1), long_replay(), session(measure_ticks=True), progress
    ),
    "run_session": lambda progress, _: cal.run_session(
        long_page(1), session(character_timeout=1e4), lambda tick, seconds: cal.Intention(), progress
    ),
    "stability_map": lambda progress, _: cal.stability_map(cal.StabilityMapOptions(), progress),
    "nearest_point_tradeoff": lambda progress, _: cal.nearest_point_tradeoff(characters(), 1000, 200, progress=progress),
    "servo_rate_tradeoff": lambda progress, _: cal.servo_rate_tradeoff(
        characters(), [1000.0, 4000.0, 8000.0], progress=progress
    ),
    "coordinate_width_tradeoff": lambda progress, _: cal.coordinate_width_tradeoff(characters(500), progress),
    "import_characters": lambda progress, path: cal.import_characters(drawings(path), threads=1, progress=progress),
}


@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_ends_a_long_call_before_its_work_is_done(name, ctrl_c, tmp_path):
    shares = []
    ctrl_c(shares)
    with pytest.raises(KeyboardInterrupt):
        LONG[name](shares.append, tmp_path)
    assert shares and shares[-1] < 1.0
    assert sorted(shares) == shares


def test_a_call_with_no_progress_to_tell_looks_for_signals_while_it_works():
    seen = []
    before = signal.signal(signal.SIGALRM, lambda *_: seen.append(1))
    points = np.random.default_rng(1).normal(size=(1_000_000, 2))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
        result = cal.nearest_point([[0, 0], [1, 2], [2, -1], [3, 0], [4, 4]], points, tolerance=1e-12)
        during = len(seen)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert during >= 3  # signals that come while nobody looks are one
    assert result.certified.all()


def a_renderer():
    return cal.HapticRenderer(long_page(1).characters, cal.MotionMapping(), PROFILE)


def test_ctrl_c_ends_a_field_of_many_places():
    class Pressed(Exception):
        pass

    def press(*_):
        seen.append(1)
        if len(seen) == 3:  # of the signals that come while nobody looks one is left when the call returns
            raise Pressed

    seen = []
    before = signal.signal(signal.SIGALRM, press)
    try:
        with pytest.raises(Pressed):
            signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
            cal.guidance_field(long_page(1).characters[0], 0, 0.5, (0, 0), 0.04, columns=1500)
            signal.setitimer(signal.ITIMER_REAL, 0)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_ctrl_c_ends_a_long_trace_after_which_the_renderer_begins_anew():
    positions = np.tile([0.0, 0.0, -1e-3], (600_000, 1))
    renderer = a_renderer()
    expected = renderer.trace(positions[:100])
    renderer.restart()

    def press(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, press)
    try:
        with pytest.raises(KeyboardInterrupt):
            signal.setitimer(signal.ITIMER_REAL, 0.001)
            renderer.trace(positions)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert renderer.last.time < 599
    renderer.restart()
    assert (renderer.trace(positions[:100]) == expected).all()


def test_what_a_signal_s_handler_raises_is_raised():
    class Enough(Exception):
        pass

    def handler(*_):
        raise Enough

    before = signal.signal(signal.SIGALRM, handler)
    try:
        with pytest.raises(Enough):
            signal.setitimer(signal.ITIMER_REAL, 0.02)
            cal.write_page(long_page(), session())
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_what_progress_raises_ends_the_call():
    def progress(share):
        if share > 0.1:
            raise LookupError("enough")

    for call in (
        lambda: cal.write_page(long_page(), session(), progress),
        lambda: cal.coordinate_width_tradeoff(characters(20), progress),
        lambda: cal.stability_map(cal.StabilityMapOptions(with_grid=False, per_decade=1), progress),
    ):
        with pytest.raises(LookupError, match="enough"):
            call()


def test_progress_goes_to_the_end_and_changes_nothing():
    page = long_page(1)
    shares = []
    told = cal.write_page(page, session(seed=4), shares.append)
    assert shares[-1] == 1.0 and sorted(shares) == shares and len(shares) > 10
    assert (told.samples == cal.write_page(page, session(seed=4)).samples).all()
    shares.clear()
    rows = cal.coordinate_width_tradeoff(characters(), shares.append)
    assert shares[-1] == pytest.approx(1.0) and rows["bits"].tolist() == list(range(4, 17))


def test_in_another_thread_a_long_call_goes_on_whatever_is_pressed():
    done = []
    page = long_page(2)
    thread = threading.Thread(target=lambda: done.append(cal.write_page(page, session())))
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), signal.SIGINT)
        thread.join()
    thread.join()
    assert len(done) == 1 and cal.score_page(page, done[0])[1].strokes_completed > 0


def test_ctrl_c_ends_an_experiment():
    grid = experiment.Grid("永", seeds=500)
    with pytest.raises(KeyboardInterrupt):
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
        experiment.run(grid, progress=False)


def test_ctrl_c_while_a_person_writes_lets_the_force_fall_and_keeps_what_was_written(ctrl_c):
    page = cal.lay_out(characters())[0]
    device = cal.PointerDevice(PROFILE)
    views = []
    ctrl_c(views)
    options = cal.LiveOptions(renderer=cal.RendererOptions.for_device(PROFILE), timeout=300.0)
    options.servo = cal.ServoLoopOptions(
        servo=cal.ServoOptions(timeout=1.0), thread=cal.ServoThreadOptions(priority=0, lock_memory=False)
    )
    with pytest.raises(KeyboardInterrupt) as pressed:
        cal.write_with_device(page, device, options, views.append)
    result = pressed.value.result
    assert len(result.recording) > 0 and result.statistics["ticks"] > 0
    assert device.read().status == cal.DeviceStatus.ok  # no loop has it any more, and it is open


def test_ctrl_c_ends_a_loop_by_its_with_block(ctrl_c):
    seen = []
    ctrl_c(seen)
    loop = cal.ServoLoop(cal.PointerDevice(PROFILE), lambda state: (seen.append(1), (0.0, 0.0, 0.0))[1])
    with pytest.raises(KeyboardInterrupt):
        with loop:
            threading.Event().wait(60)
    assert not loop.running and loop.status.phase == cal.ServoPhase.zero
