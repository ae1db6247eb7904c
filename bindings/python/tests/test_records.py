"""Options and results: every struct is stored, copied, compared and pickled, with arbitrary values."""

import copy
import enum
import gc
import itertools
import operator
import pickle
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import calligraphy as cal

RECORDS = [value for value in vars(cal).values() if isinstance(value, type) and hasattr(value, "fields")]
NUMBERS = st.floats(allow_nan=False)
TINY = settings(deadline=None, max_examples=2, derandomize=True, database=None)


def records(kind):
    return st.builds(kind, **{name: values(kind, name) for name in kind.fields})


def values(kind, name):
    """Values of a field: anything that its type accepts, because structs do not validate."""
    default = getattr(kind(), name)
    if (kind, name) == (cal.GuidanceOptions, "force"):
        return st.sampled_from(["linear", "saturating", "wang2006"])
    if type(default) in RECORDS:
        return records(type(default))
    if type(default) is cal.Recording:
        return NUMBERS.filter(lambda rate: 0.0 < rate < np.inf).map(lambda rate: cal.Recording(rate, []))
    if type(default) is cal.Character:
        return st.sampled_from([default, *(cal.built_in_characters()[code] for code in "永一人")])
    if hasattr(type(default), "__members__"):
        return st.sampled_from(list(type(default).__members__.values()))
    if isinstance(default, np.ndarray) and default.shape == (4, 4):
        return affine_maps()
    if isinstance(default, np.ndarray):
        return hnp.arrays(float, default.shape, elements=st.floats())
    if isinstance(default, list):
        return st.lists(LISTS[kind, name](), max_size=3)
    if default is None:
        return st.none() | OPTIONAL[name]()
    if default == "\0":  # a single character
        return st.sampled_from("永一\U00020000")
    return {
        bool: st.booleans(),
        int: st.integers(0, 2**15),
        float: NUMBERS,
        str: st.text(max_size=5),
    }[type(default)]


def affine_maps():
    return hnp.arrays(float, (3, 4), elements=st.floats()).map(lambda rows: np.vstack([rows, [0.0, 0.0, 0.0, 1.0]]))


def placed():
    characters = cal.built_in_characters()
    return st.builds(
        cal.PlacedCharacter, st.sampled_from([characters[code] for code in "永一人"]), records(cal.Placement)
    )


OPTIONAL = {"mapping": lambda: records(cal.MotionMapping), "law": lambda: st.just(cal.device_profile)}  # any function
LISTS = {
    (cal.PracticePage, "characters"): placed,
    (cal.CharacterScore, "pen_downs"): lambda: records(cal.PenDownScore),
    (cal.CharacterScore, "strokes"): lambda: records(cal.StrokeScore),
    (cal.InkImport, "traces"): lambda: NUMBERS.map(lambda x: cal.PenTrace("一", [[[x, 0, 0]]])),
    (cal.InkImport, "notes"): lambda: st.text(max_size=5),
    (cal.LessonRemark, "strokes"): lambda: st.integers(0, 9),
    (cal.LessonScore, "pen_downs"): lambda: st.integers(0, 9),
    (cal.LessonScore, "remarks"): lambda: records(cal.LessonRemark),
    (cal.LessonView, "ink"): lambda: records(cal.LessonInk),
    (cal.LessonView, "strokes"): lambda: records(cal.LessonStroke),
    (cal.LessonWriting, "attempts"): lambda: records(cal.LessonEvent),
    (cal.LessonWriting, "strokes"): lambda: records(cal.LessonStroke),
    (cal.MatchResult, "drawn"): lambda: records(cal.DrawnStroke),
    (cal.MatchResult, "remarks"): lambda: records(cal.StrokeRemark),
    (cal.StabilityMapOptions, "grips"): lambda: records(cal.GripImpedance),
    (cal.StabilityMapOptions, "delays"): lambda: st.integers(0, 9),
    **{(cal.StabilityMapOptions, n): lambda: NUMBERS for n in ("dampings", "rates", "encoder_steps", "wall_dampings")},
}
if "phantom" in cal.backends:
    LISTS[cal.PluggedDevice, "nodes"] = lambda: st.text(max_size=5)


def test_structs_are_found():
    assert len(RECORDS) > 30 and cal.SessionOptions in RECORDS and cal.CharacterScore in RECORDS


@pytest.mark.parametrize("kind", RECORDS)
@TINY
@given(st.data())
def test_every_struct_survives_pickling_and_copying_and_differs_if_one_field_differs(kind, data):
    one = data.draw(records(kind))
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(one, protocol)) == one
    assert copy.copy(one) == one == copy.deepcopy(one) == kind(**{name: getattr(one, name) for name in kind.fields})
    assert repr(one).startswith(kind.__name__ + "(") and repr(copy.copy(one)) == repr(one)
    name = data.draw(st.sampled_from(kind.fields))
    value = data.draw(values(kind, name))
    other = copy.copy(one)
    setattr(other, name, value)
    now, before = getattr(other, name), getattr(one, name)
    same = np.array_equal(now, before, equal_nan=True) if isinstance(now, np.ndarray) else now == before
    assert (one == other) == same and (one != other) == (not same)
    assert one != 3 and one != None  # noqa: E711


@pytest.mark.parametrize("kind", RECORDS)
def test_a_pickle_of_another_version_keeps_the_common_fields(kind):
    """A field unknown to the other version has its default; one unknown to this version is reported."""
    state = kind().__reduce__()[0].keywords
    assert tuple(state) == kind.fields
    for name in kind.fields:
        assert kind(**{other: value for other, value in state.items() if other != name}) == kind()
    with pytest.raises(TypeError, match=f"{kind.__name__} has no field 'later'; it has {kind.fields[0]}"):
        kind(**{**state, "later": 1})


class Foreign:
    """Of no type that any field takes."""

    def __repr__(self):
        return "a foreign object"


class Unshown:
    def __repr__(self):
        raise ValueError("of your own")


@pytest.mark.parametrize("kind", [*RECORDS, cal.CharacterList])
def test_a_value_of_another_type_is_rejected_with_the_name_of_its_field_what_is_expected_and_what_was_given(kind):
    one = kind()
    for name in kind.__match_args__:
        ways = [lambda name=name: setattr(one, name, Foreign())]
        if kind in RECORDS:
            ways.append(lambda name=name: kind(**{name: Foreign()}))
        for assign in ways:
            with pytest.raises((TypeError, cal.InvalidValue)) as raised:
                assign()
            told, default = str(raised.value), getattr(one, name)
            if isinstance(default, np.ndarray):  # by the rules for arrays
                assert told == f"{name}: expected real numbers (dtype float64 or convertible to it), got object"
                continue
            assert raised.type is TypeError
            assert told.startswith(f"{name}: expected ") and told.endswith(", got a foreign object")
            if type(default) in RECORDS or isinstance(default, enum.Enum):
                assert re.search(rf"expected an? {type(default).__name__},", told)
    assert one == kind()


@pytest.mark.parametrize(
    "owner, value, told",
    [
        (cal.ServoOptions(), {"rate": "fast"}, "rate: expected a number, got 'fast'"),
        (cal.SessionOptions(), {"mode": 3}, "mode: expected a FeedbackMode, got 3"),
        (cal.SessionOptions(), {"device": None}, "device: expected a Capabilities, got None"),
        (cal.SessionOptions(), {"mapping": 3}, "mapping: expected a MotionMapping or None, got 3"),
        (cal.SessionOptions(), {"measure_ticks": "no"}, "measure_ticks: expected True or False, got 'no'"),
        (cal.LiveOptions(), {"renderer": "soft"}, "renderer: expected a RendererOptions, got 'soft'"),
        (cal.GuidanceOptions(), {"assist": 1}, "assist: expected an AssistPolicy, got 1"),
        (cal.DeviceState(), {"buttons": -1}, "buttons: expected an integer from 0 to 4294967295, got -1"),
        (cal.StabilityMapOptions(), {"rates": [1.0, "x"]}, "rates: expected a list of numbers, got [1.0, 'x']"),
        (cal.StabilityMapOptions(), {"grips": 3}, "grips: expected a list of GripImpedance, got 3"),
        (cal.PracticePage(), {"characters": [0] * 99}, "characters: expected a list of PlacedCharacter, got [0, 0, 0, ... 99 in all]"),
        (cal.CharacterScore(), {"character": "永一"}, "character: expected a str of length 1, got '永一'"),
        (cal.Provenance(), {"source": 3}, "source: expected a str, got 3"),
        (cal.Provenance(), {"source": b"me"}, "source: expected a str, got b'me'"),
        (cal.SessionOptions(), {"measure_ticks": None}, "measure_ticks: expected True or False, got None"),
        (cal.SessionOptions(), {"measure_ticks": 2.5}, "measure_ticks: expected True or False, got 2.5"),
        (cal.StabilityMapOptions(), {"rates": np.array(3.0)}, "rates: expected a list of numbers, got 3.0"),
        (cal.ServoOptions(), {"rate": {"a": "x" * 99}}, "rate: expected a number, got {'a': '" + "x" * 70 + "..."),
        (cal.ServoOptions(), {"rate": Unshown()}, "rate: expected a number, got <Unshown object>"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_a_rejected_value_is_told_in_words(owner, value, told):
    for assign in (lambda: setattr(owner, *next(iter(value.items()))), lambda: type(owner)(**value)):
        with pytest.raises(TypeError) as raised:
            assign()
        assert str(raised.value) == told


def test_a_bool_of_numpy_is_a_bool():
    assert cal.SessionOptions(measure_ticks=np.bool_(True)).measure_ticks is True


def test_nan_equals_nan_in_every_field_type():
    nan = float("nan")
    assert cal.DeviceState() == cal.DeviceState() and cal.GripImpedance(mass=nan) == cal.GripImpedance(mass=nan) != cal.GripImpedance()
    assert cal.PenKinematics(begin=nan) in [cal.PenKinematics(begin=nan)]


@pytest.mark.parametrize("kind", RECORDS)
def test_a_copy_shares_nothing_with_the_original(kind):
    original = kind()
    for again in (copy.copy(original), copy.deepcopy(original), pickle.loads(pickle.dumps(original))):
        for name in kind.fields:
            value, ours = getattr(original, name), getattr(again, name)
            if isinstance(value, np.ndarray):
                assert not np.shares_memory(value, ours)
            elif type(value) in RECORDS:
                field = next(f for f in value.fields if not isinstance(getattr(value, f), list))
                before = copy.copy(getattr(value, field))
                setattr(ours, field, _another(getattr(ours, field)))
                assert np.array_equal(getattr(value, field), before, equal_nan=isinstance(before, (float, np.ndarray)))


def _another(value):
    if isinstance(value, np.ndarray):
        return np.nan_to_num(value) + 1
    if hasattr(type(value), "__members__"):
        return list(type(value).__members__.values())[-1]
    other_text = "永" if value == "\0" else f"{value}x"
    return {bool: lambda: not value, str: lambda: other_text}.get(type(value), lambda: _number(value))()


def _number(value):
    return copy.copy(value) if type(value) in RECORDS else type(value)(1 if value == 0 else 2 * value)


@pytest.mark.parametrize(
    "owner, name, make",
    [
        (cal.PracticePage(), "characters", lambda: cal.PlacedCharacter(cal.built_in_characters()["永"])),
        (cal.MatchResult(), "remarks", lambda: cal.StrokeRemark(evidence=0.5)),
        (cal.CharacterList(), "characters", lambda: cal.built_in_characters()["永"]),
    ],
    ids=lambda value: value if isinstance(value, str) else type(value).__name__,
)
def test_a_list_field_is_a_copy_that_outlives_its_owner(owner, name, make):
    setattr(owner, name, [make() for _ in range(3)])
    kept = getattr(owner, name)
    setattr(owner, name, [])
    gc.collect()
    setattr(owner, name, [make() for _ in range(50)])  # reuse freed memory, to expose dangling references
    setattr(owner, name, [])
    assert kept == [make() for _ in range(3)] and getattr(owner, name) == []


def test_a_change_to_an_element_of_a_list_does_not_reach_its_owner():
    score = cal.MatchResult(remarks=[cal.StrokeRemark(stroke=1)])
    score.remarks[0].stroke = 2
    score.remarks.append(cal.StrokeRemark())
    assert score.remarks == [cal.StrokeRemark(stroke=1)]


def test_unknown_fields_and_wrong_types_are_rejected():
    for kind in RECORDS:
        with pytest.raises(TypeError, match=f"{kind.__name__} has no field 'no_field'; it has {kind.fields[0]}"):
            kind(no_field=1)
        with pytest.raises(TypeError):
            kind(1)
        with pytest.raises(TypeError, match="unhashable"):
            hash(kind())


def test_the_repr_of_a_struct_is_a_constructor_call():
    assert repr(cal.GripImpedance(mass=0.5)) == "GripImpedance(mass=0.5, damping=3.0, stiffness=300.0)"
    state = repr(cal.DeviceState(position=(1, 2, 3)))
    assert state.startswith("DeviceState(time=0.0, position=[1.0, 2.0, 3.0], velocity=")


def test_pages_are_equal_if_their_characters_are():
    characters = cal.built_in_characters()
    one, again, other = (cal.lay_out([characters[code]])[0] for code in "永永一")
    assert one == again == pickle.loads(pickle.dumps(one)) and one != other
    assert characters["永"] == cal.built_in_characters()["永"] != characters["一"]
    assert characters["永"] != cal.with_quartic_curves(characters["永"]) and characters["永"] != "永"
    moved = cal.PlacedCharacter(characters["永"], cal.Placement(origin=(0.01, 0)))
    assert moved != cal.PlacedCharacter(characters["永"]) and moved == pickle.loads(pickle.dumps(moved))


#: Objects other than structs that support pickling and copying.
RESULTS = {
    "NearestPoints": lambda: cal.nearest_point([[0, 0], [1, 2], [3, 0]], [[0, 1], [2, 2], [np.nan, 0]]),
    "CharacterPoints": lambda: cal.nearest_points(cal.built_in_characters()["永"], [[0.03, 0.01], [np.nan, 0]]),
    "Recording": lambda: cal.Recording(
        500.0, np.ones(3, dtype=cal.sample_dtype), inputs=np.ones(3, dtype=cal.input_dtype),
        setup=cal.RecordingSetup(mode="vision"),
    ),
    "StrokeInput": lambda: cal.StrokeInput(1, [[0, 0], [1, 1]], [1.0, 2.0], ink=cal.StrokeInk(start=0.1)),
    "PenTrace": lambda: cal.PenTrace(
        "一", [[[0, 0, 0], [1, 0, 0.5]], np.zeros((0, 3))], set="made", em=500.0,
        stylus=[np.full((2, 6), 0.5), np.zeros((0, 6))], buttons=[[1, -1], []], air=[[], [[0, 0, 0.6]], []],
        selector="\ufe00",
    ),
    "CharacterList": lambda: cal.CharacterList(
        [cal.built_in_characters()["永"]], cal.Provenance(source="mine", licence="MIT")
    ),
    "TypicalStroke": lambda: cal.typical_stroke(7),
    "FeedbackMode": lambda: cal.FeedbackMode.force,
}
PARTS = {
    "NearestPoints": ("parameter", "point", "distance", "tangent", "status", "certified"),
    "CharacterPoints": ("stroke", "element", "closest"),
    "Recording": ("rate", "samples", "inputs", "setup"),
    "StrokeInput": ("id", "control_points", "attraction_factors", "elements", "ink"),
    "PenTrace": ("character", "set", "em", "strokes", "stylus", "buttons", "air", "selector"),
    "CharacterList": ("characters", "provenance"),
    "TypicalStroke": ("id", "name"),
    "FeedbackMode": ("name", "value"),
}


@pytest.mark.parametrize("name", RESULTS)
@pytest.mark.parametrize("again", [lambda x: pickle.loads(pickle.dumps(x)), copy.copy, copy.deepcopy])
def test_results_survive_pickling_and_copying(name, again):
    original = RESULTS[name]()
    result = again(original)
    assert type(result) is type(original)
    for part in PARTS[name]:
        one, other = getattr(original, part), getattr(result, part)
        if isinstance(one, np.ndarray) and one.dtype.names is None:
            assert np.array_equal(one, other, equal_nan=one.dtype.kind == "f") and one.dtype == other.dtype
        elif part in ("strokes", "stylus", "buttons", "air"):
            assert len(one) == len(other) >= 2 and all(map(np.array_equal, one, other))
        else:
            assert np.array_equal(one, other) if isinstance(one, np.ndarray) else one == other


@pytest.fixture(scope="module")
def written():
    page = cal.lay_out([cal.built_in_characters()["一"]])[0]
    device = cal.device_profile("desktop")
    options = cal.SessionOptions(device=device, renderer=cal.RendererOptions.for_device(device))
    return page, cal.write_page(page, options)


def test_other_classes_have_a_one_line_repr(written):
    page, recording = written
    characters = cal.built_in_characters()
    stroke = characters["永"].strokes()[0]
    element = cal.StrokeElement([[0, 0], [3, 4]])
    renderer = cal.HapticRenderer(page.characters, cal.MotionMapping(), cal.device_profile("omni"))
    told = [
        (element, "StrokeElement(degree 1, length 5)"),
        (stroke, f"Stroke({stroke.type.name}, {len(stroke.control_points)} control points)"),
        (characters["永"], "Character(永, 5 strokes)"),
        (cal.CharacterSet(characters), f"CharacterSet({len(characters.characters)} characters)"),
        (renderer, "HapticRenderer(page of 1 at 1000 Hz)"),
        (recording,
         f"Recording(rate=1000.0, samples=array({len(recording)},), page={recording.page}, law='linear: 600 N/m', "
         f"inputs=array({len(recording)},), setup=RecordingSetup(...))"),
        (cal.PenTrace("一", [[[0, 0, 0]]], set="mine"),
         "PenTrace(character='一', strokes=[[[0.0, 0.0, 0.0]]], set='mine', em=1000.0)"),
        (cal.PenTrace("一", [[[0, 0, 0]]], buttons=[[1]], air=[[], []]),
         "PenTrace(character='一', strokes=[[[0.0, 0.0, 0.0]]], set='unnamed', em=1000.0, buttons=[[1]], air=[[], []])"),
        (cal.CharacterList([], cal.Provenance(source="me")),
         "CharacterList(characters=[], provenance=Provenance(source='me', licence='', attribution='', licence_text=''))"),
    ]  # fmt: skip
    assert [repr(value) for value, _ in told] == [text for _, text in told]
    assert repr(characters).startswith("CharacterList(characters=[Character(") and f"... {len(characters)} in all]" in repr(characters)


def test_the_repr_of_long_values_is_abbreviated_with_their_length():
    strokes = cal.StrokeInput(1, [[0, 0], [1, 1]], np.arange(50.0))
    assert "attraction_factors=[0.0, 1.0, 2.0, ... 50 in all]" in repr(strokes)
    assert "attraction_factors=[0.0, 1.0], elements='', ink=None)" in repr(cal.StrokeInput(1, [[0, 0], [1, 1]], [0.0, 1.0]))
    licence = repr(cal.Provenance(licence_text="word " * 1000))
    assert "licence_text='word word" in licence and "... 5000 characters in all" in licence and len(licence) < 200
    match = cal.MatchResult(remarks=[cal.StrokeRemark()])
    score = repr(cal.CharacterScore(character="永", match=match))
    assert score.startswith("CharacterScore(character='永', time=nan") and "remarks=[StrokeRemark(kind=" in score


def test_objects_that_own_a_device_or_a_file_cannot_be_pickled():
    page = cal.lay_out([cal.built_in_characters()["一"]])[0]
    profile = cal.device_profile("ideal")
    for protocol, value in itertools.product(range(pickle.HIGHEST_PROTOCOL + 1), (
        cal.SimulatedDevice(profile),
        cal.Servo(cal.SimulatedDevice(profile), lambda state: (0, 0, 0)),
        cal.HapticRenderer(page.characters, cal.MotionMapping(), profile),
        cal.Lesson([page], profile),
        cal.CharacterSet(cal.built_in_characters()),
    )):  # fmt: skip
        with pytest.raises(TypeError, match="pickle"):
            pickle.dumps(value, protocol)


CLASSES = [
    value
    for value in vars(cal).values()
    if isinstance(value, type) and value.__module__ == "calligraphy._calligraphy" and type(value).__name__ == "pybind11_type"
]


@pytest.mark.parametrize("kind", CLASSES)
def test_an_object_whose_init_was_not_called_is_rejected(kind):
    """Whatever uses it, because the object is empty."""
    unfinished = kind.__new__(kind)
    names = [name for name in dir(kind) if isinstance(getattr(kind, name, None), property)]
    for use in [repr, copy.copy, hash, lambda it: it == kind.__new__(kind), *map(operator.attrgetter, names)]:
        try:
            use(unfinished)
        except (TypeError, ValueError) as error:  # missing attributes are rejected with other messages
            assert str(error)
