"""Enumerations are Python enums: members by value and by name, and no other values."""

import copy
import enum
import pickle

import numpy as np
import pytest

import calligraphy as cal

KINDS = [value for value in vars(cal).values() if isinstance(value, enum.EnumMeta)]


def test_all_enumerations_are_int_enums_with_docstrings():
    assert len(KINDS) > 20 and cal.FeedbackMode in KINDS and cal.DeviceFault in KINDS
    assert all(kind.__doc__ and issubclass(kind, enum.IntEnum) for kind in KINDS if kind is not cal.TickEvent)


@pytest.mark.parametrize("kind", KINDS)
def test_members_are_found_by_value_and_name_pickled_and_copied(kind):
    for member in kind:
        assert kind(int(member)) is kind(np.int64(member)) is kind[member.name] is member
        assert copy.deepcopy(member) is member
        for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
            assert pickle.loads(pickle.dumps(member, protocol)) is member


def test_values_that_are_not_members_are_rejected():
    for given in (7, -1, 1000, 2**80, None, "force", 0.5):
        with pytest.raises(ValueError, match="is not a valid FeedbackMode"):
            cal.FeedbackMode(given)
    with pytest.raises(KeyError):
        cal.FeedbackMode["blind"]
    for other in (cal.StrokeRemarkKind.order, 1, None):  # numbers are rejected too
        with pytest.raises(TypeError):
            cal.SessionOptions(mode=other)


FIELDS = [
    (owner, name, type(getattr(owner(), name)))
    for owner in vars(cal).values()
    if isinstance(owner, type) and hasattr(owner, "fields")
    for name in owner.fields
    if type(getattr(owner(), name)) in KINDS
]


@pytest.mark.parametrize("owner, name, kind", FIELDS, ids=lambda value: getattr(value, "__name__", value))
def test_a_field_takes_the_names_of_members_and_no_other_names(owner, name, kind):
    one = owner()
    for member in kind:
        setattr(one, name, member.name)
        assert getattr(one, name) is member is getattr(owner(**{name: member.name}), name)
    for wrong in ("", "no_member", kind.__name__, member.name.upper()):
        for assign in (lambda: setattr(one, name, wrong), lambda: owner(**{name: wrong})):
            with pytest.raises(cal.InvalidValue) as raised:
                assign()
            assert str(raised.value) == f"{name}: expected one of {', '.join(kind.__members__)}, got {wrong!r}"
    assert getattr(one, name) is member


def test_a_function_takes_the_names_of_members_and_no_other_names():
    characters = cal.built_in_characters()
    placed, match = cal.PlacedCharacter(characters["一"]), cal.match_strokes(characters["一"], [])
    calls = {
        cal.WritingHint: [cal.to_string, lambda hint: cal.hint_text(hint, (0.01, 0.0))],
        cal.CoordinatePrecision: [lambda precision: cal.encode_character_set(characters, precision)],
        cal.StrokeRemarkKind: [match.count],
        cal.NearestPointMethod: [lambda method: cal.nearest_point([[0, 0], [1, 0]], [[0.3, 1]], method).parameter[0]],
        cal.Attractor: [lambda to: cal.guidance_field(placed, 0, 0.5, (0, 0), 0.1, 4, attractor=to)["forces"].tolist()],
    }
    for kind, functions in calls.items():
        for function in functions:
            assert [function(member.name) for member in kind] == [function(member) for member in kind]
            with pytest.raises(cal.InvalidValue, match=f"expected one of {', '.join(kind.__members__)}, got 'no_member'"):
                function("no_member")


def test_values_from_cpp_are_members_and_compare_with_array_elements():
    options = cal.SessionOptions(mode=cal.FeedbackMode.vision)
    assert options.mode is cal.FeedbackMode.vision and type(cal.DeviceState().status) is cal.DeviceStatus
    assert (np.array([0, 1]) == cal.FeedbackMode.force).tolist() == [False, True]


def test_tick_events_are_bit_flags():
    both = cal.TickEvent.contact | cal.TickEvent.lift
    assert cal.TickEvent.lift in both and cal.TickEvent.stroke_started not in both and not cal.TickEvent(0)
    assert both == 3 and (np.array([3, 4], dtype=np.uint16) & cal.TickEvent.lift).tolist() == [2, 0]
