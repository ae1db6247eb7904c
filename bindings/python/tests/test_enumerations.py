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
    for other in (cal.WritingMistakeKind.order, 1, "force", None):  # numbers are rejected too
        with pytest.raises(TypeError):
            cal.SessionOptions(mode=other)


def test_values_from_cpp_are_members_and_compare_with_array_elements():
    options = cal.SessionOptions(mode=cal.FeedbackMode.vision)
    assert options.mode is cal.FeedbackMode.vision and type(cal.DeviceState().status) is cal.DeviceStatus
    assert (np.array([0, 1]) == cal.FeedbackMode.force).tolist() == [False, True]


def test_tick_events_are_bit_flags():
    both = cal.TickEvent.contact | cal.TickEvent.lift
    assert cal.TickEvent.lift in both and cal.TickEvent.stroke_started not in both and not cal.TickEvent(0)
    assert both == 3 and (np.array([3, 4], dtype=np.uint16) & cal.TickEvent.lift).tolist() == [2, 0]
