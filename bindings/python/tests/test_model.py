"""Characters, typical strokes and sets from Python."""

import copy
import errno
import os
import pickle
import pydoc

import numpy as np
import pytest

import calligraphy as cal
from calligraphy import experiment


def test_the_example_of_table_3_has_the_published_counts():
    character = cal.paper_example()
    assert character.stroke_ids.tolist() == [2, 1, 10, 31, 4]
    assert character.control_points.shape == (15, 2)
    assert len(character.feature_points) == 13
    assert character.elements == ["L", "L", "L", "LLLL", "C"]


def test_there_are_39_typical_strokes():
    strokes = cal.typical_strokes()
    assert [stroke.id for stroke in strokes] == list(range(1, 40))
    for stroke in strokes:
        assert stroke.shape.shape == (1 + sum({"L": 1, "C": 3}[kind] for kind in stroke.elements), 2)
        assert len(stroke.joints) == len(stroke.elements) - 1
        assert pickle.loads(pickle.dumps(stroke)).id == stroke.id
    with pytest.raises(cal.InvalidValue, match="40"):
        cal.typical_stroke(40)


def test_a_character_can_be_rebuilt_from_its_strokes():
    original = cal.built_in_characters()["永"]
    inputs = [stroke.input() for stroke in original.strokes()]
    again = cal.make_character("永", inputs)
    assert np.array_equal(again.control_points, original.control_points)
    assert np.array_equal(again.stroke_ids, original.stroke_ids)
    assert again == original
    inputs[0].elements, inputs[0].control_points = "C", [[0.4, 0.9], [0.5, 0.9], [0.5, 0.8], [0.6, 0.8]]
    bent = cal.make_character("永", inputs)
    assert bent.strokes()[0].elements == "C" and bent != original
    inputs[0].elements = "CC"
    with pytest.raises(cal.InvalidValue, match="stroke 1: typical stroke 8 is L.*'CC'"):
        cal.make_character("永", inputs)
    inputs = [stroke.input() for stroke in original.strokes()]
    inputs[2].id = 99
    with pytest.raises(cal.InvalidValue, match="99"):
        cal.make_character("永", inputs)


@pytest.mark.parametrize("again", [lambda x: pickle.loads(pickle.dumps(x)), copy.copy, copy.deepcopy])
def test_a_character_survives_pickling_and_copying(again):
    original = cal.with_quartic_curves(cal.built_in_characters()["永"])
    result = again(original)
    assert (result.code, result.order, result.curve_degree) == ("永", "", 4)
    for name in ("control_points", "stroke_ids", "feature_points", "elements", "attraction_factors"):
        assert np.array_equal(getattr(result, name), getattr(original, name))


def test_a_damaged_pickle_of_a_character_is_rejected():
    character = cal.built_in_characters()["永"]
    state = character.__reduce__()[0].keywords
    with pytest.raises(cal.InvalidValue, match="stroke 1: .*99"):
        cal.Character(**{**state, "stroke_ids": [99] * character.stroke_count})


def test_a_list_and_a_set_contain_the_same_characters(tmp_path):
    characters = cal.built_in_characters()
    cal.write_characters(str(tmp_path / "list.txt"), characters)
    assert len(cal.read_characters(str(tmp_path / "list.txt"))) == len(characters)
    (tmp_path / "characters.set").write_bytes(cal.encode_character_set(characters, cal.CoordinatePrecision.exact))
    stored = cal.CharacterSet.open(str(tmp_path / "characters.set"))
    assert "永" in stored and "龘" not in stored and stored.find("龘") is None
    assert np.array_equal(stored["永"].control_points, characters["永"].control_points)
    assert list(stored) == sorted({c.code for c in characters.characters})
    assert len(stored) == len({c.code for c in characters.characters})
    assert stored.coordinate_error() == 0.0
    assert len(cal.CharacterSet.layered([stored, cal.CharacterSet(characters)])) == len(stored)
    assert len(pickle.loads(pickle.dumps(characters))) == len(characters)
    with pytest.raises(KeyError, match="龘 is not in this set of characters"):
        stored["龘"]


@pytest.mark.parametrize("characters", [cal.built_in_characters(), cal.CharacterSet(cal.built_in_characters())])
def test_characters_are_found_as_people_paste_them_and_a_warning_says_how(characters):
    with pytest.warns(UserWarning, match="is read as 一"):
        assert characters["\u2f00"].code == "一"
    with pytest.warns(UserWarning, match="without its variation selector, U\\+FE00"):
        assert [each.code for each in characters.text("\ufeff永 \u200b一\ufe00")] == ["永", "一"]
    assert "\u2f00" in characters
    with pytest.raises(ValueError, match="expected one character, got '永一'"):
        characters.find("永一")


def test_typical_strokes_are_characters_by_number_and_by_cjk_stroke():
    strokes = cal.typical_stroke_characters()
    for stroke in cal.typical_strokes():
        assert strokes[cal.typical_stroke_code(stroke.id)].stroke_ids.tolist() == [stroke.id]
    assert cal.typical_stroke_code(6) == "⑥" and strokes["㇏"].stroke_ids.tolist() == [6]
    assert strokes.find("㇒", "5").stroke_ids.tolist() == [5], "the short pie is an order of pie"


def test_errors_derive_from_one_base_and_from_built_in_exceptions(tmp_path):
    with pytest.raises(cal.FileError) as missing:
        cal.CharacterSet.open(str(tmp_path / "nowhere.set"))
    assert isinstance(missing.value, (cal.Error, OSError)) and "nowhere.set" in str(missing.value)
    with pytest.raises(cal.FormatError) as wrong:
        cal.CharacterSet.from_bytes(b"no set", "this one")
    assert isinstance(wrong.value, ValueError) and "this one" in str(wrong.value)
    assert issubclass(cal.DeviceError, OSError) and issubclass(cal.Error, RuntimeError)


def test_an_error_of_a_file_names_the_file_and_the_errno_like_that_of_python(tmp_path):
    path = str(tmp_path / "nowhere")
    page = cal.lay_out([cal.built_in_characters()["一"]])[0]
    for act in (
        lambda: cal.CharacterSet.open(path),
        lambda: cal.read_recording(path),
        lambda: cal.import_characters(path),
        lambda: cal.write_characters(path + "/file", cal.built_in_characters()),
        lambda: experiment.write(experiment.run(experiment.Grid("一")), path + "/file.csv"),
    ):
        with pytest.raises(FileNotFoundError) as missing:
            act()
        told = missing.value
        assert isinstance(told, cal.FileError) and told.errno == errno.ENOENT
        assert told.filename.startswith(path) and str(told).startswith(told.filename + ": ")
    with pytest.raises(cal.FileError) as wrong:
        cal.read_recording(tmp_path)
    assert not isinstance(wrong.value, FileNotFoundError) and wrong.value.filename == str(tmp_path)


def test_help_does_not_begin_with_names_of_the_binding():
    for shown in (cal.HapticRenderer, cal.hint_text, cal.Character.strokes):
        assert "pybind11" not in "".join(pydoc.render_doc(shown).splitlines()[:4])


READERS = {
    "read_characters": cal.read_characters,
    "CharacterSet.open": cal.CharacterSet.open,
    "read_pen_traces": cal.read_pen_traces,
    "read_recording": cal.read_recording,
}
if "phantom" in cal.backends:
    READERS["read_wire_profile"] = cal.read_wire_profile


@pytest.mark.parametrize("name", READERS)
def test_a_file_of_arbitrary_bytes_is_rejected_by_name(name, tmp_path):
    path = tmp_path / "wrong"
    path.write_bytes(bytes(range(1, 256)) * 20)
    for how in (path, str(path), os.fsencode(path)):
        with pytest.raises(cal.FormatError, match="wrong"):
            READERS[name](how)
    odd = os.fsencode(tmp_path) + b"/\xff\xfe"
    with pytest.raises(cal.FileError):
        READERS[name](odd)
    with open(odd, "wb") as file:
        file.write(b"\xff")
    with pytest.raises(cal.FormatError):
        READERS[name](odd)


def test_a_character_list_iterates_in_its_own_order():
    built_in = cal.built_in_characters()
    assert [character.code for character in built_in] == [character.code for character in built_in.characters]
    assert len(cal.lay_out(list(built_in)[:3])[0].characters) == 3


@pytest.mark.parametrize("method", [cal.NearestPointOptions(), {}, None, 3])
def test_an_invalid_method_is_rejected(method):
    with pytest.raises(TypeError, match="method: "):
        cal.nearest_point([[0, 0], [1, 0]], [[0, 1]], method)


def brushed():
    half_widths, offsets = np.zeros(24), np.zeros(24)
    half_widths[:8], offsets[:8] = np.linspace(0.01, 0.045, 8), 0.002
    return cal.StrokeInk(start=0.01, end=0.02, half_widths=half_widths, offsets=offsets)


def test_ink_belongs_to_a_stroke_and_has_an_outline():
    heng = cal.StrokeInput(1, [[0.1, 0.5], [0.9, 0.5]], ink=brushed())
    character = cal.make_character("一", [heng])
    stroke = character.strokes()[0]
    assert stroke.ink == brushed() == character.ink[0] == stroke.input().ink
    assert character == pickle.loads(pickle.dumps(character))
    outline = cal.ink_outline(stroke)
    x, y = outline.T
    area = 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
    line = cal.ink_line(stroke)
    assert len(line.knots) == 8 and line.knots[-1] == pytest.approx(0.83) and line.corners == []
    assert line.directions == pytest.approx(np.tile([1.0, 0.0], (8, 1)))
    half_widths = brushed().half_widths[:8]
    trapezia = np.sum(np.diff(line.knots) * (half_widths[1:] + half_widths[:-1]))
    assert area == pytest.approx(trapezia + 0.5 * np.pi * (0.01**2 + 0.045**2), rel=0.01)
    discs = cal.ink_discs(stroke)
    assert discs.shape[1] == 3 and discs[0] == pytest.approx([0.09, 0.502, 0.01])


def test_a_stroke_without_ink_has_no_outline():
    stroke = cal.paper_example().strokes()[0]
    assert stroke.ink is None and cal.paper_example().ink == []
    with pytest.raises(cal.InvalidValue, match="has no ink"):
        cal.ink_outline(stroke)
    with pytest.raises(cal.InvalidValue, match="half_widths: expected shape \\(24,\\), got \\(3,\\)"):
        cal.StrokeInk(half_widths=[0.1, 0.2, 0.3])
