"""Which pen-down begins the stroke that is due, what finishes it, and what a display is told meanwhile."""

import math

import numpy as np
import pytest

import calligraphy as cal
from calligraphy import experiment

DESKTOP = cal.device_profile("desktop")
PRESETS = {name: getattr(cal.StrokeTolerances, name)() for name in ("lenient", "normal", "strict")}


class Pen:
    """A pen on 一, which is one line, or on the first stroke of another character; lengths in em."""

    def __init__(self, code="一", em=0.04, **options):
        layout = cal.PageLayout(width=3 * em, height=3 * em, em=em, gap=0.1 * em)
        (self.placed,) = cal.lay_out([cal.built_in_characters()[code]], layout)[0].characters
        (self.line,) = cal.place_elements(self.placed.character.strokes()[0], self.placed.placement)
        self.renderer = cal.HapticRenderer([self.placed], cal.MotionMapping(), DESKTOP, cal.RendererOptions(**options))

    def write(self, first, last, aside=0.0, lift=True, seconds=1.0):
        """Draws from a share of the stroke to another, so far beside it, and lifts the pen. Returns the ticks."""
        em, normal = self.placed.placement.em, self.line.tangent(0.5)[::-1] * (-1.0, 1.0)
        on_paper = self.line.point(np.linspace(first, last, round(1000 * seconds))) + aside * em * normal
        raised = np.repeat(on_paper[-1:], 100, axis=0)
        path = np.vstack([on_paper, raised]) if lift else on_paper
        height = np.where(np.arange(len(path)) < len(on_paper), -0.001, 0.01)
        return self.renderer.trace(np.column_stack([path, height]))


def has(ticks, event):
    return bool((ticks["events"] & int(event)).any())


def hints(ticks):
    """Without repetitions."""
    found = ticks["hint"]
    return [cal.WritingHint(found[i]).name for i in range(len(found)) if i == 0 or found[i] != found[i - 1]]


def test_the_presets_differ_in_the_order_of_their_names():
    lenient, normal, strict = PRESETS.values()
    for name in ("start_distance", "direction", "distinction", "corridor", "slack"):
        assert getattr(lenient, name) > getattr(normal, name) > getattr(strict, name)
    assert lenient.coverage < normal.coverage < strict.coverage
    assert lenient.next_decides and normal.next_decides and not strict.next_decides
    assert normal == cal.StrokeTolerances() == cal.RendererOptions().tolerances and normal.coverage >= 0.9
    printed = cal.RendererOptions.wang2006().tolerances
    assert (printed.first_stretch, printed.distinction, printed.coverage) == (0.0, math.inf, 0.0)


def test_a_tolerance_out_of_range_is_named():
    for name, value in (("start_distance", 0.0), ("coverage", 1.5), ("distinction", 0.9), ("corridor", math.nan)):
        with pytest.raises(cal.InvalidValue, match=f"tolerances.{name} = "):
            Pen(tolerances=cal.StrokeTolerances(**{name: value}))


@pytest.mark.parametrize("tolerances", PRESETS.values(), ids=PRESETS)
def test_a_stroke_begins_within_the_distance_of_its_preset(tolerances):
    for share, begins in ((0.95, True), (1.05, False)):
        ticks = Pen(tolerances=tolerances).write(0.0, 0.3, share * tolerances.start_distance)
        assert has(ticks, cal.TickEvent.stroke_started) == begins


@pytest.mark.parametrize("tolerances", PRESETS.values(), ids=PRESETS)
def test_a_lift_finishes_a_stroke_of_which_enough_is_covered_and_leaves_some_in_doubt(tolerances):
    length = Pen().line.length
    hidden = 2 * DESKTOP.coulomb_friction / cal.RendererOptions().grip_stiffness
    needed = tolerances.coverage - (max(0.04 * tolerances.slack, 0.05 * length) + hidden) / length
    for share in (0.5, needed - 0.01, needed + 0.03):
        ticks = Pen(tolerances=tolerances).write(0.0, share)
        is_in_doubt = tolerances.next_decides and 0.5 < share < needed
        assert has(ticks, cal.TickEvent.stroke_finished) == (share > needed)
        assert has(ticks, cal.TickEvent.stroke_abandoned) == (share < needed and not is_in_doubt)
        assert (hints(ticks)[-1] == "lifted_early") == is_in_doubt
        covered = ticks["covered"][ticks["state"] == int(cal.InteractionState.writing)]
        assert covered[-1] == pytest.approx(share, abs=0.02) and (np.diff(covered) >= 0.0).all()


def test_a_pen_put_down_elsewhere_is_told_why_it_is_not_guided():
    kinds = cal.WritingHint
    for first, last, aside, told in (
        (0.0, 0.02, 0.0, kinds.write),
        (0.5, 0.55, 0.0, kinds.in_middle),
        (1.0, 0.95, 0.0, kinds.at_end),
        (0.0, 0.3, 0.3, kinds.too_far),
        (0.0, -0.15, 0.0, kinds.wrong_direction),
        (0.15, 0.0, 0.0, kinds.write),  # back to the start
    ):
        pen = Pen()
        ticks = pen.write(first, last, aside, lift=False)
        assert kinds(ticks["hint"][-1]) is told and not has(ticks, cal.TickEvent.stroke_started)
        last_tick = pen.renderer.last
        assert last_tick.hint is told and last_tick.covered == 0.0
        assert last_tick.to_start == pytest.approx(pen.line.point(0.0) - last_tick.pen_tip[:2])
        assert kinds(pen.write(first, last, aside)["hint"][-1]) is kinds.none  # lifted


def test_a_pen_on_another_stroke_is_told_so():
    pen = Pen("十")
    (other,) = cal.place_elements(pen.placed.character.strokes()[1], pen.placed.placement)
    pen.line = other
    assert hints(pen.write(0.0, 0.5, lift=False))[-1] == "another_stroke"


def test_a_stroke_that_is_finished_asks_for_a_lift():
    pen = Pen("十")
    ticks = pen.write(0.0, 1.0)
    assert has(ticks, cal.TickEvent.stroke_finished)
    assert hints(ticks)[0] == "write" and hints(ticks)[-2:] == ["lift_first", "none"]
    assert ticks["stroke"][-1] == 1 and ticks["covered"][-1] >= 0.9  # of the stroke written last


def test_a_line_for_people_names_the_way_to_the_start():
    kinds = cal.WritingHint
    assert cal.hint_text(kinds.too_far, (-0.0085, 0.0085)) == "too far from the start: 12 mm to the upper left"
    assert cal.hint_text(kinds.lift_first, (0.1, 0.1)) == "lift the pen first"
    assert cal.hint_text("too_far", (-0.0085, 0.0085), language="zh") == "离起点太远：起点在左上方 12 毫米处"
    with pytest.raises(cal.InvalidValue, match='language "xx": expected one of en, '):
        cal.hint_text(kinds.too_far, (0.0, 0.0), language="xx")


def test_a_display_has_words_for_every_hint():
    for language in ("en", "zh"):
        words = [cal.hint_text(hint, (0.01, 0.0), language) for hint in cal.WritingHint]
        assert words[0] == "" and all(words[1:]) and len(set(words)) == len(words)
    assert [cal.to_string(hint) for hint in cal.WritingHint] == [hint.name for hint in cal.WritingHint]


def test_a_pen_that_moves_backwards_from_the_end_is_resisted():
    tangent = Pen().line.tangent(0.5)
    backwards = Pen(guidance=cal.GuidanceOptions(wrong_way_limit=0.7)).write(1.0, 0.5, lift=False)
    assert backwards["wrong_way"][-1] == pytest.approx(0.7 * tangent, rel=1e-2)
    assert not Pen().write(0.5, 1.0, lift=False)["wrong_way"].any()
    slack = 0.1 * 0.04 / Pen().line.length  # [em] to a share of the stroke
    for share, resisted in ((0.9, False), (1.1, True)):
        pen = Pen(guidance=cal.GuidanceOptions(wrong_way_slack=0.1))
        assert pen.write(1.0, 1.0 - share * slack, lift=False)["wrong_way"].any() == resisted


def test_guidance_that_lets_go_fades_out_in_time():
    def fades_for(seconds):
        ticks = Pen(guidance=cal.GuidanceOptions(fade_out=seconds)).write(0.0, 0.5, aside=0.08)
        force = np.linalg.norm(ticks["page_force"][:, :2], axis=1)
        return ticks, force[1000:]

    for seconds in (0.02, 0.08):
        ticks, force = fades_for(seconds)
        assert has(ticks, cal.TickEvent.stroke_abandoned) and force[0] > 0.5
        assert force[round(500 * seconds)] > 0.1 and not force[round(1000 * seconds) + 1 :].any()


def test_tolerances_and_lengths_in_em_mean_the_same_at_every_size():
    def written(em):
        pen = Pen(em=em)
        stretches = (0.5, 1.0, 0.055), (1.0, 0.4), (0.0, 0.6, 0.02), (0.0, 1.0, 0.15), (0.0, 1.0, 0.25), (0.0, 1.0)
        return [pen.write(*stretch) for stretch in stretches]

    for small, large in zip(written(0.02), written(0.04)):
        for column in ("state", "events", "hint", "element"):
            assert np.array_equal(small[column], large[column])
        assert np.array_equal(small["wrong_way"].any(axis=1), large["wrong_way"].any(axis=1))
        for column in ("covered", "weight"):
            assert small[column] == pytest.approx(large[column], abs=1e-6)
        assert 2.0 * small["to_start"] == pytest.approx(large["to_start"], abs=1e-9)


def test_a_novice_finishes_fewer_strokes_at_the_first_touch_the_stricter_the_preset():
    characters = [cal.built_in_characters()[code] for code in "永北京中国"]

    def at_first_touch(tolerances):
        renderer = cal.RendererOptions.for_device(DESKTOP)
        renderer.tolerances = tolerances
        count = 0
        for seed in (1, 2):
            options = cal.SessionOptions(device=DESKTOP, renderer=renderer, skill=cal.WriterSkill.novice(), seed=seed)
            for character in characters:
                samples = cal.write_page(cal.lay_out([character])[0], options).samples
                touches = samples[samples["events"] & int(cal.TickEvent.contact) != 0]["stroke"]
                finished = samples["events"] & int(cal.TickEvent.stroke_finished) != 0
                count += sum(int((touches == stroke).sum() == 1) for stroke in range(finished.sum()))
        return count

    lenient, normal, strict = map(at_first_touch, PRESETS.values())
    assert strict < normal <= lenient


@pytest.mark.parametrize("preset", PRESETS)
def test_a_slanted_stroke_is_told_beyond_the_angle_of_its_preset(preset):
    tolerances = getattr(cal.JudgeTolerances, preset)()
    one, told_from = cal.built_in_characters()["一"], tolerances.evidence * math.pi / 3
    for angle, remarks in ((told_from - 0.14, 0), (told_from + 0.14, 1)):
        arm = 0.3 * np.array([math.cos(angle), math.sin(angle)])
        path = 0.5 + np.linspace(-1, 1, 50)[:, None] * arm
        match = cal.match_strokes(one, [path], tolerances=tolerances)
        assert match.count(cal.StrokeRemarkKind.shape) == len(match.remarks) == remarks
        forwards = angle < math.pi / 3  # of every preset
        expected = cal.WritingDirection.forwards if forwards else cal.WritingDirection.neither
        assert match.drawn[0].stroke == 0 and match.drawn[0].direction is expected


def test_form_is_judged_unless_it_is_switched_off():
    eternal = cal.built_in_characters()["永"]
    chords = [stroke.input().control_points[[0, -1]] for stroke in eternal.strokes()]
    remark, = cal.match_strokes(eternal, chords).remarks
    assert remark.kind is cal.StrokeRemarkKind.straight and remark.orientation is cal.WritingOrientation.upright
    assert not cal.match_strokes(eternal, chords, cal.JudgeTolerances(form=False)).remarks


def test_wrong_tolerances_and_paths_are_refused_by_the_judge_of_strokes():
    one = cal.built_in_characters()["一"]
    with pytest.raises(cal.InvalidValue, match="tolerances.evidence = -1"):
        cal.match_strokes(one, [[(0, 0), (1, 1)]], cal.JudgeTolerances(evidence=-1.0))
    for paths in ([[(0, 0, 0)]], [np.zeros((0, 2))], [[(math.nan, 0)]]):
        with pytest.raises(cal.InvalidValue):
            cal.match_strokes(one, paths)


def test_the_tolerances_of_a_grid_reach_its_trials():
    def table(tolerances):
        options = cal.RendererOptions.for_device(DESKTOP)
        options.tolerances = tolerances
        return experiment.run(experiment.Grid("永", modes=["vision"], seeds=3, options=options), progress=False)

    times = [sum(table(tolerances)["time"]) for tolerances in PRESETS.values()]
    assert times[0] < times[2]  # each stroke that is not accepted is written again
