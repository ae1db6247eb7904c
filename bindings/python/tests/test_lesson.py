"""Lessons: with a pointer, as docs/python.md draws one, and in two threads."""

import threading
import types

import numpy as np
import pytest

import calligraphy as cal
from pages import python_blocks

DEVICE = cal.device_profile("ideal")
PAGE = cal.lay_out([cal.built_in_characters()["三"]])[0]


def path(placed, stroke):
    """Of a stroke on its page, a point every millimetre or so."""
    line = placed.placement.to_page(cal.stroke_polyline(placed.character.strokes()[stroke]))
    along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1)))
    return np.column_stack([np.interp(np.arange(0.0, along[-1], 1e-3), along, axis) for axis in line.T])


class Hand:
    """Moves the pointer of a lesson, an event every 8 ms."""

    def __init__(self, **options):
        chosen = cal.LessonOptions(renderer=cal.RendererOptions.for_device(DEVICE), **options)
        self.held, self.time = cal.PointerLesson([PAGE], DEVICE, chosen), 10.0

    def write(self, points):
        downs = [False] + [True] * len(points) + [False]
        for place, is_down in zip([points[0], *points, points[-1]], downs):
            self.time += 0.008
            self.held.move(cal.PointerSample(time=self.time, place=place, is_down=is_down))
        self.time += 0.5
        self.held.advance(self.time)
        return self.held.lesson.look()

    def told(self):
        return [f"{each.kind.name} {each.stroke + 1}" for each in self.held.lesson.events()]


def stroke(number):
    return path(PAGE.characters[0], number)


def test_what_is_written_along_the_strokes_is_accepted_and_scored():
    hand = Hand(strength=0.6)
    for number in range(3):
        view = hand.write(stroke(number))
    assert hand.told() == ["restarted 1"] + [f"{what} {n}" for n in (1, 2, 3) for what in ("begun", "accepted")] + ["finished 3"]
    assert view.is_finished and [ink.fate for ink in view.ink] == [cal.StrokeFate.accepted] * 3
    lesson = hand.held.lesson
    assert len(lesson.hands) == len(lesson.recording) >= view.ink[-1].end and np.isfinite(lesson.hands["place"]).all()
    (score,) = cal.score_lesson(lesson.writing())
    assert score.accepted == score.right_at_once == 3 and score.score.fidelity > 0.9 and score.remarks == []


def test_a_refusal_has_its_reason_and_a_skipped_stroke_is_told_as_skipped():
    hand = Hand()
    view = hand.write(stroke(0)[::-1])
    assert (view.due, view.reason, view.strokes[0].misses) == (0, cal.RefusalReason.backwards, 1)
    assert cal.refusal_text(view.reason) == "backwards: the stroke begins here"
    assert [each.reason.name for each in hand.held.lesson.events() if each.kind == cal.LessonEventKind.refused] == ["backwards"]
    assert hand.held.lesson.skip() and hand.held.lesson.send(cal.LessonCommand(kind="skip"))
    view = hand.write(stroke(2))
    assert [each.fate.name for each in view.strokes] == ["skipped", "skipped", "accepted"]
    assert hand.told() == ["skipped 1", "skipped 2", "begun 3", "accepted 3", "finished 3"]
    (score,) = cal.score_lesson(hand.held.lesson.writing())
    words = [cal.lesson_remark_text(each, score.score.match.character) for each in score.remarks]
    assert score.skipped == 2 and words == ["Strokes 1, 2 were skipped.", "Stroke 1: 1 try backwards."]


def test_one_thread_looks_on_while_a_law_runs_in_another_and_neither_half_is_for_two():
    def law(state):
        if not entered.is_set():
            entered.set()
            assert looked.wait(60)
        return 0.0, 0.0, 1.0

    entered, looked = threading.Event(), threading.Event()
    lesson = cal.Lesson([PAGE], DEVICE, cal.LessonOptions(law=law))
    state = cal.DeviceState(time=1e-3, position=(0, 0, 0.01), velocity=(0, 0, 0))
    thread = threading.Thread(target=lesson.update, args=(state,))
    thread.start()
    assert entered.wait(60)
    for use in (lambda: lesson.update(state), lambda: lesson.force, lesson.ignore):
        with pytest.raises(cal.Error, match="the lesson is in use by another thread"):
            use()
    assert lesson.look().due == 0 and lesson.send(cal.LessonCommand())
    looked.set()
    thread.join()
    assert lesson.force.tolist() == [0.0, 0.0, 1.0]


def test_what_a_law_raises_is_raised_with_its_traceback():
    def law(given):
        raise LookupError("of my own")

    hand = Hand()
    options = hand.held.lesson.options
    options.renderer.guidance.force = law
    hand.held.change(options)
    with pytest.raises(LookupError, match="of my own"):
        hand.write(stroke(0))
    assert hand.held.lesson.look().has_failed


def test_the_lesson_of_the_page_is_drawn(monkeypatch, tmp_path):
    """A stroke backwards, and all of them as they should be, with the mouse events of matplotlib."""
    backend = pytest.importorskip("matplotlib.backend_bases")
    monkeypatch.chdir(tmp_path)
    blocks = python_blocks()["docs/python.md"]
    drawn: dict = {}
    for block in (blocks[0], next(each for each in blocks if "PointerLesson" in each)):
        exec(block, drawn)
    now, axes, canvas = [10.0], drawn["axes"], drawn["figure"].canvas
    drawn["time"] = types.SimpleNamespace(monotonic=lambda: now[0])

    def draw():
        now[0] += 0.5
        drawn["draw"]()
        canvas.draw()

    def write(points):
        names = ["motion_notify"] + ["button_press"] + ["motion_notify"] * len(points) + ["button_release"]
        for name, place in zip(names, [points[0], points[0], *points, points[-1]]):
            now[0] += 0.008
            x, y = axes.transData.transform(place)
            button = 1 if name.startswith("button") else None
            canvas.callbacks.process(f"{name}_event", backend.MouseEvent(f"{name}_event", canvas, x, y, button))
        draw()

    def lines():
        return [line.get_color() for line in axes.lines if line.get_marker() == "None"]

    draw()
    placed = drawn["placed"]
    start = next(line for line in axes.lines if line.get_marker() == "o")
    assert np.allclose(np.ravel(start.get_data()), path(placed, 0)[0]) and start.get_visible() and len(axes.patches) == 5
    write(path(placed, 0)[::-1])
    assert lines() == ["r"] and axes.get_title() == "backwards: the stroke begins here"
    for number in range(5):
        write(path(placed, number))
    assert lines() == ["r"] + ["g"] * 5 and axes.get_title() == ""
