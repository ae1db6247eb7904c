"""Devices, renderer, writer and servo from Python."""

import concurrent.futures
import copy
import math
import multiprocessing
import os
import pickle
import sys
import traceback

import numpy as np
import pytest

import calligraphy as cal

PROFILE = cal.device_profile("desktop")


def one_page(text="永"):
    characters = cal.built_in_characters()
    return cal.lay_out([characters[code] for code in text])[0]


def session(**fields):
    return cal.SessionOptions(
        **{
            "device": PROFILE,
            "renderer": cal.RendererOptions.for_device(PROFILE),
            "skill": cal.WriterSkill.novice(),
            **fields,
        }
    )


def wall(state):
    """A wall below z = 0: spring and damper, without adhesion [N]."""
    depth = -state.position[2]
    return [0.0, 0.0, max(0.0, 800.0 * depth - 2.0 * state.velocity[2]) if depth > 0 else 0.0]


def held_device():
    device = cal.SimulatedDevice(PROFILE, cal.GripImpedance(mass=0.15, damping=5.0, stiffness=500.0), (0, 0, 0.01))
    device.set_intention(cal.Intention(position=(0, 0, -0.005)))
    return device


def test_on_your_own_wall_the_pen_rests_where_two_springs_balance():
    device = held_device()
    for _ in range(1000):
        device.write(wall(device.read()))
        device.advance(1e-3)
    assert -device.true_position[2] == pytest.approx(0.005 * 500 / (500 + 800), abs=2e-4)


def test_a_servo_runs_a_force_law_in_virtual_time():
    device = held_device()
    servo = cal.Servo(device, wall, ramp_up=0.01)
    for tick in range(1500):
        servo.step(tick * 1e-3)
        device.advance(1e-3)
    assert -device.true_position[2] == pytest.approx(0.005 * 500 / (500 + 800), abs=2e-4)
    assert servo.status.phase == cal.ServoPhase.running
    assert servo.statistics["ticks"] == 1500


@pytest.mark.parametrize(
    "answer, raises",
    [
        (lambda: 1 / 0, True),
        (lambda: "no force", True),
        (lambda: [0, 0], True),
        (lambda: [math.nan, 0, 0], False),
    ],
    ids=["raises", "text", "two numbers", "not a number"],
)
def test_the_force_ramps_down_when_the_force_law_fails(answer, raises, monkeypatch):
    told = []
    monkeypatch.setattr(sys, "unraisablehook", lambda unraisable: told.append(unraisable.exc_type))
    device = held_device()
    servo = cal.Servo(device, lambda state: answer() if state.time > 0.3 else wall(state), ramp_up=0.0)
    pushed = False
    for tick in range(400):
        servo.step(tick * 1e-3)
        device.advance(1e-3)
        pushed = pushed or np.linalg.norm(device.applied_force) > 0.1
    assert pushed
    assert np.linalg.norm(device.applied_force) == 0.0
    assert servo.status.fault == cal.DeviceFault.bad_force
    assert servo.statistics["faults"][cal.DeviceFault.bad_force] == 1
    assert bool(told) == raises


def test_an_exception_of_a_law_is_reported_once_and_stored(monkeypatch):
    told = []
    monkeypatch.setattr(sys, "unraisablehook", told.append)

    def law(state):
        raise LookupError(f"at {state.time:.3f}")

    device = held_device()
    servo = cal.Servo(device, law)
    assert servo.error is None and servo.errors == 0
    for tick in range(50):
        servo.step(tick * 1e-3)
        device.advance(1e-3)
    assert len(told) == 1 and told[0].exc_type is LookupError
    assert servo.errors == 50 and type(servo.error) is LookupError and str(servo.error) == "at 0.049"
    assert traceback.extract_tb(servo.error.__traceback__)[-1].name == "law"
    servo.reset()
    assert servo.error is None and servo.errors == 0
    servo.step(0.1)
    assert len(told) == 2 and servo.errors == 1


def test_a_result_that_is_not_a_force_is_an_error_of_the_law(monkeypatch):
    told = []
    monkeypatch.setattr(sys, "unraisablehook", told.append)
    servo = cal.Servo(held_device(), lambda state: [0, 0])
    for tick in range(3):
        servo.step(tick * 1e-3)
    assert len(told) == 1 and servo.errors == 3
    assert isinstance(servo.error, ValueError) and str(servo.error) == "force: expected shape (3,), got (2,)"


@pytest.mark.parametrize("kind", [KeyboardInterrupt, SystemExit])
def test_an_exception_that_ends_the_program_is_raised_by_the_step_of_its_law(kind, monkeypatch):
    told = []
    monkeypatch.setattr(sys, "unraisablehook", told.append)

    def law(state):
        if len(steps) == 2:
            raise kind
        return [0, 0, 0]

    servo, steps = cal.Servo(held_device(), law), []
    with pytest.raises(kind):
        for tick in range(5):
            servo.step(tick * 1e-3)
            steps.append(tick)
    assert steps == [0, 1] and servo.status.fault == cal.DeviceFault.bad_force
    steps.append(None)
    servo.step(0.01)  # the next tick is a normal one
    assert servo.errors == 1


class Recorder(cal.HapticDevice):
    """A device written in Python: a free mass that records its commands."""

    def __init__(self):
        super().__init__()
        self.forces = []
        self.time = 0.0
        self.closed = False

    def capabilities(self):
        return PROFILE

    def read(self):
        self.time += 1e-3
        return cal.DeviceState(time=self.time, position=(0, 0, -1e-3), velocity=(0, 0, 0))

    def write(self, force):
        self.forces.append(force)

    def close(self):
        self.closed = True


def test_your_own_device_works_in_the_loop():
    device = Recorder()
    servo = cal.Servo(device, lambda state: [0, 0, -1000 * state.position[2]], ramp_up=0.0)
    for tick in range(100):
        servo.step(tick * 1e-3)
    assert len(device.forces) == 100
    assert device.forces[-1] == pytest.approx([0, 0, 1.0])


def test_the_servo_keeps_its_device_alive():
    servo = cal.Servo(Recorder(), lambda state: [0, 0, 1])
    for tick in range(10):
        servo.step(tick * 1e-3)
    assert servo.statistics["ticks"] == 10


@pytest.mark.parametrize("kind", ["raises", "wrong type", "missing"])
def test_failure_of_your_own_device_is_a_fault_not_a_crash(kind, monkeypatch):
    told, words = [], []
    monkeypatch.setattr(
        sys, "unraisablehook",
        lambda unraisable: (told.append(unraisable.exc_type), words.append(str(unraisable.exc_value))),
    )  # fmt: skip

    class Broken(Recorder):
        def read(self):
            if kind == "raises":
                raise OSError("gone")
            return "nothing"

    class Missing(cal.HapticDevice):
        def capabilities(self):
            return PROFILE

    device = Missing() if kind == "missing" else Broken()
    servo = cal.Servo(device, wall)
    for tick in range(10):
        servo.step(tick * 1e-3)
    assert servo.status.fault == cal.DeviceFault.device_error
    if kind == "wrong type":
        assert words == ["read() returned 'nothing', expected a calligraphy.DeviceState"]
    assert len(told) == (2 if kind == "missing" else 1)  # once per method, until it works again


@pytest.mark.parametrize("method", ["read", "write"])
@pytest.mark.parametrize("kind", [KeyboardInterrupt, SystemExit])
def test_an_exception_of_a_device_that_ends_the_program_is_raised_by_step(method, kind):
    class Pressed(Recorder):
        def read(self):
            if method == "read" and len(self.forces) == 3:
                raise kind("pressed")
            return super().read()

        def write(self, force):
            super().write(force)
            if method == "write" and len(self.forces) == 4:
                raise kind("pressed")

    device = Pressed()
    servo = cal.Servo(device, wall)
    for tick in range(3):
        servo.step(tick * 1e-3)
    with pytest.raises(kind, match="pressed"):
        servo.step(3e-3)
    assert len(device.forces) == 4
    servo.step(4e-3)


def test_a_failing_write_is_a_fault_until_a_write_succeeds(monkeypatch):
    told = []
    monkeypatch.setattr(sys, "unraisablehook", lambda unraisable: told.append(str(unraisable.exc_value)))

    class Loose(Recorder):
        broken = False

        def write(self, force):
            if self.broken:
                raise OSError("bus gone")
            super().write(force)

    device = Loose()
    servo = cal.Servo(device, lambda state: (0.0, 0.0, 1.0), ramp_up=0.0)
    tick = 0

    def steps(count):
        nonlocal tick
        for _ in range(count):
            servo.step(tick * 1e-3)
            tick += 1

    steps(10)
    assert servo.status.phase == cal.ServoPhase.running and device.forces[-1][2] == 1.0
    device.broken = True
    steps(30)
    assert servo.status.fault == cal.DeviceFault.device_error and servo.status.phase == cal.ServoPhase.zero
    assert servo.statistics["faults"][cal.DeviceFault.device_error] == 1 and told == ["bus gone"]
    device.broken = False
    steps(1)
    assert device.forces[-1][2] == 0.0  # the first accepted one
    steps(10)
    assert servo.status.phase == cal.ServoPhase.running and device.forces[-1][2] == 1.0


def test_a_device_that_fails_again_is_reported_again(monkeypatch):
    told = []
    monkeypatch.setattr(sys, "unraisablehook", lambda unraisable: told.append(str(unraisable.exc_value)))

    class Loose(Recorder):
        def read(self):
            state = super().read()
            if round(state.time * 1e3) % 10 in (7, 8):
                raise OSError(f"{state.time:.3f}")
            return state

        def write(self, force):
            raise OSError("write")

    servo = cal.Servo(Loose(), wall)
    for tick in range(20):
        servo.step(tick * 1e-3)
    assert told == ["write", "0.007", "0.017"]


@pytest.mark.parametrize("answer", [None, 5, KeyError("none")])
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_a_device_without_valid_capabilities_is_rejected_immediately(answer):
    class Silent(Recorder):
        def capabilities(self):
            if isinstance(answer, Exception):
                raise answer
            return answer

    page = one_page()
    users = [
        lambda device: cal.Servo(device, wall),
        lambda device: cal.ServoLoop(device, wall).start(),
        lambda device: cal.write_with_device(page, device),
    ]
    for use in users:
        with pytest.raises(KeyError if isinstance(answer, Exception) else TypeError, match="none|Capabilities"):
            use(Silent())
    with pytest.raises(TypeError, match="capabilities must be defined"):
        cal.Servo(cal.HapticDevice(), wall)


def test_concurrent_and_nested_steps_are_rejected():
    refused = []

    def law(state):
        try:
            servo.step(1.0)
        except cal.Error as error:
            refused.append(str(error))
        return 0, 0, 0

    servo = cal.Servo(cal.SimulatedDevice(PROFILE), law)
    servo.step(0.0)
    servo.step(1e-3)
    assert len(refused) == 2 and "already inside a tick" in refused[0] and servo.statistics["ticks"] == 2


def test_devices_whose_overrides_would_be_ignored_are_final():
    for kind in (cal.SimulatedDevice, cal.ReplayDevice, cal.PointerDevice, cal.HapticRenderer):
        with pytest.raises(TypeError, match="not an acceptable base type"):
            type("Mine", (kind,), {})


def test_writing_is_deterministic_per_seed_and_differs_between_seeds():
    page, options = one_page(), session()
    first, again = cal.write_page(page, options), cal.write_page(page, options)
    assert np.array_equal(first.samples, again.samples)
    assert not np.array_equal(cal.write_page(page, session(seed=2)).samples, first.samples)


def test_samples_are_a_structured_array_over_the_memory_of_the_recording():
    recording = cal.write_page(one_page(), session())
    samples = recording.samples
    assert samples.dtype == cal.sample_dtype and len(samples) == len(recording)
    assert np.shares_memory(samples, recording.samples)
    assert np.all(np.diff(samples["time"]) > 0)
    assert samples["force"].shape == (len(recording), 3)
    assert set(np.unique(samples["state"])) <= set(cal.InteractionState)
    with pytest.raises(ValueError, match="read-only"):
        samples["time"][0] = 1.0
    time = cal.write_page(one_page("一"), session()).samples["time"]  # its owner has been destroyed
    assert np.allclose(np.diff(time), 1e-3)


def test_recordings_round_trip_through_pickle_and_arrays():
    recording = cal.write_page(one_page("一"), session())
    for again in (
        pickle.loads(pickle.dumps(recording)),
        cal.Recording(recording.rate, recording.samples),
    ):
        assert again.rate == recording.rate
        assert np.array_equal(again.samples, recording.samples)
    wrong = recording.samples.copy()
    wrong["state"][5] = 200
    with pytest.raises(cal.InvalidValue, match=r"samples\[5\]: state 200"):
        cal.Recording(1000.0, wrong)


def test_a_trace_equals_single_updates():
    recording = cal.write_page(one_page("一"), session())
    page = one_page("一")
    mapping = cal.upright_page(page.width, page.height)
    states = cal.device_states(recording, mapping)

    def renderer():
        return cal.HapticRenderer(page.characters, mapping, PROFILE)

    single, whole = renderer(), renderer()
    forces = np.array([single.update(state).force for state in states])
    ticks = whole.trace([s.position for s in states], [s.time for s in states])
    assert ticks.dtype == cal.tick_dtype
    assert np.array_equal(ticks["force"], forces)
    assert ticks["character"][-1] == 1 and np.abs(forces).max() > 0.1
    events = np.bitwise_or.reduce(ticks["events"])
    assert events & cal.TickEvent.page_finished and not events & cal.TickEvent.stroke_abandoned
    at_the_rate = renderer().trace([s.position for s in states])
    assert np.allclose(np.diff(at_the_rate["time"]), 1e-3)
    with pytest.raises(cal.InvalidValue, match="times: expected shape"):
        whole.trace(np.zeros((3, 3)), np.zeros(2))
    assert len(whole.trace(np.zeros((0, 3)))) == 0


def test_a_non_finite_position_is_a_bad_sample():
    page = one_page()
    renderer = cal.HapticRenderer(page.characters, cal.upright_page(page.width, page.height), PROFILE)
    ticks = renderer.trace([[0, 0, 0.02], [math.nan, 0, 0], [0, 0, 0.02]])
    assert ticks["status"].tolist() == [0, int(cal.TickStatus.bad_sample), 0]
    assert np.isfinite(ticks["force"]).all()


def test_your_own_motion_is_called_at_every_tick():
    page, asked = one_page("一"), []

    def motion(tick, seconds):
        asked.append((tick.time, seconds))
        down = 8e-3 - 1e-4 * len(asked)
        place = (page.width / 2, page.height / 2, down)
        return None if len(asked) == 200 else cal.Intention(position=place, velocity=(0, 0, -0.1))

    samples = cal.run_session(page, session(), motion).samples
    assert len(samples) == len(asked) == 200 and np.allclose(np.diff([time for time, _ in asked]), 1e-3)
    assert {seconds for _, seconds in asked} == {1e-3}
    assert samples["device_point"][0, 2] > 0 > samples["device_point"][-1, 2] and samples["force"][-1, 2] > 0
    with pytest.raises(ZeroDivisionError):
        cal.run_session(page, session(), lambda tick, seconds: 1 / 0)


def test_a_replay_reproduces_the_recorded_forces():
    page, options = one_page("一"), session()
    recording = cal.write_page(page, options)
    states = cal.device_states(recording, cal.upright_page(page.width, page.height))
    replay = cal.replay_page(page, cal.ReplayDevice(states, PROFILE), options)
    assert np.allclose(replay.samples["force"][: len(recording)], recording.samples["force"], atol=1e-6)


def test_scores_differ_between_force_and_vision():
    page = one_page("永")
    errors = {
        mode: np.mean([cal.score_page(page, cal.write_page(page, session(mode=mode, seed=s)))[0].rms_error for s in range(8)])
        for mode in (cal.FeedbackMode.vision, cal.FeedbackMode.force)
    }
    assert errors[cal.FeedbackMode.force] < errors[cal.FeedbackMode.vision]


def _write_in_child(seed):
    return cal.score_page(one_page("一"), cal.write_page(one_page("一"), session(seed=seed)))[0]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_forked_process_writes_identically():
    context = multiprocessing.get_context("fork")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        assert list(pool.map(_write_in_child, [1, 2, 3])) == [_write_in_child(s) for s in (1, 2, 3)]


def test_structs_differ_if_a_field_differs():
    one, other = session(), session()
    assert one == other
    other.renderer.guidance.space.radius = 0.01
    assert one != other and one != 3


def test_a_simulated_device_rejects_unphysical_properties():
    with pytest.raises(cal.InvalidValue, match="mass"):
        cal.SimulatedDevice(cal.Capabilities(apparent_mass=-1.0))


def test_unstable_stiffness_is_rejected_or_clipped():
    page = one_page()
    mapping = cal.upright_page(page.width, page.height)
    options = cal.RendererOptions(paper=cal.PaperOptions(stiffness=1e6))
    with pytest.raises(cal.InvalidValue, match="paper.stiffness"):
        cal.HapticRenderer(page.characters, mapping, PROFILE, options)
    assert cal.clip_stiffness(options, PROFILE)
    assert options.paper.stiffness < 1e6
    cal.validate(options, PROFILE)


def test_stiffness_advice_agrees_with_a_simulated_wall():
    loop = cal.SampledLoop(device=cal.Capabilities(apparent_mass=0.045, viscous_friction=0.1, peak_force=7.9), rate=1000.0)
    critical = cal.critical_stiffness(loop)
    advice = cal.advise_stiffness(loop)
    assert advice["stable"]["value"] == critical and set(advice) == {"passive", "quantised", "stable", "approximate"}
    assert all(bound["formula"] and bound["validity"] for bound in advice.values())
    assert cal.simulate_wall_contact(loop, 0.8 * critical)["stable"] and not cal.simulate_wall_contact(loop, 1.5 * critical)["stable"]


def test_a_stability_map_reports_its_progress():
    shares = []
    options = cal.StabilityMapOptions(
        with_sweeps=False, per_decade=2, dampings=[0.5], rates=[1000.0], delays=[0], encoder_steps=[0.0],
        wall_dampings=[0.0], grips=[cal.GripImpedance(mass=0, damping=0, stiffness=0)],
    )  # fmt: skip
    result = cal.stability_map(options, shares.append)
    assert len(result["grid"]) == 1 and result["grid"][0]["stable_at"].shape == result["stiffnesses"].shape
    assert shares and shares[-1] == 1.0


def test_a_force_field_is_an_array_of_forces():
    placed = one_page().characters[0]
    field = cal.guidance_field(placed, 0, 0.2, placed.placement.origin, placed.placement.em, columns=12)
    assert field["forces"].shape == (12, 12, 2) and 0.0 < np.linalg.norm(field["forces"], axis=2).max() < 600 * 0.012
    assert field["jumps"].dtype.names == ("begin", "end", "size", "from_stroke", "passes_feature")


def test_a_recorded_pen_trace_is_followed(tmp_path):
    t = np.linspace(0, 1, 50)
    trace = cal.PenTrace("一", [np.column_stack([0.1 + 0.8 * t, np.full(50, 0.5), t])], set="made")
    cal.write_pen_traces(tmp_path / "traces.txt", [trace])
    again = cal.read_pen_traces(str(tmp_path / "traces.txt"))[0]
    assert again.character == "一" and np.allclose(again.strokes[0], trace.strokes[0], atol=1e-6)
    recording = cal.follow_trace(one_page("一"), again, session())
    assert cal.score_page(one_page("一"), recording)[0].strokes_completed == 1
