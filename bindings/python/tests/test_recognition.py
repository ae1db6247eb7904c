"""Characters are looked up by drawing them; another one, and another accepted form, are told."""

import numpy as np
import pytest

import calligraphy as cal

HENG, SHU = [[0.1, 0.5], [0.9, 0.53]], [[0.5, 0.92], [0.5, 0.06]]


def test_a_character_is_looked_up_by_drawing_it():
    index = cal.CharacterIndex(cal.built_in_characters())
    assert len(index) == len(cal.CharacterIndex(cal.CharacterSet(cal.built_in_characters())))
    found = index.recognise([HENG, np.array(SHU)])
    assert found[0].code == "十"
    assert [each.distance for each in found] == sorted(each.distance for each in found)
    assert len(index.recognise([HENG, SHU], most=1)) == 1
    with pytest.raises(ValueError, match="pen-down 1 has no point"):
        index.recognise([np.empty((0, 2))])


def test_another_character_is_told_only_with_an_index():
    two = cal.built_in_characters()["二"]
    index = cal.CharacterIndex(cal.built_in_characters())
    (remark,) = cal.match_strokes(two, [HENG, SHU], others=index).remarks
    assert (remark.kind.name, remark.other_character) == ("character", "十")
    assert all(each.kind.name != "character" for each in cal.match_strokes(two, [HENG, SHU]).remarks)


def test_every_form_of_layered_sets_is_accepted():
    def ten(*strokes):
        inputs = [cal.StrokeInput(1 if line is HENG else 2, line) for line in strokes]
        return cal.CharacterSet(cal.CharacterList([cal.make_character("十", inputs)]))

    forms = cal.CharacterSet.layered([ten(HENG, SHU), ten(SHU, HENG)]).forms("十")
    match = cal.match_strokes(forms, [SHU, HENG])
    assert (match.accepted, match.remarks) == (1, [])
    assert cal.match_strokes(forms[0], [SHU, HENG]).remarks
    with pytest.raises(ValueError, match="no character"):
        cal.match_strokes([], [HENG])
