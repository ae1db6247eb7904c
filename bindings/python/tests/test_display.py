"""What notebooks show, and recordings as data frames."""

import re
import sys
import xml.etree.ElementTree as xml

import numpy as np
import pytest

import calligraphy as cal

BUILT_IN = cal.built_in_characters()
SVG = "{http://www.w3.org/2000/svg}"


def drawn(shown):
    """The picture, parsed, and its size [px]."""
    root = xml.fromstring(shown._repr_svg_())
    size = float(root.get("width")), float(root.get("height"))
    assert root.tag == SVG + "svg" and root.get("viewBox") == f"0 0 {root.get('width')} {root.get('height')}"
    assert max(size) <= 600 and not re.search("nan|inf|None", shown._repr_svg_())
    return root, size


def filled(root):
    """The outlines of ink, as arrays of points."""
    texts = [path.get("d") for path in root.iter(SVG + "path") if path.get("fill") == "#333333"]
    return [np.array([pair.split(",") for pair in text[1:-1].split("L")], float) for text in texts]


def recorded(states, tips, **others):
    samples = np.zeros(len(states), cal.sample_dtype)
    samples["state"], samples["pen_tip"][:, :2] = states, tips
    for name, values in others.items():
        samples[name] = values
    return cal.Recording(1000.0, samples)


def lines(root):
    """The paths of a recording by colour, each an array of points [px]."""
    result = {}
    for path in root.iter(SVG + "path"):
        if path.get("stroke") in ("#2f9e44", "#e08a00"):
            for part in path.get("d").split("M")[1:]:
                first, moves = part.split("l")
                rows = [pair.split(",") for pair in [first, *moves.split()]]
                result.setdefault(path.get("stroke"), []).append(np.cumsum(np.array(rows, float), axis=0) / 10.0)
    return result


def page_of(codes):
    return cal.lay_out([BUILT_IN[code] for code in codes])[0]


def written(page, mode="force"):
    device = cal.device_profile("desktop")
    renderer = cal.RendererOptions.for_device(device)
    return cal.write_page(page, cal.SessionOptions(device=device, renderer=renderer, mode=mode))


@pytest.mark.parametrize("own", [True, False])
def test_a_character_shows_its_ink_in_its_square(own):
    character = cal.with_typical_ink(BUILT_IN["永"])
    root, size = drawn(character if own else BUILT_IN["永"])
    assert size == (256.0, 256.0)
    outlines = filled(root)
    assert len(outlines) == 5
    for outline, stroke in zip(outlines, character.strokes()):
        exact = cal.ink_outline(stroke) * (240.0, -240.0) + (8.0, 248.0)
        assert np.abs(outline - exact).max() <= 0.0501
    assert repr(BUILT_IN["永"]) == "Character(永, 5 strokes)"


def test_a_page_shows_its_characters_where_they_are():
    page = page_of("永人")
    root, (width, height) = drawn(page)
    assert (width, height) == (496.0, 376.0) and repr(page).startswith("PracticePage(width=0.16")
    outlines = filled(root)
    assert len(outlines) == 7
    for strokes, placed in ((outlines[:5], page.characters[0]), (outlines[5:], page.characters[1])):
        for outline, stroke in zip(strokes, cal.with_typical_ink(placed.character).strokes()):
            points = placed.placement.origin + placed.placement.em * cal.ink_outline(stroke, 0.1 / 120)
            assert np.abs(outline - (points * (3000.0, -3000.0) + (8.0, 368.0))).max() <= 0.0501


def test_an_empty_page_is_an_empty_sheet():
    for page in (cal.PracticePage(width=0.16, height=0.12), cal.PracticePage(), cal.PracticePage(width=np.nan, height=1)):
        root, _ = drawn(page)
        assert filled(root) == [] and len(page._repr_svg_()) < 300
    nowhere = cal.PlacedCharacter(BUILT_IN["永"], cal.Placement(em=np.nan))
    assert filled(drawn(cal.PracticePage(width=0.1, height=0.1, characters=[nowhere]))[0]) == []


def test_a_recording_shows_the_paths_on_the_paper():
    """Two pen-downs, the first half of the second not written; a bad sample far away, and the pause between them."""
    tips = np.array([[x, y] for y in (0.0, 0.02) for x in np.linspace(0.0, 0.04, 9)] + [[0.5, 0.5]] * 2)
    states = [3] * 9 + [2] * 5 + [3] * 4 + [0, 3]
    root, (width, height) = drawn(recorded(states, tips, status=[0] * 19 + [2]))
    assert (width, height) == (286.0, 172.0)
    (first, second), (other,) = (lines(root)[colour] for colour in ("#2f9e44", "#e08a00"))
    for line, expected in ((first, tips[:9]), (other, tips[9:14]), (second, tips[14:18])):
        assert np.abs(line - (expected * (6000.0, -6000.0) + (8.0, 128.0))).max() <= 0.0501
    assert root.find(f".//{SVG}path[@stroke='#333333']").get("d") == "M8,128h0"  # the second follows without a lift
    assert [text.text for text in root.iter(SVG + "text")] == [
        "0.0 s, pen-downs: 1, 40 x 20 mm", "green: writing, orange: not",
    ]  # fmt: skip


def test_a_written_page_is_drawn_to_a_tenth_of_a_pixel():
    recording = written(page_of("永和"))
    root, size = drawn(recording)
    samples = recording.samples
    tips = samples["pen_tip"][samples["state"] != 0][:, :2]
    scale = min(480 / np.ptp(tips, axis=0).max(), 6000)
    exact = (tips - tips.min(axis=0)) * (scale, -scale) + (8.0, 8.0 + round(scale * np.ptp(tips[:, 1]), 1))
    corners = np.concatenate(sum(lines(root).values(), []))
    nearest = np.array([np.abs(corners - point).max(axis=1).min() for point in exact])
    assert nearest.max() < 0.21 and len(corners) < len(tips) < len(recording)
    assert len(recording._repr_svg_()) < 30_000
    dots = root.find(f".//{SVG}path[@stroke='#333333']").get("d")
    assert dots.count("M") == np.count_nonzero(np.diff(samples["state"] != 0, prepend=False) & (samples["state"] != 0))


def test_a_long_or_restless_recording_is_a_small_picture():
    count = 1_000_000
    draws = np.random.default_rng(1)
    tips = np.cumsum(draws.normal(size=(count, 2)), axis=0) * 1e-5 + draws.normal(size=(count, 2)) * 1e-4
    for states in (np.full(count, 3), np.where(np.arange(count) // 300 % 2, 3, 0), draws.integers(0, 4, count)):
        recording = recorded(states, tips)
        drawn(recording)
        assert len(recording._repr_svg_()) < 300_000


def test_a_pen_that_never_touched_the_paper_or_stood_still_on_it():
    for recording in (recorded([], np.zeros((0, 2))), recorded([0] * 9, np.zeros((9, 2))), recorded([3], [[np.nan, 0.0]])):
        root, (_, height) = drawn(recording)
        assert height < 40 and next(root.iter(SVG + "text")).text.endswith("s, no pen on the paper")
    root, _ = drawn(recorded([3] * 9, np.full((9, 2), 0.1)))
    assert [line.tolist() for line in lines(root)["#2f9e44"]] == [[[8.0, 68.0], [8.0, 68.0]]]
    assert repr(recorded([0], [[0.0, 0.0]])).startswith("Recording(rate=1000.0")


def test_a_page_with_what_was_written_on_it():
    page = page_of("永人")
    recording = written(page)
    def lines(picture):
        return [path for path in xml.fromstring(picture).findall(f".//{SVG}g[@class='trace']/{SVG}path")
                if path.get("stroke") != "none"]

    whole = cal.page_picture(page, recording, "<both>", "lines")
    assert xml.fromstring(whole).find(SVG + "title").text == "<both>" and len(lines(whole)) == 7
    assert len(lines(cal.character_picture(page, recording, 1))) == 2
    assert ">范字<" in cal.character_picture(page, recording, 1, language="zh")
    scores = cal.score_page(page, recording)
    assert cal.page_picture(page, recording, "<both>", "lines", scores=scores) == whole
    with pytest.raises(cal.InvalidValue, match="scores: expected one for each of 2"):
        cal.character_picture(page, recording, 1, scores=scores[:1])
    with pytest.raises(cal.InvalidValue, match='language "xx"'):
        cal.page_picture(page, recording, language="xx")
    with pytest.raises(cal.InvalidValue, match="character 2: the page has 2"):
        cal.character_picture(page, recording, 2)


def test_a_recording_is_a_data_frame_with_flat_columns():
    pandas = pytest.importorskip("pandas")
    recording = written(page_of("人"))
    table, samples = recording.to_pandas(), recording.samples
    assert list(table) == [
        "time", "device_x", "device_y", "device_z", "tip_x", "tip_y", "tip_z", "force_x", "force_y", "force_z", "state",
        "events", "status", "character", "stroke", "tick_ns",
    ]  # fmt: skip
    for short, name in (("device", "device_point"), ("tip", "pen_tip"), ("force", "force")):
        for i, axis in enumerate("xyz"):
            assert np.array_equal(table[f"{short}_{axis}"], samples[name][:, i])
    for name in ("time", "events", "character", "stroke", "tick_ns"):
        assert np.array_equal(table[name], samples[name]) and table[name].dtype == samples.dtype[name]
    assert table.state.tolist() == [cal.InteractionState(state).name for state in samples["state"]]
    assert list(table.state.cat.categories) == list(cal.InteractionState.__members__)
    assert set(table.status) == {"ok"} and list(table.status.cat.categories) == list(cal.TickStatus.__members__)
    assert len({"separation", "writing"} & set(table.state)) == 2 and len(table) == len(recording)
    table.loc[0, "tip_x"] = 7.0  # a copy
    assert recording.samples["pen_tip"][0, 0] != 7.0
    empty = recorded([], np.zeros((0, 2))).to_pandas()
    assert len(empty) == 0 and pandas.api.types.is_float_dtype(empty.tip_x) and list(empty) == list(table)
    assert (empty.dtypes == table.dtypes).all()


def test_without_pandas_there_is_a_clear_error(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"Recording.to_pandas\(\) needs pandas: pip install pandas"):
        recorded([], np.zeros((0, 2))).to_pandas()


def cells(shown):
    """The rows of an HTML table."""
    rows = xml.fromstring(f"<div>{shown._repr_html_()}</div>").iter("tr")
    return [["".join(cell.itertext()) for cell in row] for row in rows]


def test_scores_and_remarks_show_what_is_wrong_as_a_table():
    page = page_of("十")
    score = cal.score_page(page, written(page))[0]
    assert ["strokes written", "2 of 2"] in cells(score) and ["character", "十"] in cells(score)
    assert score._repr_html_().endswith("no remarks")
    assert cells(cal.mean_score([score]))[0] == ["characters written", "1 of 1"]
    across, down = (np.array([[0.1, 0.5], [0.9, 0.5]]), np.array([[0.5, 0.9], [0.5, 0.1]]))
    match = cal.match_strokes(BUILT_IN["十"], [across[::-1], down])
    (remark,) = match.remarks
    what = remark.text(match.character)
    assert cells(match) == [["remark", "stroke", "what to do"], ["direction", "1", what]]
    assert cells(remark) == [["remark", "stroke"], ["direction", "1"]]
    nothing = cal.mean_score([])
    assert ["RMS error [mm]", "not measured"] in cells(nothing)


def test_a_grid_shows_its_axes_as_a_table():
    from calligraphy import experiment

    table = cells(experiment.Grid("一十", writers={"<b>": cal.WriterSkill.novice()}, seeds=30))
    assert table[1] == ["characters", "2", "一, 十"] and table[2] == ["writers", "1", "<b>"]
    assert table[8] == ["seeds", "30", ", ".join(map(str, range(1, 21))) + ", ..."] and table[-1][1] == "120"
