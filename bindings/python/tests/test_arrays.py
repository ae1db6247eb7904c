"""NumPy arrays at the boundary: dtype, shape, strides, NaN, empty, huge, lifetime."""

import gc
import re
import weakref

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import calligraphy as cal

CUBIC = np.array([[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 0.5]])


def bezier(control_points: np.ndarray, t: np.ndarray) -> np.ndarray:
    """De Casteljau's algorithm, for arrays of parameters."""
    row = [np.broadcast_to(p, (len(t), 2)) for p in control_points]
    while len(row) > 1:
        row = [a + t[:, None] * (b - a) for a, b in zip(row, row[1:])]
    return row[0]


finite = st.floats(-1e3, 1e3, allow_subnormal=False)


@settings(deadline=None, max_examples=30, derandomize=True, database=None)
@given(
    hnp.arrays(float, st.tuples(st.integers(2, 5), st.just(2)), elements=finite),
    hnp.arrays(float, st.tuples(st.integers(0, 8), st.just(2)), elements=finite),
)
def test_no_sample_of_the_curve_is_nearer_than_the_certified_point(control_points, queries):
    result = cal.nearest_point(control_points, queries)
    size = np.linalg.norm(np.ptp(control_points, axis=0))
    on_curve = bezier(control_points, np.linspace(0, 1, 201))
    for i, query in enumerate(queries):
        least = np.min(np.linalg.norm(on_curve - query, axis=1))
        reach = size + np.linalg.norm(query - control_points[0])
        assert result.distance[i] <= least + 1e-9 * reach + 1e-150 or not result.certified[i]
        there = bezier(control_points, result.parameter[i : i + 1])[0]
        assert np.allclose(there, result.point[i], atol=1e-12 * (1 + np.abs(control_points).max()))
        assert np.isclose(np.linalg.norm(query - result.point[i]), result.distance[i], atol=1e-9 * (1 + reach))


def test_the_result_has_the_documented_shapes_and_types():
    result = cal.nearest_point(CUBIC, np.zeros((7, 2)))
    assert (result.parameter.shape, result.point.shape, result.distance.shape) == ((7,), (7, 2), (7,))
    assert (result.tangent.shape, result.certified.shape, result.certified.dtype) == ((7, 2), (7,), np.dtype(bool))
    assert result.parameter.dtype == result.point.dtype == np.float64
    assert len(result) == 7


def test_single_queries_and_a_batch_give_identical_results():
    queries = np.random.default_rng(1).normal(size=(100, 2))
    for method in ("exact", "tracked", "sampled", "wang2006"):
        batch = cal.nearest_point(CUBIC, queries, method=method)
        alone = [cal.nearest_point(CUBIC, queries[i : i + 1], method=method) for i in range(100)]
        assert np.array_equal(batch.parameter, np.concatenate([a.parameter for a in alone]))
        assert np.array_equal(batch.distance, np.concatenate([a.distance for a in alone]))


def test_a_prepared_element_gives_the_same_results_as_its_control_points():
    queries = np.random.default_rng(2).normal(size=(64, 2))
    element = cal.StrokeElement(CUBIC)
    assert np.array_equal(cal.nearest_point(element, queries).point, cal.nearest_point(CUBIC, queries).point)
    t = np.linspace(0, 1, 11)
    assert np.allclose(element.point(t), bezier(CUBIC, t), atol=1e-14)
    assert element.point(0.5).shape == (2,)
    assert np.allclose(np.linalg.norm(element.tangent(t), axis=1), 1.0)


@pytest.mark.parametrize("method", ["exact", "sampled"])
def test_the_nearest_point_of_a_character_is_the_nearest_of_all_elements(method):
    placement = cal.Placement(origin=(0.01, -0.02), em=0.05)
    character = cal.built_in_characters()["永"]
    queries = np.random.default_rng(4).uniform(-0.02, 0.07, size=(700, 2))
    queries[5] = np.nan
    strokes = character.strokes()
    for given, asked in [(character, strokes), *((stroke, [stroke]) for stroke in strokes)]:
        found = cal.nearest_points(given, queries, placement, method=method)
        elements = [(i, k, e) for i, s in enumerate(asked) for k, e in enumerate(cal.place_elements(s, placement))]
        alone = [cal.nearest_point(element, queries, method) for _, _, element in elements]
        least = np.min([each.distance for each in alone], axis=0)
        assert len(found) == len(queries) and np.allclose(found.closest.distance, least, rtol=0, atol=1e-15)
        for (stroke, index, _), each in zip(elements, alone):
            own = (found.stroke == stroke) & (found.element == index)
            for part in ("parameter", "point", "distance", "tangent", "status"):
                assert np.array_equal(getattr(found.closest, part)[own], getattr(each, part)[own])
        assert found.closest.status[5] == cal.NearestPointStatus.not_finite and found.element[5] == 0


@pytest.mark.parametrize(
    "layout",
    [
        lambda q: np.asfortranarray(q),
        lambda q: np.repeat(q, 3, axis=0)[::3],
        lambda q: q[::-1][::-1],
        lambda q: q.tolist(),
        lambda q: np.concatenate([[0.0], q.ravel()])[1:].reshape(-1, 2),
        lambda q: np.hstack([q, q])[:, 2:],
        lambda q: q.astype(">f8"),
    ],
    ids=["fortran", "strided", "reversed twice", "list", "odd alignment", "column slice", "big endian"],
)
def test_the_result_does_not_depend_on_the_memory_layout(layout):
    queries = np.random.default_rng(3).normal(size=(100, 2))
    expected = cal.nearest_point(CUBIC, queries)
    given_so = cal.nearest_point(CUBIC, layout(queries))
    assert np.array_equal(expected.parameter, given_so.parameter)
    assert np.array_equal(expected.point, given_so.point)


@pytest.mark.parametrize("dtype", [np.float32, np.float16, np.int64, np.uint8])
def test_dtypes_convertible_to_double_are_accepted(dtype):
    queries = np.arange(20).reshape(10, 2).astype(dtype)
    assert np.array_equal(
        cal.nearest_point(CUBIC, queries).distance, cal.nearest_point(CUBIC, queries.astype(float)).distance
    )


@pytest.mark.parametrize("dtype", [complex, np.complex64, bool, object, "U4", "datetime64[s]", np.longdouble])
def test_other_dtypes_are_rejected_naming_the_argument(dtype):
    if dtype is np.longdouble and np.dtype(np.longdouble).itemsize == 8:
        pytest.skip("long double is double here")
    with pytest.raises(cal.InvalidValue, match="queries: expected real numbers"):
        cal.nearest_point(CUBIC, np.zeros((3, 2), dtype=dtype))


@pytest.mark.parametrize("shape", [(3,), (2,), (3, 3), (3, 2, 1), (), (0, 3), (2, 1)])
def test_a_wrong_shape_of_queries_is_rejected_naming_the_expected_and_the_given_one(shape):
    with pytest.raises(cal.InvalidValue) as refused:
        cal.nearest_point(CUBIC, np.zeros(shape))
    assert "queries" in str(refused.value) and "(n, 2)" in str(refused.value) and str(shape) in str(refused.value)
    assert isinstance(refused.value, ValueError) and isinstance(refused.value, cal.Error)


@pytest.mark.parametrize("count", [0, 1, 6])
def test_a_curve_of_invalid_degree_is_rejected(count):
    with pytest.raises(cal.InvalidValue, match=r"control_points: expected shape \(2, 2\) to \(5, 2\), got"):
        cal.nearest_point(np.zeros((count, 2)), CUBIC)


def test_ragged_lists_are_rejected_naming_the_argument():
    with pytest.raises(cal.InvalidValue, match="queries"):
        cal.nearest_point(CUBIC, [[0.0, 1.0], [2.0]])


def test_an_unknown_method_is_rejected_naming_the_available_ones():
    with pytest.raises(cal.InvalidValue, match="exact.*wang2006.*'newton'"):
        cal.nearest_point(CUBIC, CUBIC, method="newton")
    with pytest.raises(TypeError):
        cal.nearest_point(CUBIC, CUBIC, method=None)


def test_no_queries_give_empty_results():
    for empty in ([], np.zeros((0, 2))):
        result = cal.nearest_point(CUBIC, empty)
        assert result.point.shape == (0, 2) and result.certified.shape == (0,)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_non_finite_query_is_reported_and_affects_no_other(value):
    queries = np.random.default_rng(4).normal(size=(200, 2))
    spoilt = queries.copy()
    spoilt[77, 1] = value
    good, bad = cal.nearest_point(CUBIC, queries), cal.nearest_point(CUBIC, spoilt)
    assert bad.distance[77] == np.inf and not bad.certified[77]
    assert bad.status[77] == int(cal.NearestPointStatus.not_finite)
    others = np.arange(200) != 77
    assert np.array_equal(good.point[others], bad.point[others])


def test_non_finite_control_points_certify_nothing():
    curve = CUBIC.copy()
    curve[2, 0] = np.nan
    assert not cal.nearest_point(curve, CUBIC).certified.any()


def test_a_million_queries_are_answered():
    queries = np.random.default_rng(5).normal(size=(1_000_000, 2))
    result = cal.nearest_point(CUBIC, queries)
    assert result.certified.all()
    some = slice(0, None, 99_991)
    assert np.array_equal(result.parameter[some], cal.nearest_point(CUBIC, queries[some]).parameter)


def test_the_queries_are_not_written_to_and_may_be_read_only():
    queries = np.random.default_rng(6).normal(size=(100, 2))
    before = queries.copy()
    queries.flags.writeable = False
    cal.nearest_point(CUBIC, queries)
    assert np.array_equal(queries, before)


def test_arrays_outlive_their_owner():
    def shape_and_factors():
        character = cal.built_in_characters()["永"]
        stroke = character.strokes()[1]
        return character.control_points, stroke.control_points, character.stroke_ids, stroke.attraction_factors

    expected = [array.copy() for array in shape_and_factors()]
    kept = shape_and_factors()
    gc.collect()
    for _ in range(100):  # reuse freed memory, to expose dangling views
        cal.built_in_characters()
    for array, copy in zip(kept, expected):
        assert np.array_equal(array, copy)
    position = cal.DeviceState(position=(1, 2, 3)).position
    offset = cal.SessionOptions(skill=cal.WriterSkill(speed=2.0)).skill.grip
    gc.collect()
    np.zeros(1000)
    assert position.tolist() == [1, 2, 3] and offset.mass == 0.1


def character():
    return cal.built_in_characters()["永"]


@pytest.mark.parametrize(
    ("make", "part"),
    [
        (character, lambda it: it.strokes()[1]),
        (character, lambda it: it.control_points),
        (character, lambda it: it.stroke_ids),
        (character, lambda it: it.feature_points),
        (character, lambda it: it.attraction_factors),
        (character, lambda it: it.strokes()[1].control_points),
        (character, lambda it: it.strokes()[1].attraction_factors),
        (character, lambda it: it.strokes()[1].control_points[1:, 0]),
        (lambda: cal.Recording(1.0, np.ones(5, dtype=cal.sample_dtype)), lambda it: it.samples["time"]),
        (cal.DeviceState, lambda it: it.position),
        (cal.MotionMapping, lambda it: it.rotation),
        (cal.SessionOptions, lambda it: it.device),
        (cal.SessionOptions, lambda it: it.device.workspace),
        (lambda: cal.PlacedCharacter(character()), lambda it: it.character.control_points),
    ],
)
def test_a_view_keeps_its_owner_alive_and_then_releases_it(make, part):
    """Freed memory often keeps its contents, so this asks Python whether the owner is alive."""
    whole = make()
    owner, kept = weakref.ref(whole), part(whole)
    del whole
    gc.collect()
    assert owner() is not None
    del kept
    gc.collect()
    assert owner() is None


def test_views_of_immutable_data_are_read_only():
    character = cal.built_in_characters()["永"]
    for array in (character.control_points, character.stroke_ids, character.attraction_factors):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
    assert np.shares_memory(character.control_points, character.control_points)


def test_a_vector_of_a_record_is_a_view():
    state = cal.DeviceState()
    state.position[2] = 0.25
    assert state.position.tolist() == [0.0, 0.0, 0.25]
    state.position = [1, 2, 3]
    assert state.position.tolist() == [1.0, 2.0, 3.0]
    with pytest.raises(cal.InvalidValue, match=r"position: expected shape \(3,\), got \(2,\)"):
        state.position = [1, 2]
    mapping = cal.MotionMapping()
    mapping.rotation = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
    assert mapping.to_page([1.0, 0.0, 0.0]).tolist() == [0.0, -1.0, 0.0]
    assert mapping.rotation.tolist() == [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]


PAGE = cal.lay_out([cal.built_in_characters()["永"]])[0]
UPRIGHT = cal.upright_page(PAGE.width, PAGE.height)
CAPABILITIES = cal.device_profile("desktop")
TURNED = cal.MotionMapping(rotation=[[0, 1, 0], [-1, 0, 0], [0, 0, 1]], offset=(1, 2, 3), scale=0.5)


def traced(positions, times=None):
    ticks = cal.HapticRenderer(PAGE.characters, UPRIGHT, CAPABILITIES).trace(positions, times)
    return np.concatenate([ticks["time"], ticks["device_point"].ravel()])


def felt(force):
    device = cal.ReplayDevice([cal.DeviceState()], cal.Capabilities(peak_force=1e9))
    device.write(force)
    return device.last_force


#: All functions with array arguments: the argument's name, a valid array, and a call. A length of None is arbitrary.
TAKERS = {
    "nearest_point": ("queries", (None, 2), lambda a: cal.nearest_point(CUBIC, a).point),
    "nearest_points": (
        "queries", (None, 2),
        lambda a: cal.nearest_points(PAGE.characters[0].character, a).closest.point,
    ),
    "StrokeElement.point": ("t", (None,), lambda a: cal.StrokeElement(CUBIC).point(a)),
    "StrokeElement.tangent": ("t", (None,), lambda a: cal.StrokeElement(CUBIC).tangent(a)),
    "StrokeElement.curvature": ("t", (None,), lambda a: cal.StrokeElement(CUBIC).curvature(a)),
    "trace": ("positions", (None, 3), traced),
    "trace at times": ("times", (4,), lambda a: traced(np.zeros((4, 3)), a)),
    "HapticDevice.write": ("force", (3,), felt),
    "DeviceState.position": ("position", (3,), lambda a: cal.DeviceState(position=a).position),
    "Placement.origin": ("origin", (2,), lambda a: cal.Placement(origin=a).origin),
    "Placement.to_page": ("points", (None, 2), lambda a: cal.Placement(origin=(1, 2)).to_page(a)),
    "MotionMapping.rotation": ("rotation", (3, 3), lambda a: cal.MotionMapping(rotation=a).rotation),
    "MotionMapping.to_page": ("device", (3,), TURNED.to_page),
    "MotionMapping.to_device": ("page", (3,), TURNED.to_device),
    "MotionMapping.force_to_device": ("page", (3,), TURNED.force_to_device),
    "SimulatedDevice": (
        "position", (3,),
        lambda a: cal.SimulatedDevice(cal.device_profile("ideal"), cal.GripImpedance(), a).true_position,
    ),
    "StrokeInput": ("control_points", (None, 2), lambda a: cal.StrokeInput(1, a).control_points),
    "PenTrace": ("strokes", (None, 3), lambda a: cal.PenTrace("一", [a]).strokes[0]),
}  # fmt: skip


def expected_shape(shape):
    return str(tuple("n" if length is None else length for length in shape)).replace("'n'", "n")


@pytest.mark.parametrize("name", TAKERS)
@settings(deadline=None, max_examples=10, derandomize=True, database=None)
@given(st.data())
def test_a_wrong_shape_is_rejected_naming_the_expected_and_the_given_one(name, data):
    argument, fits, call = TAKERS[name]
    # Shapes off by one in length or number of axes, and arbitrary ones.
    near = [tuple(5 if n is None else n for n in fits)]
    near += [s[:i] + (s[i] + d,) + s[i + 1 :] for s in near for i in range(len(s)) if fits[i] for d in (-1, 1)]
    near = [*near[1:], near[0] + (1,), near[0][1:]]
    shape = data.draw(st.sampled_from(near) | hnp.array_shapes(min_dims=0, min_side=0))
    fitting = len(shape) == len(fits) and all(want in (None, got) for want, got in zip(fits, shape))
    if fitting or (shape == (0,) and fits[0] is None):  # an empty list has no second dimension
        return
    if name.startswith("StrokeElement") and shape == ():
        return  # a single parameter is valid
    with pytest.raises(cal.InvalidValue) as refused:
        call(np.zeros(shape))
    told = str(refused.value)
    assert told == f"{argument}: expected shape {expected_shape(fits)}, got {shape}"


@pytest.mark.parametrize("name", TAKERS)
@settings(deadline=None, max_examples=6, derandomize=True, database=None)
@given(st.data())
def test_results_do_not_depend_on_how_an_argument_is_stored(name, data):
    """Any strides, including negative and zero ones, alignment, byte order and dtype that represents the numbers."""
    _, fits, call = TAKERS[name]
    least = 0 if len(fits) > 1 else 1
    shape = tuple(data.draw(st.integers(least, 6)) if n is None else n for n in fits)
    numbers = np.array(data.draw(hnp.arrays(np.int64, shape, elements=st.integers(0, 9))), dtype=float)
    if name == "trace at times":
        numbers = 1 + np.cumsum(1 + numbers)
    expected = call(np.ascontiguousarray(numbers))
    steps = tuple(slice(None, None, data.draw(st.sampled_from([-3, -1, 2]))) for _ in shape)
    large = np.zeros([3 * n for n in shape])
    large[steps][tuple(slice(0, n) for n in shape)] = numbers
    unaligned = np.zeros(8 * numbers.size + 1, dtype=np.uint8)[1:].view(float).reshape(shape)
    unaligned[...] = numbers
    layouts = [
        large[steps][tuple(slice(0, n) for n in shape)], np.asfortranarray(numbers), unaligned, numbers.astype(">f8"),
        numbers.astype(np.float32), numbers.astype(np.int16), numbers.tolist(),
    ]  # fmt: skip
    if shape[0] > 0:
        layouts.append(np.moveaxis(np.stack([numbers, -numbers], axis=-1), -1, 0)[0])
    before = [np.array(layout) for layout in layouts]
    for layout, copy in zip(layouts, before):
        assert np.array_equal(call(layout), expected)
        assert np.array_equal(layout, copy)
    same = np.broadcast_to(numbers[:1], shape)
    if name != "trace at times":
        assert np.array_equal(call(same), call(np.array(same)))


@pytest.mark.parametrize("name", TAKERS)
@pytest.mark.parametrize("dtype", [complex, bool, object, "U4", "S4", "datetime64[s]", [("x", float)]], ids=str)
def test_values_other_than_real_numbers_are_rejected_naming_the_argument(name, dtype):
    argument, fits, call = TAKERS[name]
    with pytest.raises(cal.InvalidValue, match=f"^{argument}: expected real numbers"):
        call(np.zeros([2 if n is None else n for n in fits], dtype=dtype))
    with pytest.raises(cal.InvalidValue, match=f"^{argument}: "):
        call(object())


@pytest.mark.parametrize("name", TAKERS)
def test_values_that_numpy_cannot_convert_are_rejected_naming_the_argument(name):
    argument, fits, call = TAKERS[name]
    if not name.startswith("StrokeElement"):
        for ragged in ([[1.0, 2.0], [3.0]], [0.0, [1.0, 2.0]]):
            with pytest.raises(cal.InvalidValue, match=f"^{argument}: expected an array of numbers: .*inhomog"):
                call(ragged)

    class Failing:
        def __init__(self, error):
            self.error = error

        def __array__(self, *_, **__):
            raise self.error

    with pytest.raises(cal.InvalidValue, match=f"^{argument}: expected an array of numbers: not today"):
        call(Failing(LookupError("not today")))
    with pytest.raises(KeyboardInterrupt):
        call(Failing(KeyboardInterrupt()))


@pytest.mark.parametrize("name", [name for name, (_, fits, _) in TAKERS.items() if fits[0] is None])
def test_an_array_too_large_to_copy_raises_memory_error_naming_the_argument(name):
    argument, fits, call = TAKERS[name]
    endless = np.broadcast_to(np.float32(0.0), (10**16, *fits[1:]))
    with pytest.raises(MemoryError, match=rf"^{argument}: shape \(10000000000000000,.*\) cannot be copied: Unable"):
        call(endless)


def test_of_a_subclass_that_cannot_be_copied_only_the_numbers_are_used():
    class Stubborn(np.ndarray):
        def __array_finalize__(self, origin):
            if type(origin) is Stubborn:
                raise LookupError("no copies of me")

    assert cal.Placement(origin=np.ones(2, dtype=np.float32).view(Stubborn)).origin.tolist() == [1.0, 1.0]


@pytest.mark.parametrize("name", TAKERS)
def test_masked_numbers_are_rejected_and_masked_arrays_without_any_are_accepted(name):
    argument, fits, call = TAKERS[name]
    numbers = np.ma.array(np.ones(tuple(2 if n is None else n for n in fits)))
    if name == "trace at times":
        numbers = np.ma.array([1.0, 2.0, 3.0, 4.0])
    assert np.array_equal(call(numbers), call(numbers.data))
    numbers[(0,) * numbers.ndim] = np.ma.masked
    with pytest.raises(cal.InvalidValue, match=f"^{argument}: got a masked array"):
        call(numbers)


@pytest.mark.parametrize("t", [np.float32(0.5), np.int64(1), np.float64(0.25), 1, 0.5, np.array(0.5)], ids=repr)
def test_a_scalar_of_any_type_is_one_parameter(t):
    element = cal.StrokeElement(CUBIC)
    assert np.allclose(element.point(t), bezier(CUBIC, np.array([float(t)]))[0]) and element.point(t).shape == (2,)


@settings(deadline=None, max_examples=15, derandomize=True, database=None)
@given(hnp.arrays(float, st.tuples(st.integers(0, 20), st.just(3)), elements=st.floats() | st.floats(-0.1, 0.1)))
def test_the_force_is_finite_for_any_position(positions):
    """Includes NaN, infinite, huge and tiny positions."""
    renderer = cal.HapticRenderer(PAGE.characters, UPRIGHT, CAPABILITIES)
    ticks = renderer.trace(positions)
    assert np.isfinite(ticks["force"]).all() and np.linalg.norm(ticks["force"], axis=1).max(initial=0) <= 7.9 + 1e-9
    unusable = ~np.isfinite(positions).all(axis=1)
    assert (ticks["status"][unusable] == int(cal.TickStatus.bad_sample)).all()


@settings(deadline=None, max_examples=30, derandomize=True, database=None)
@given(hnp.arrays(float, 6, elements=st.floats()))
def test_the_force_is_finite_for_any_times(times):
    renderer = cal.HapticRenderer(PAGE.characters, UPRIGHT, CAPABILITIES)
    assert np.isfinite(renderer.trace(np.full((6, 3), -1e-3), times)["force"]).all()


def test_huge_values_and_arrays_are_passed_unchanged():
    positions = np.zeros((300_000, 3))
    positions[-1] = 1e-4
    ticks = cal.HapticRenderer(PAGE.characters, UPRIGHT, CAPABILITIES).trace(positions)
    assert len(ticks) == 300_000 and np.allclose(ticks["device_point"][-1], UPRIGHT.to_page(positions[-1]))
    rows = np.zeros(200_000, dtype=cal.sample_dtype)
    rows["stroke"] = np.arange(200_000)
    assert cal.Recording(1000.0, rows).samples["stroke"][-1] == 199_999
    for size in (1e20, 1e150):  # nothing is specified for sizes whose square overflows
        found = cal.nearest_point([[-size, 0], [0, size], [size, 0]], [[0, size], [0, -size]])
        assert np.array_equal(found.certified, np.isfinite(found.distance)) and found.certified.all() == (size == 1e20)


@pytest.mark.parametrize(
    "view",
    [
        lambda: cal.typical_stroke(20).shape,
        lambda: cal.nearest_point(CUBIC, CUBIC).tangent,
        lambda: cal.built_in_characters()["永"].strokes()[2].control_points,
        lambda: cal.lay_out([cal.built_in_characters()["永"]])[0].characters[0].character.control_points,
        lambda: cal.lay_out([cal.built_in_characters()["永"]])[0].characters[0].character.feature_points,
        lambda: cal.guidance_field(cal.PlacedCharacter(character()), 0, 0.0, (0, 0), 0.04, 5)["forces"],
        lambda: cal.tip_jacobian(cal.linkage("omni"), np.zeros((9, 3))),
        lambda: cal.Recording(1.0, np.ones(5000, dtype=cal.sample_dtype)).samples["time"],
        lambda: cal.SessionOptions().device.workspace,
        lambda: cal.upright_page(0.2, 0.1).rotation,
        lambda: traced(np.zeros((500, 3))),
        lambda: cal.CharacterSet(cal.built_in_characters()).find("永").control_points,
    ],
)
def test_a_view_outlives_the_objects_it_came_from(view):
    kept = view()
    copy = kept.copy()
    gc.collect()
    for _ in range(30):  # reuse freed memory, to expose dangling views
        view()
    np.full(100_000, 7.0)
    assert np.array_equal(kept, copy)


@pytest.mark.parametrize("options", [
    {"tolerance": float("nan")}, {"tolerance": 0.0}, {"tolerance": -1.0}, {"tolerance": 2.0}, {"samples": 1},
    {"samples": 65}, {"refinements": -1}, {"refinements": 9},
])  # fmt: skip
def test_options_out_of_range_are_named(options):
    (name,) = options
    with pytest.raises(cal.InvalidValue, match=f"{name} = .*, must be"):
        cal.nearest_point([[0, 0], [1, 2], [2, -1], [3, 0]], [[0.0, 0.0]], **options)
