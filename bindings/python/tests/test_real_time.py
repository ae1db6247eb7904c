"""Real-time loops. The machine may be slow: no test depends on wall-clock time."""

import gc
import os
import pathlib
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest

import calligraphy as cal

PROFILE = cal.device_profile("desktop")
#: Faults detected by the watchdog's clock, which may occur on a busy machine.
PATIENT = cal.ServoOptions(timeout=1.0, ramp_up=0.05)
PRESSED = (0.0, 0.0, -1e-3)


def options(servo=PATIENT, **thread):
    return cal.ServoLoopOptions(
        servo=servo, thread=cal.ServoThreadOptions(**{"priority": 0, "lock_memory": False, **thread})
    )


def until(condition):
    """Waits for at most a minute."""
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end, "nothing happens"
        time.sleep(1e-3)


class Bench(cal.HapticDevice):
    """A pen at rest 1 mm below the paper, which records its commands."""

    def __init__(self):
        super().__init__()
        self.ticks, self.forces, self.closed = 0, [], False

    def capabilities(self):
        return PROFILE

    def read(self):
        self.ticks += 1
        return cal.DeviceState(time=self.ticks * 1e-3, position=PRESSED, velocity=(0, 0, 0))

    def write(self, force):
        self.forces.append(force[2])

    def close(self):
        self.closed = True


def wall(state):
    return 0.0, 0.0, max(0.0, -1000.0 * state.position[2])


def one_page(text="一"):
    characters = cal.built_in_characters()
    size = PROFILE.workspace
    return cal.lay_out([characters[code] for code in text], cal.PageLayout(width=size[0], height=size[1]))[0]


def renderer_of(page):
    return cal.HapticRenderer(
        page.characters, cal.upright_page(page.width, page.height), PROFILE,
        cal.RendererOptions.for_device(PROFILE),
    )  # fmt: skip


def test_the_force_ramps_up_to_that_of_the_law_and_down_to_zero_when_the_loop_stops():
    device = Bench()
    loop = cal.ServoLoop(device, wall, options())
    loop.start()
    until(lambda: loop.status.phase == cal.ServoPhase.running and device.forces and device.forces[-1] == 1.0)
    loop.stop()
    forces = np.array(device.forces)
    assert forces[0] == 0.0 and forces[-1] == 0.0 and forces.max() == 1.0
    top = len(forces) - 1 - np.argmax(forces[::-1])
    assert (np.diff(forces[: np.argmax(forces) + 1]) >= 0).all()
    assert (np.diff(forces[top:]) <= 0).all() and len(forces) - top > 2
    assert not loop.running and loop.status.phase == cal.ServoPhase.zero
    told = len(device.forces)
    time.sleep(0.01)
    assert len(device.forces) == told


def test_statistics_are_available_while_the_loop_runs_and_afterwards():
    with cal.ServoLoop(Bench(), wall, options()) as loop:
        assert loop.running
        until(lambda: loop.statistics["ticks"] > 20)
        until(lambda: loop.statistics["period"]["count"] > 20 and loop.statistics["work"]["p50"] > 0)
    assert loop.statistics["ticks"] > 20
    assert loop.statistics["faults"][cal.DeviceFault.bad_force] == 0


def test_a_stopped_loop_can_be_started_again():
    device = Bench()
    loop = cal.ServoLoop(device, wall, options())
    for _ in range(2):
        before = device.ticks
        loop.start()
        until(lambda: device.ticks > before + 5)
        loop.stop()
        loop.stop()
        assert device.forces[-1] == 0.0


def test_a_with_block_ramps_the_force_down_also_after_an_exception():
    device = Bench()
    with pytest.raises(LookupError, match="of your own"):
        with cal.ServoLoop(device, wall, options()) as loop:
            until(lambda: device.forces and device.forces[-1] > 0)
            raise LookupError("of your own")
    assert not loop.running and device.forces[-1] == 0.0


def test_an_unreferenced_loop_stops():
    device = Bench()
    loop = cal.ServoLoop(device, wall, options())
    loop.start()
    until(lambda: device.forces and device.forces[-1] > 0)
    del loop
    gc.collect()
    assert device.forces[-1] == 0.0


def test_a_law_may_start_and_stop_and_drop_other_loops():
    other = cal.ServoLoop(cal.PointerDevice(PROFILE), lambda state: (0, 0, 0.5), options())
    done = []

    def law(state):
        if not done:
            other.start()
            done.append(other.running)
            other.stop()
            done.append(other.running)
            third = cal.ServoLoop(cal.PointerDevice(PROFILE), wall, options())
            third.start()
            del third
            done.append(True)
        return (0, 0, 0.25)

    device = Bench()
    with cal.ServoLoop(device, law, options()) as loop:
        until(lambda: len(done) == 3 or loop.error)
        assert loop.error is None and done == [True, False, True]
        until(lambda: loop.status.phase == cal.ServoPhase.running)
    assert not other.running


def test_a_renderer_as_the_law_runs_without_python():
    device = cal.PointerDevice(PROFILE)
    loop = cal.ServoLoop(device, renderer_of(one_page()), options())
    interval = sys.getswitchinterval()
    with loop:
        sys.setswitchinterval(1000.0)  # from here on, this thread does not yield the GIL
        try:
            end = time.monotonic() + 30
            reached = loop.statistics["ticks"] + 100
            while loop.statistics["ticks"] < reached and time.monotonic() < end:
                pass
            ticks = loop.statistics["ticks"]
        finally:
            sys.setswitchinterval(interval)
    assert ticks >= reached


def test_what_a_running_loop_uses_cannot_be_used_elsewhere():
    device, renderer = cal.PointerDevice(PROFILE), renderer_of(one_page())
    state = cal.DeviceState(position=(0, 0, 0.01))
    with cal.ServoLoop(device, renderer, options()) as loop:
        until(lambda: loop.statistics["ticks"] > 20)
        for forbidden in (
            device.read,
            lambda: device.write((0, 0, 0)),
            device.close,
            lambda: device.intention,
            lambda: renderer.update(state),
            lambda: renderer.trace(np.zeros((3, 3))),
            renderer.restart,
            lambda: renderer.last,
            lambda: cal.ServoLoop(device, wall, options()).start(),
            lambda: cal.ServoLoop(cal.PointerDevice(PROFILE), renderer, options()).start(),
            lambda: cal.write_with_device(one_page(), device),
        ):
            with pytest.raises(cal.Error, match="in use by a running loop"):
                forbidden()
        device.move(0.01, 0.0, 0.5)  # allowed from any thread
        assert device.capabilities().model == PROFILE.model
        assert renderer.options.servo_rate == 1000.0
    device.read()
    assert renderer.last.time > 0.0
    renderer.restart()


def test_a_law_may_use_the_device_of_its_loop():
    device = cal.SimulatedDevice(PROFILE, cal.GripImpedance(), (0, 0, 0.01))
    device.set_intention(cal.Intention(position=(0, 0, -0.005)))

    def law(state):
        device.advance(1e-3)  # advance virtual time with the loop
        return wall(state)

    with cal.ServoLoop(device, law, options()) as loop:
        until(lambda: loop.statistics["ticks"] > 300)
    assert device.time > 0.25
    assert -5e-3 < device.true_position[2] < 0.0


def asked_in_a_law(device, questions):
    """What each function returns or raises when it is called by the force law of a loop on the device."""
    answers = []

    def answer(question):
        try:
            return question()
        except Exception as error:
            return error

    def law(state):
        if not answers:
            answers.append([answer(question) for question in questions])
        return 0, 0, 0

    with cal.ServoLoop(device, law, options()) as loop:
        until(lambda: answers)
    assert loop.error is None
    return answers[0]


@pytest.mark.parametrize("law", ["python", "renderer", "session"])
def test_a_law_may_not_use_what_another_loop_owns(law):
    device, renderer, page = cal.PointerDevice(PROFILE), renderer_of(one_page()), one_page()
    servo, other, watched, ended = cal.Servo(device, wall), cal.PointerDevice(PROFILE), threading.Event(), []
    uses = {
        "read": device.read,
        "write": lambda: device.write((0, 0, 1.0)),
        "close": device.close,
        "intention": lambda: device.intention,
        "step": lambda: servo.step(0.0),
        "start": cal.ServoLoop(device, wall, options()).start,
        "session": lambda: cal.write_with_device(page, device, cal.LiveOptions(timeout=0.1)),
    }
    if law == "renderer":
        uses |= {
            "update": lambda: renderer.update(cal.DeviceState()),
            "trace": lambda: renderer.trace(np.zeros((3, 3))),
            "restart": renderer.restart,
            "skip_stroke": renderer.skip_stroke,
            "set_due": lambda: renderer.set_due(0, 0),
            "last": lambda: renderer.last,
        }
    if law == "session":
        watch = lambda view: watched.set() or not ended  # noqa: E731
        running = threading.Thread(target=cal.write_with_device, args=(page, device, cal.LiveOptions(), watch))
        running.start()
        until(watched.is_set)
    else:
        running = cal.ServoLoop(device, renderer if law == "renderer" else wall, options())
        running.start()
    try:
        answers = dict(zip(uses, asked_in_a_law(other, uses.values())))
    finally:
        ended.append(True)
        running.join() if law == "session" else running.stop()
    refused = {
        f"the {what} is in use by a running loop: use it from the force law of that loop, or stop that loop first"
        for what in ("device", "renderer")
    }
    assert {name: answer for name, answer in answers.items() if type(answer) is not cal.Error or str(answer) not in refused} == {}
    device.read()
    renderer.restart()


def test_a_law_may_use_the_device_of_its_loop_in_calls_and_within_other_laws():
    device = cal.PointerDevice(PROFILE)
    read = []
    servo = cal.Servo(device, lambda state: read.append(device.read().time) or (0, 0, 0))
    with cal.ServoLoop(cal.PointerDevice(PROFILE), wall, options()):
        assert asked_in_a_law(device, [lambda: servo.step(0.0), lambda: servo.step(1e-3)]) == [None, None]
    assert len(read) == 2 and 0 < read[0] < read[1]
    page, mapping = one_page(), cal.upright_page(0.1, 0.1)
    recorded = cal.SessionOptions(device=PROFILE, renderer=cal.RendererOptions.for_device(PROFILE))
    replay = cal.ReplayDevice(cal.device_states(cal.write_page(page, recorded), mapping), PROFILE)
    (rest,) = asked_in_a_law(replay, [lambda: cal.replay_page(page, replay, recorded)])
    assert len(rest) > 100


def test_a_law_may_not_start_another_loop_on_the_device_of_its_own():
    """Both would run at the same time."""
    device, brief = cal.PointerDevice(PROFILE), cal.LiveOptions(timeout=0.1)
    starts = [cal.ServoLoop(device, wall, options()).start, lambda: cal.write_with_device(one_page(), device, brief)]
    for refused in asked_in_a_law(device, starts):
        assert type(refused) is cal.Error and "the device is in use by a running loop" in str(refused)


def test_an_exception_of_a_law_is_reported_and_ramps_the_force_down():
    told = []
    before, sys.unraisablehook = sys.unraisablehook, lambda unraisable: told.append(unraisable.exc_value)
    try:
        with cal.ServoLoop(Bench(), lambda state: 1 / 0, options()) as loop:
            until(lambda: loop.status.fault == cal.DeviceFault.bad_force)
    finally:
        sys.unraisablehook = before
    assert len(told) == 1 and isinstance(told[0], ZeroDivisionError)
    assert loop.errors > 0 and isinstance(loop.error, ZeroDivisionError)
    assert loop.statistics["faults"][cal.DeviceFault.bad_force] == 1


def test_a_law_may_stop_its_loop():
    device = Bench()

    def law(state):
        if device.ticks > 100:
            loop.stop()
        return wall(state)

    loop = cal.ServoLoop(device, law, options())
    loop.start()
    until(lambda: device.ticks > 100 and loop.status.phase == cal.ServoPhase.zero)
    assert loop.running and max(device.forces) == 1.0 and device.forces[-1] == 0.0
    loop.stop()
    assert not loop.running


def test_concurrent_starts_and_stops_are_safe():
    loop = cal.ServoLoop(Bench(), wall, options())
    loop.start()
    threads = [threading.Thread(target=loop.stop) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not loop.running


def test_a_loop_refuses_a_renderer_of_another_rate_and_names_both():
    slow = cal.RendererOptions(servo_rate=500.0, stiffness_check="clip")
    page = one_page()
    renderer = cal.HapticRenderer(page.characters, cal.upright_page(page.width, page.height), PROFILE, slow)
    with pytest.raises(cal.InvalidValue, match="rate = 1000 Hz, but the force law is made for 500 Hz"):
        cal.ServoLoop(Bench(), renderer, options(cal.ServoOptions(rate=1000.0)))


def test_invalid_options_and_a_second_start_are_rejected():
    with pytest.raises(cal.InvalidValue, match="rate"):
        cal.ServoLoop(Bench(), wall, options(cal.ServoOptions(rate=-1.0)))
    with pytest.raises(cal.InvalidValue, match="priority = 100"):
        cal.ServoLoop(Bench(), wall, options(priority=100))
    with pytest.raises(TypeError):
        cal.ServoLoop(Bench(), 3.0)
    with cal.ServoLoop(Bench(), wall, options()) as loop:
        with pytest.raises(cal.InvalidValue, match="already running: stop it"):
            loop.start()
    with pytest.raises(cal.InvalidValue, match=r"paper: expected shape \(4, 4\), got \(3, 3\)"):
        cal.PointerOptions(paper=np.zeros((3, 3)))
    with pytest.raises(cal.InvalidValue, match="rotation"):
        cal.PointerDevice(PROFILE, options=cal.PointerOptions(paper=np.diag([2.0, 1.0, 1.0, 1.0])))


def test_privileges_refused_by_the_system_are_reported():
    loop = cal.ServoLoop(Bench(), wall, options(core=1023))
    told = loop.start()
    loop.stop()
    assert told == loop.warnings and any("core" in line for line in told)


def python(program, **arguments):
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(cal.__file__).parents[1])}
    return subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, env=environment, timeout=120, **arguments
    )


BENCH = """
import atexit, os, sys, threading, time
forces = []
atexit.register(lambda: print("last force", forces[-1]))  # runs after the module's own exit handler
import calligraphy as cal

class Bench(cal.HapticDevice):
    ticks = 0
    def capabilities(self):
        return cal.device_profile("desktop")
    def read(self):
        self.ticks += 1
        return cal.DeviceState(time=self.ticks * 1e-3, position=(0, 0, -1e-3), velocity=(0, 0, 0))
    def write(self, force):
        forces.append(force[2])
    def close(self):
        pass

options = cal.ServoLoopOptions(
    servo=cal.ServoOptions(timeout=1.0, ramp_up=0.05), thread=cal.ServoThreadOptions(priority=0, lock_memory=False)
)
device = Bench()
def pressed():
    return bool(forces) and forces[-1] > 0
def wait(condition):
    for _ in range(60_000):
        if condition():
            return
        time.sleep(1e-3)
    sys.exit("nothing happens")
"""


def test_no_force_remains_when_the_program_exits():
    ended = python(
        BENCH + "loop = cal.ServoLoop(device, lambda state: (0, 0, 1.0), options)\nloop.start()\nwait(pressed)\n"
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "last force 0.0\n", "")


def test_a_law_may_drop_the_last_reference_to_its_loop():
    ended = python(
        BENCH
        + "held = []\n"
        + "def law(state):\n    if device.ticks > 100:\n        held.clear()\n    return 0, 0, 1.0\n"
        + "held.append(cal.ServoLoop(device, law, options))\nheld[0].start()\nwait(pressed)\n"
        + "wait(lambda: not held and forces[-1] == 0.0)\n"
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "last force 0.0\n", "")


def test_a_session_in_a_daemon_thread_ends_with_the_program():
    ended = python(
        BENCH
        + "page = cal.lay_out([cal.built_in_characters()['一']])[0]\n"
        + "session = cal.LiveOptions(servo=options)\n"
        + "threading.Thread(target=cal.write_with_device, args=(page, device, session), daemon=True).start()\n"
        + "wait(lambda: device.ticks > 50)\n"
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "last force 0.0\n", "")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_daemon_thread_that_keeps_restarting_ends_with_the_program():
    ended = python(
        BENCH
        + "page = cal.lay_out([cal.built_in_characters()['一']])[0]\n"
        + "session = cal.LiveOptions(servo=options, timeout=0.05)\n"
        + "refused = []\n"
        + "def again():\n    try:\n        while True:\n            cal.write_with_device(page, device, session)\n"
        + "    except cal.Error as error:\n        refused.append(str(error))\n"
        + "threading.Thread(target=again, daemon=True).start()\n"
        + "wait(lambda: device.ticks > 50)\n"
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "last force 0.0\n", "")


def test_no_loop_can_be_started_on_the_device_of_a_servo_within_its_tick():
    device, refused = cal.PointerDevice(PROFILE), []

    def law(state):
        for use in (cal.ServoLoop(device, wall, options()).start, cal.Servo(device, wall).reset, device.read, servo.reset):
            try:
                refused.append(use())
            except cal.Error as error:
                refused.append(str(error).partition(":")[0])
        return 0, 0, 0

    servo = cal.Servo(device, law)
    servo.step(0.0)
    loop, reset, sample, own = refused
    assert loop == "the device is in use by a tick of a Servo" and own == "this Servo is already inside a tick"
    assert reset is None and sample.status == cal.DeviceStatus.ok  # uses of the device in the thread of the law
    with cal.ServoLoop(device, wall, options()):
        pass


def test_the_device_of_a_loop_dropped_in_its_own_law_can_be_used_again():
    device, done = cal.PointerDevice(PROFILE), threading.Event()

    def law(state):
        loops.clear()
        done.set()
        return 0, 0, 0

    loops = [cal.ServoLoop(device, law, options())]
    loops[0].start()
    assert done.wait(30)
    device.read()
    cal.Servo(device, wall).step(0.0)


def test_a_servo_cannot_step_or_reset_the_device_of_a_running_loop():
    device = cal.PointerDevice(cal.device_profile("desktop"))
    servo = cal.Servo(device, lambda state: (0, 0, 0))
    with cal.ServoLoop(device, lambda state: (0, 0, 0)):
        with pytest.raises(cal.Error, match="in use by a running loop"):
            servo.reset()
        with pytest.raises(cal.Error, match="in use by a running loop"):
            servo.step(0.0)
    servo.step(0.0)


@pytest.mark.parametrize("peak", [float("nan"), 0.0, -1.0])
def test_an_invalid_peak_force_is_rejected(peak):
    device = cal.PointerDevice(cal.device_profile("desktop"))
    page = cal.lay_out([cal.built_in_characters()["一"]])[0]
    with pytest.raises(cal.InvalidValue, match="peak_force"):
        cal.write_with_device(page, device, cal.LiveOptions(peak_force=peak, timeout=1.0))
    with pytest.raises(cal.InvalidValue, match="peak_force"):
        cal.with_peak_force(device.capabilities(), peak)


def test_a_forked_child_exits_and_the_loop_of_the_parent_continues():
    ended = python(
        BENCH
        + "loop = cal.ServoLoop(device, lambda state: (0, 0, 1.0), options)\nloop.start()\nwait(pressed)\n"
        + "child = os.fork()\n"
        + "if child == 0:\n    del loop\n    forces.append(7.0)\n    sys.exit(3)\n"
        + "code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])\n"
        + "before = device.ticks\nwait(lambda: device.ticks > before + 20)\n"
        + "loop.stop()\nprint('child', code)\n"
    )
    assert ended.returncode == 0, ended.stderr
    assert ended.stdout.splitlines() == ["last force 7.0", "child 3", "last force 0.0"]


class Writer:
    """Moves the pointer along the strokes of a page as the pen follows."""

    def __init__(self, device, page):
        self.device, self.page, self.views = device, page, []
        placed = page.characters[0]
        shift = np.array([page.width / 2, page.height / 2])  # the page is centred on the device origin
        self.places = []
        for stroke in placed.character.strokes():
            way = np.concatenate([e.point(np.linspace(0, 1, 12)) for e in cal.place_elements(stroke, placed.placement)])
            self.places += [(way[0] - shift, 0.0), *((p - shift, 0.5) for p in way), (way[-1] - shift, 0.0)]
        self.device.move(*self.places[0][0], 0.0)

    def __call__(self, view):
        self.views.append(view.progress)
        place, pressure = self.places[0]
        self.device.move(*place, pressure)
        where = view.newest["device_point"][:2] - [self.page.width / 2, self.page.height / 2]
        height = view.newest["device_point"][2]
        near = np.hypot(*(where - place)) < 3e-3 and (height < 0 if pressure else height > 3e-3)
        if near and len(self.places) > 1:
            del self.places[0]


def live_options(**fields):
    return cal.LiveOptions(
        renderer=cal.RendererOptions.for_device(PROFILE),
        servo=options(cal.ServoOptions(timeout=1.0)),
        **fields,
    )


def test_a_page_is_written_in_real_time_and_scored():
    page = one_page("十")
    device = cal.PointerDevice(PROFILE)
    writer = Writer(device, page)
    result = cal.write_with_device(page, device, live_options(timeout=120.0), writer)
    score = cal.score_page(page, result.recording)[0]
    assert score.strokes_completed == 2
    assert score.peak_force > 0.05
    assert writer.views[-1] == 1.0 and sorted(writer.views) == writer.views
    assert len(result.recording) + result.dropped <= result.statistics["ticks"]
    assert device.read().status == cal.DeviceStatus.ok  # still open


@pytest.mark.parametrize("answer", [False, 0])
def test_a_session_ends_when_watch_returns_false_and_the_force_is_zero(answer):
    device, seen = Bench(), []

    def watch(view):
        seen.append(view)
        return answer if len(seen) == 5 else None

    result = cal.write_with_device(one_page(), device, live_options(timeout=60.0), watch)
    assert len(seen) == 5 and seen[-1].servo.device == cal.DeviceStatus.ok
    assert device.forces[-1] == 0.0 and not device.closed
    assert result.statistics["ticks"] > 0


class Docked(Bench):
    def advice(self):
        return "put the pen into the inkwell"


def test_a_display_and_a_warning_say_what_the_device_wants_of_the_person():
    seen = []
    with pytest.warns(RuntimeWarning, match="put the pen into the inkwell"):
        cal.write_with_device(
            one_page(), Docked(), live_options(timeout=60.0), lambda view: bool(seen.append((view.advice, view.warnings)))
        )
    assert seen[0] == ("put the pen into the inkwell", [])
    assert Bench().advice() == "" and Bench().warnings == []


def test_a_loop_warns_before_its_force_and_does_not_start_when_warnings_are_errors():
    device = Docked()
    loop = cal.ServoLoop(device, wall, options())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(RuntimeWarning, match="put the pen into the inkwell"):
            loop.start()
    assert not loop.running and not any(device.forces)
    with pytest.warns(RuntimeWarning, match="put the pen into the inkwell"), loop:
        assert loop.running


def test_a_display_can_show_why_the_pen_is_not_guided_and_the_way_to_the_start():
    page = one_page("一")
    placed = page.characters[0]
    start = cal.place_elements(placed.character.strokes()[0], placed.placement)[0].point(0.0)
    device, views = cal.PointerDevice(PROFILE), []
    where = start + (0.1 * placed.placement.em, 0.4 * placed.placement.em)
    device.move(*(where - (page.width / 2, page.height / 2)), 0.0)

    def watch(view):
        views.append(view)
        if view.started:
            device.move(*(where - (page.width / 2, page.height / 2)), 0.5)
        return view.hint == cal.WritingHint.none

    cal.write_with_device(page, device, live_options(timeout=60.0), watch)
    last = views[-1]
    assert last.hint == cal.WritingHint.too_far
    assert last.to_start == pytest.approx(start - last.newest["pen_tip"][:2], abs=1e-12)
    assert cal.hint_text(last.hint, last.to_start).endswith("mm straight down")


def test_an_exception_of_watch_is_raised_with_the_result_after_the_force_is_zero():
    device = cal.PointerDevice(PROFILE)

    def watch(view):
        if view.newest["time"] > 0:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough") as raised:
        cal.write_with_device(one_page(), device, live_options(timeout=60.0), watch)
    result = raised.value.result
    assert isinstance(result, cal.LiveResult) and len(result.recording) > 0
    device.read()


def test_the_force_never_exceeds_the_requested_peak():
    assert cal.with_peak_force(PROFILE, 0.3).peak_force == 0.3
    page = one_page()
    device = cal.PointerDevice(PROFILE)
    result = cal.write_with_device(page, device, live_options(timeout=120.0, peak_force=0.3), Writer(device, page))
    force = np.linalg.norm(result.recording.samples["force"], axis=1)
    assert 0.05 < force.max() <= 0.3 + 1e-9


@pytest.mark.parametrize("timeout", [0.0, -1.0, np.nan, np.inf])
def test_a_session_with_an_invalid_timeout_is_rejected(timeout):
    with pytest.raises(cal.InvalidValue, match="timeout"):
        cal.write_with_device(one_page(), Bench(), live_options(timeout=timeout))


def test_a_with_block_closes_a_device():
    with Bench() as device:
        assert not device.closed
    assert device.closed
    with cal.PointerDevice(PROFILE) as pointer:
        assert pointer.read().status == cal.DeviceStatus.ok
    assert pointer.read().status == cal.DeviceStatus.disconnected


def test_a_pointer_is_followed_on_any_paper_pose():
    turn = np.eye(4)
    turn[:3, :3] = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]  # x of the paper is y of the device
    turn[:3, 3] = [0.01, 0.0, 0.0]
    choice = cal.PointerOptions(paper=turn)
    assert (choice.paper == turn).all() and choice == cal.PointerOptions(paper=turn)
    device = cal.PointerDevice(PROFILE, options=choice)
    device.move(0.02, 0.0, 0.0)
    for _ in range(1000):
        device.read()
    assert device.intention.position == pytest.approx([0.01 + 8e-3, 0.02, 0.0], abs=1e-6)


def test_errors_of_a_missing_backend_tell_what_to_do():
    if "phantom" in cal.backends:
        with pytest.raises(cal.InvalidValue, match="nothing"):
            cal.PhantomDevice(cal.PhantomOptions(wire_profile="simulated", model="nothing"))
    if "openhaptics" in cal.backends:
        runtime = cal.openhaptics_runtime("/nowhere/libHD.so")
        assert not runtime["found"] and runtime["advice"]
        for kind in (cal.DeviceError, OSError):
            with pytest.raises(kind):
                cal.OpenHapticsDevice(cal.OpenHapticsOptions(library="/nowhere/libHD.so"))
    built = python(WITHOUT_BACKENDS)
    assert (built.returncode, built.stderr) == (0, ""), built.stderr
    phantom, openhaptics, other = built.stdout.splitlines()
    assert "calligraphy.PhantomDevice: this module was built without phantom: install libusb" in phantom
    assert "calligraphy.openhaptics_runtime: this module was built without openhaptics" in openhaptics
    assert other == "module 'calligraphy' has no attribute 'PhantomDevise'"


#: Simulates a module built without backends by removing their names.
WITHOUT_BACKENDS = """
import calligraphy as cal
for names, _ in cal._BACKENDS.values():
    for name in names.split():
        vars(cal).pop(name, None)
cal._calligraphy.backends = ()
for name in ("PhantomDevice", "openhaptics_runtime", "PhantomDevise"):
    try:
        getattr(cal, name)
    except AttributeError as error:
        print(error)
"""


def test_the_names_listed_for_a_backend_are_those_it_provides():
    for backend, (names, _) in cal._BACKENDS.items():
        if backend in cal.backends:
            assert all(hasattr(cal, name) for name in names.split())


@pytest.mark.skipif("phantom" not in cal.backends, reason="this module was built without Phantoms")
def test_a_wire_profile_lists_its_missing_lines(tmp_path):
    omni, simulated = map(cal.read_wire_profile, ("omni", "simulated"))
    position, force = set(omni["missing_for_position"]), set(omni["missing_for_force"])
    assert omni["name"] == "omni" and omni["report_size"] > 0 and omni["rate"] > 0
    assert position and position < force and any("torque" in line for line in force - position)
    assert simulated["missing_for_force"] == simulated["missing_for_position"] == []
    with pytest.raises(cal.FileError):
        cal.read_wire_profile(str(tmp_path / "none"))
    (tmp_path / "bad").write_text("nonsense\n")
    with pytest.raises(cal.FormatError, match="bad"):
        cal.read_wire_profile(tmp_path / "bad")
