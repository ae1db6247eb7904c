"""Laws of guidance written in Python."""

import copy
import functools
import pickle
import threading
import traceback

import numpy as np
import pytest

import calligraphy as cal

DESKTOP = cal.device_profile("desktop")
PAGE = cal.lay_out([cal.built_in_characters()["十"]])[0]
STROKES = [cal.place_elements(s, PAGE.characters[0].placement) for s in PAGE.characters[0].character.strokes()]


def renderer(force, device=DESKTOP, **options):
    options = cal.RendererOptions(guidance=cal.GuidanceOptions(force=force), **options)
    return cal.HapticRenderer(PAGE.characters, cal.MotionMapping(), device, options)


def along(stroke=0, aside=0.002, ticks=400):
    """Positions of a pen that writes a stroke, `aside` of it [m]."""
    (element,) = STROKES[stroke]
    paper = element.point(np.linspace(0.0, 1.0, ticks)) + np.minimum(np.arange(ticks) / 200, 1)[:, None] * (0, aside)
    return np.column_stack([paper, np.full(ticks, -0.001)])


def linear(given):
    return given.stiffness * given.share * (given.target - given.tip)


class Linear:
    """Like linear(), with what it remembers."""

    stiffness = 600.0
    made = []

    def __init__(self, gain=1.0):
        self.gain, self.lengths, self.starts = gain, [], []
        Linear.made.append(self)

    def begin(self, stroke):
        self.stroke = stroke
        self.lengths.append(stroke.length)
        self.starts.append(stroke.at(0.0).point)

    def force(self, given):
        place = self.stroke.at(given.arc)
        assert not given.writing or np.allclose(place.point, given.nearest, atol=1e-6)
        return cal.GuidanceTerms(spring=self.gain * linear(given), damper=cal.guidance_damper(given, given.share))


def broken(given):
    if given.arc > 0.02:
        raise LookupError("of my own")
    return linear(given)


@pytest.mark.parametrize("law", [Linear, Linear(), functools.partial(Linear, gain=1.0)])
def test_a_law_in_python_equals_the_same_one_in_cpp(law):
    expected, ticks = (renderer(force).trace(along()) for force in ("linear", law))
    assert np.abs(expected["page_force"][:, :2]).max() > 0.5
    for name in ("page_force", "attraction", "viscous", "status", "state"):
        assert np.array_equal(ticks[name], expected[name])


def test_a_function_gives_the_spring_and_is_damped_as_the_built_in_laws_are():
    expected, ticks = (renderer(force).trace(along()) for force in ("linear", linear))
    for name in ("attraction", "viscous"):
        assert expected[name].any() and np.array_equal(ticks[name], expected[name])


def test_each_renderer_makes_its_own_object_of_a_class_which_is_told_of_each_attempt():
    Linear.made.clear()
    one, other = renderer(Linear), renderer(Linear)
    assert len(Linear.made) == 2
    one.trace(along())
    above = along(ticks=60) + (0, 0, 0.03)
    one.trace(above)
    one.trace(along(stroke=1))
    told, untold = Linear.made
    assert untold.lengths == [] and told.lengths[0] == pytest.approx(STROKES[0][0].length)
    assert told.lengths[-1] == pytest.approx(STROKES[1][0].length)
    assert np.allclose(told.starts[-1], STROKES[1][0].point(0.0)) and other.options.guidance.force is Linear
    del one
    assert told.stroke.at(0.01).tangent @ STROKES[1][0].tangent(0.5) > 0.9, "it outlives the renderer"


def test_an_exception_is_raised_with_its_traceback_and_the_force_ramps_down_to_zero():
    pen = renderer(broken)
    with pytest.raises(LookupError):
        pen.trace(along())
    forces = [pen.last.force]
    for _ in range(9):
        with pytest.raises(LookupError, match="of my own") as raised:
            pen.update(cal.DeviceState(time=pen.last.time + 1e-3, position=pen.last.device_point))
        assert traceback.extract_tb(raised.value.__traceback__)[-1].name == "broken"
        assert pen.last.status is cal.TickStatus.bad_law
        forces.append(pen.last.force)
    assert np.linalg.norm(forces[0]) > 0.5 and not forces[-1].any()
    pen.restart()
    assert not pen.trace(along()[:100])["status"].any()


def test_a_renderer_is_not_used_by_another_thread_while_its_law_runs():
    def law(given):
        raised.append(pytest.raises(cal.Error, lambda: pen.last))
        return linear(given)

    raised = []
    pen = renderer(law)
    pen.update(cal.DeviceState(time=1e-3, position=along()[0]))
    pen.trace(along()[1:3])
    assert len(raised) == 3


@pytest.mark.parametrize("ends", [KeyboardInterrupt, SystemExit])
def test_ctrl_c_in_a_law_ends_a_trace(ends):
    def law(given):
        raise ends

    with pytest.raises(ends):
        renderer(law).trace(along())


@pytest.mark.parametrize("answer", [None, 3.0, (0, 0, 0), "ab", (np.nan, 0), cal.GuidanceTerms(normal=np.inf)])
def test_what_is_no_force_is_told(answer):
    with pytest.raises(cal.InvalidValue, match=r"^force: expected \(2,\) finite numbers or GuidanceTerms, got "):
        renderer(lambda given: answer).trace(along())


def test_what_is_no_law_is_refused():
    for other in (3, None, object(), cal.GuidanceOptions(), cal.GuidanceOptions, dict):
        with pytest.raises(TypeError, match="force: expected linear, saturating, wang2006, a function, or a class"):
            cal.GuidanceOptions(force=other)


def test_what_a_law_states_reaches_the_renderer():
    class Stiff(Linear):
        stiffness = 5000.0

    with pytest.raises(cal.InvalidValue, match='guidance law "Stiff": stiffness = 5000 N/m is above'):
        renderer(Stiff)
    clipped = renderer(Stiff, stiffness_check="clip")
    assert any("the spring is scaled by" in line for line in clipped.clipped)
    assert clipped.law == cal.GuidanceTraits(name="Stiff, scaled by 0.2", stiffness=5000.0)
    with pytest.raises(TypeError, match="lets_go: expected True or False, got 3"):
        renderer(type("Odd", (Linear,), {"lets_go": 3}))
    with pytest.raises(ZeroDivisionError):
        renderer(type("Late", (Linear,), {"__init__": lambda self: 1 / 0}))


@pytest.mark.parametrize("law", ["saturating", linear, Linear, functools.partial(Linear, 2.0)])
def test_options_with_a_law_are_compared_copied_and_pickled(law):
    options = cal.RendererOptions(guidance=cal.GuidanceOptions(force=law))
    assert options.guidance.force is law or options.guidance.force == "saturating"
    assert copy.copy(options) == options == copy.deepcopy(options) != cal.RendererOptions()
    back = pickle.loads(pickle.dumps(options)).guidance.force
    assert back == law or back.args == law.args
    assert repr(law) in repr(options)


def test_sessions_and_other_threads_ask_a_law_in_python():
    options = cal.SessionOptions(device=DESKTOP, mode="force", character_timeout=3.0)
    options.renderer.guidance.force = "linear"
    expected = cal.write_page(PAGE, options).samples
    options.renderer.guidance.force = Linear
    written = []
    threads = [threading.Thread(target=lambda: written.append(cal.write_page(PAGE, options))) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for recording in written:
        assert all(np.array_equal(recording.samples[name], expected[name]) for name in ("pen_tip", "force"))
        assert recording.law == "Linear"


def interrupted(state):
    raise KeyboardInterrupt


@pytest.mark.parametrize("law, raised", [(broken, LookupError), (interrupted, KeyboardInterrupt)])
def test_an_exception_of_either_law_ends_a_session_with_its_traceback(law, raised):
    options = cal.SessionOptions(device=DESKTOP)
    if law is broken:
        options.renderer.guidance.force = law
    else:
        options.law = law
    for _ in range(2):
        with pytest.raises(raised) as told:
            cal.write_page(PAGE, options)
        assert traceback.extract_tb(told.value.__traceback__)[-1].name == law.__name__


def test_an_exception_ends_live_writing_and_has_what_was_written():
    to_device = cal.upright_page(PAGE.width, PAGE.height).to_device
    pen = cal.PointerDevice(DESKTOP)
    points = iter(np.vstack([along(ticks=60)] + [along(ticks=60)[-1]] * 500))
    options = cal.LiveOptions(timeout=20.0)
    options.renderer.guidance.force = broken
    with pytest.raises(LookupError) as told:
        cal.write_with_device(PAGE, pen, options, lambda view: pen.move(*to_device(next(points))[:2], 0.5))
    assert len(told.value.result.recording) > 0 and told.value.result.recording.law == "broken, within 0.1 J"


def test_the_law_of_a_session_gives_the_whole_force():
    class Still:
        name = "still: 1 N"

        def __call__(self, state):
            return (0.0, 0.0, 1.0)

    options = cal.SessionOptions(device=DESKTOP, law=Still(), character_timeout=0.5)
    recording = cal.write_page(PAGE, options)
    assert recording.law == "still: 1 N" and (recording.samples["force"] == (0, 0, 1)).all()
    for answer in ((0, 0), (0, 0, np.nan)):
        options.law = lambda state: answer
        with pytest.raises(cal.InvalidValue, match=r"^force: expected \(3,\) finite numbers, got "):
            cal.write_page(PAGE, options)


def test_a_servo_loop_asks_a_law_in_python_and_keeps_its_exception(monkeypatch):
    monkeypatch.setattr("sys.unraisablehook", lambda raised: None)
    start = STROKES[0][0].point(0.0)

    def law(given):
        raised.set()
        raise LookupError

    raised = threading.Event()
    device = cal.PointerDevice(DESKTOP)
    device.move(*start, 0.5)
    with cal.ServoLoop(device, renderer(law)) as loop:
        assert raised.wait(10.0)
    assert isinstance(loop.error, LookupError) and loop.errors > 0
