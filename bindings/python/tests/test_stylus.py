"""What a pen senses besides its place is kept to the last bit."""

import numpy as np
import pytest

import calligraphy as cal

SENSED = [0.1, 0.0, 1.1, -1 / 3, np.nan, 1e-3]


def sensed():
    return cal.StylusState(**dict(zip(cal.stylus_columns, SENSED)))


def test_a_stylus_equals_another_where_neither_senses():
    assert tuple(cal.stylus_columns) == cal.StylusState.fields
    assert cal.StylusState() == cal.StylusState() != sensed() == sensed()
    assert cal.DeviceState(stylus=sensed()) == cal.DeviceState(stylus=sensed()) != cal.DeviceState()
    assert cal.Intention(stylus=sensed()).stylus == sensed()


def test_tilts_are_an_altitude_and_an_azimuth():
    stylus = sensed()
    cal.set_tilt(stylus, 0.0, np.pi / 4)
    assert (stylus.altitude, stylus.azimuth) == pytest.approx((np.pi / 4, np.pi / 2)) and stylus.pressure == SENSED[0]


def test_what_the_pen_of_a_tablet_senses_is_in_the_samples_of_a_pointer_device():
    device = cal.PointerDevice(cal.device_profile("ideal"))
    device.move(0.01, 0.02, 0.5, cal.tip_button | cal.eraser_button, stylus=sensed())
    sample = device.read()
    assert sample.stylus == sensed() == device.intention.stylus and sample.buttons == 33
    device.move(0.01, 0.02, 0.5)
    assert device.read().stylus == cal.StylusState()


def test_a_trace_keeps_what_the_pen_sensed(tmp_path):
    stylus = [np.array([SENSED, np.full(6, np.nan)]), np.array([SENSED])]
    given = {
        "strokes": [[[0.25, 0.5, 0.0], [0.75, 0.5, 0.125]], [[0.5, 0.75, 0.5]]],
        "stylus": stylus,
        "buttons": [[cal.tip_button | cal.barrel_button, -1], [0]],
        "air": [[], [[0.625, 0.5, 0.25]], []],
        "air_stylus": [[], stylus[1], []],
        "air_buttons": [[], [0], []],
    }
    trace = cal.PenTrace("十", **given)
    cal.write_pen_traces(tmp_path / "traces.txt", [trace])
    (again,) = cal.read_pen_traces(tmp_path / "traces.txt")
    for found in (trace, again):
        for name, arrays in given.items():
            for one, other in zip(getattr(found, name), arrays, strict=True):
                assert np.array_equal(one, np.reshape(other, one.shape), equal_nan=one.dtype.kind == "f"), name
    assert again.buttons[0].dtype == np.int32
    assert again == cal.PenTrace(**{**given, "character": "十"})
    assert again != cal.PenTrace("十", **{**given, "air_buttons": []})


def test_a_trace_without_a_stylus_has_what_says_so():
    trace = cal.PenTrace("一", [[[0, 0, 0], [1, 0, 1]]])
    assert np.isnan(trace.stylus[0]).all() and trace.stylus[0].shape == (2, 6)
    assert trace.buttons[0].tolist() == [-1, -1]
    assert trace.air == trace.air_stylus == trace.air_buttons == []


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"stylus": [np.zeros((2, 5))]}, "stylus: expected shape (n, 6), got (2, 5)"),
        ({"stylus": [np.zeros((1, 6))]}, "stylus: expected shape (2, 6), got (1, 6)"),
        ({"stylus": [[], []]}, "stylus: expected as many arrays as strokes, 1, or none, got 2"),
        ({"buttons": [[1]]}, "buttons: expected shape (2,), got (1,)"),
        ({"buttons": [[1, 0.5]]}, "buttons: expected integers from -1 to 2147483647, got 0.5"),
        ({"buttons": [[1, -2]]}, "buttons: expected integers from -1 to 2147483647, got -2.0"),
        ({"air": [[]]}, "air: expected one array more than strokes, 2, or none, got 1"),
        ({"air_stylus": [[]]}, "air_stylus: expected as many arrays as air, 0, or none, got 1"),
    ],
)
def test_arrays_of_a_trace_that_do_not_belong_together_are_refused(given, told):
    with pytest.raises(cal.InvalidValue) as refused:
        cal.PenTrace("一", [[[0, 0, 0], [1, 0, 1]]], **given)
    assert str(refused.value) == told


def test_a_recording_keeps_what_came_in():
    page = cal.lay_out([cal.built_in_characters()["一"]])[0]
    device = cal.device_profile("desktop")
    recording = cal.write_page(page, cal.SessionOptions(device=device, renderer=cal.RendererOptions.for_device(device)))
    inputs = recording.inputs
    assert len(inputs) == len(recording) and inputs.dtype == cal.input_dtype and not inputs.flags.writeable
    assert np.array_equal(inputs["time"], recording.samples["time"])
    assert np.nanmax(inputs["pressure"]) > 0 and np.nanmax(inputs["height"]) > 0 and np.isnan(inputs["tip_force"]).all()
    assert inputs["force"].shape == (len(inputs), 3)
    kept = {name: getattr(recording, name) for name in ("rate", "samples", "page", "law", "setup")}
    assert cal.Recording(**kept, inputs=inputs.copy()) == recording != cal.Recording(**kept)
    assert len(cal.Recording(**kept).inputs) == 0


def test_the_columns_of_inputs_are_the_members_of_a_device_state_and_its_stylus():
    own = [name for name in cal.DeviceState.fields if name != "stylus"]
    of_pen = ["tip_force" if name == "force" else name for name in cal.StylusState.fields]
    assert list(cal.input_dtype.names) == own + of_pen
    assert cal.input_dtype["buttons"] == np.uint32


def test_inputs_that_cannot_be_of_the_samples_are_refused():
    samples, inputs = np.zeros(2, cal.sample_dtype), np.zeros(2, cal.input_dtype)
    with pytest.raises(cal.InvalidValue, match="inputs: expected one for each of 2 samples, or none, got 1"):
        cal.Recording(1000.0, samples, inputs=inputs[:1])
    inputs["fault"][1] = 200
    with pytest.raises(cal.InvalidValue, match=r"inputs\[1\]: status 0, fault 200: no such status or fault"):
        cal.Recording(1000.0, samples, inputs=inputs)
