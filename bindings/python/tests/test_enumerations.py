"""Enumerations are those of Python's enum: members and nothing else, by value and by name."""

import copy
import enum
import pickle

import numpy as np
import pytest

import calligraphy as cal

KINDS = [value for value in vars(cal).values() if isinstance(value, enum.EnumMeta)]


def test_there_are_enumerations():
    assert len(KINDS) > 20 and cal.FeedbackMode in KINDS and cal.DeviceFault in KINDS
    assert all(kind.__doc__ and issubclass(kind, enum.IntEnum) for kind in KINDS if kind is not cal.TickEvent)


@pytest.mark.parametrize("kind", KINDS)
def test_members_are_found_kept_and_copied(kind):
    for member in kind:
        assert kind(int(member)) is kind(np.int64(member)) is kind[member.name] is member
        assert copy.deepcopy(member) is member
        for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
            assert pickle.loads(pickle.dumps(member, protocol)) is member


def test_what_is_no_member_is_refused():
    for given in (7, -1, 1000, 2**80, None, "force", 0.5):
        with pytest.raises(ValueError, match="is not a valid Mode"):
            cal.FeedbackMode(given)
    with pytest.raises(KeyError):
        cal.FeedbackMode["blind"]
    for other in (cal.WritingMistakeKind.order, 1, "force", None):  # a number is no member either
        with pytest.raises(TypeError):
            cal.SessionOptions(mode=other)


def test_what_cpp_gives_is_a_member_and_compares_with_numbers_of_arrays():
    options = cal.SessionOptions(mode=cal.FeedbackMode.vision)
    assert options.mode is cal.FeedbackMode.vision and type(cal.DeviceState().status) is cal.DeviceStatus
    assert (np.array([0, 1]) == cal.FeedbackMode.force).tolist() == [False, True]


def test_events_of_a_tick_are_a_set_of_flags():
    both = cal.TickEvent.contact | cal.TickEvent.lift
    assert cal.TickEvent.lift in both and cal.TickEvent.stroke_started not in both and not cal.TickEvent(0)
    assert both == 3 and (np.array([3, 4], dtype=np.uint16) & cal.TickEvent.lift).tolist() == [2, 0]
