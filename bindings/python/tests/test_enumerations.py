"""Enumerations: their members and nothing else."""

import pickle

import numpy as np
import pytest

import calligraphy as cal

KINDS = [value for value in vars(cal).values() if isinstance(value, type) and hasattr(value, "__members__")]


def test_there_are_enumerations():
    assert len(KINDS) > 25 and cal.FeedbackMode in KINDS and cal.DeviceFault in KINDS


@pytest.mark.parametrize("kind", KINDS)
def test_a_number_that_is_no_members_is_refused_with_those_that_exist(kind):
    members = kind.__members__
    for number in (max(map(int, members.values())) + 1, -1, 1000, 2**80):
        for given in (number, np.int64(number)) if abs(number) < 2**60 else (number,):
            with pytest.raises(cal.InvalidValue) as refused:
                kind(given)
            told = str(refused.value)
            assert told.startswith(f"{kind.__name__}: {number} is none of ")
            assert all(f"{name} ({int(member)})" in told for name, member in members.items())
    for given in (0.0, "0", None, 1j, [0]):
        with pytest.raises(TypeError, match=f"^{kind.__name__}: an integer is expected, not "):
            kind(given)
    with pytest.raises(TypeError):
        kind()


@pytest.mark.parametrize("kind", KINDS)
def test_a_member_is_made_by_its_number_whatever_integer_that_is(kind):
    for name, member in kind.__members__.items():
        for number in (int(member), np.uint8(int(member)), np.int64(int(member)), member):
            assert kind(number) == kind(value=number) == member and kind(number).name == name
        for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
            assert pickle.loads(pickle.dumps(member, protocol)) == member


@pytest.mark.parametrize("kind", KINDS)
def test_a_pickle_with_a_number_that_is_no_members_is_refused(kind):
    forged = pickle.dumps(kind(0), 0).replace(b"I0\n", b"I77\n")
    assert b"I77\n" in forged
    with pytest.raises(cal.InvalidValue, match=f"^{kind.__name__}: 77 is none of "):
        pickle.loads(forged)


def test_bits_that_are_together_no_member_are_a_number():
    both = int(cal.TickEvent.contact) | int(cal.TickEvent.lift)
    assert cal.has(both, cal.TickEvent.lift) and not cal.has(both, cal.TickEvent.stroke_started)
    with pytest.raises(cal.InvalidValue, match="TickEvent: 3 is none of none \\(0\\), contact \\(1\\), lift \\(2\\)"):
        cal.TickEvent(both)
