"""What was written is on disk as it comes, is read again to the last bit, and is a table."""

import gzip
import io
import os
import pickle
import signal
import subprocess
import sys
import zlib

import numpy as np
import pytest

import calligraphy as cal

PAGE = cal.lay_out([cal.built_in_characters()["一"]])[0]
DEVICE = cal.device_profile("desktop")
BRIEF = cal.LiveOptions(timeout=3.0)


def options_with(**given):
    renderer = cal.RendererOptions.for_device(DEVICE)
    renderer.guidance.assist.enabled = True
    return cal.SessionOptions(device=DEVICE, renderer=renderer, **given)


def same(one, other):
    """Whether two structured arrays are the same to the last bit, but for the bytes between columns."""
    return one.dtype == other.dtype and all(one[name].tobytes() == other[name].tobytes() for name in one.dtype.names)


@pytest.fixture(scope="module")
def written():
    return cal.write_page(PAGE, options_with())


@pytest.fixture(scope="module")
def stored(written, tmp_path_factory):
    """The bytes of a compressed file in which a block ends every few ticks, as of a session that takes its time."""
    path = tmp_path_factory.mktemp("stored") / "plain"
    cal.write_recording(path, written)
    stream = zlib.compressobj(wbits=31)
    text = path.read_bytes()
    parts = [text[i : i + 500] for i in range(0, len(text), 500)]
    return b"".join(stream.compress(part) + stream.flush(zlib.Z_SYNC_FLUSH) for part in parts) + stream.flush()


@pytest.mark.parametrize("name", ["plain", "some.recording.gz"])
@pytest.mark.parametrize("mode", ["force", "vision"])
def test_a_recording_is_read_as_it_was_written_to_the_last_bit(name, mode, tmp_path):
    mapping = cal.desk_page(PAGE.width, PAGE.height, 2.0)
    recording = cal.write_page(PAGE, options_with(mode=mode, mapping=mapping))
    cal.write_recording(tmp_path / name, recording)
    content = (tmp_path / name).read_bytes()
    assert content.startswith(b"\x1f\x8b" if name.endswith(".gz") else b"calligraphy recording 1\n")
    again = cal.read_recording(tmp_path / name)
    assert again.is_complete and again.has_same_forces
    assert same(again.recording.samples, recording.samples) and len(recording) > 500
    assert same(again.recording.inputs, recording.inputs)
    assert again.recording.setup == recording.setup == pickle.loads(pickle.dumps(recording)).setup
    assert again.recording == recording
    setup = recording.setup
    assert (setup.page, setup.mapping, setup.device.name) == (PAGE, mapping, DEVICE.name)
    assert setup.mode == cal.FeedbackMode[mode]
    assert setup.renderer.guidance.assist.enabled and not setup.has_own_law


def test_the_forces_of_an_own_law_are_stored_and_its_name(tmp_path):
    def mine(state):
        return (0.0, 0.1, 0.3 * np.sin(30 * state.time))

    recording = cal.write_page(PAGE, options_with(law=mine))
    cal.write_recording(tmp_path / "own.gz", recording)
    again = cal.read_recording(tmp_path / "own.gz")
    assert again.recording == recording and again.has_same_forces and np.ptp(recording.samples["force"][:, 2]) > 0.3
    assert recording.setup.has_own_law and recording.law == "mine"


def test_the_setup_of_an_own_guidance_law_has_the_name_alone():
    options = options_with()
    options.renderer.guidance.force = lambda given: (0.1, 0.0)
    recording = cal.write_page(PAGE, options)
    assert recording.setup.has_own_law and recording.setup.renderer.guidance.force == "linear"
    assert pickle.loads(pickle.dumps(recording)) == recording


def test_ticks_are_made_again_also_with_another_setup(written):
    assert same(cal.replayed(written).samples, written.samples)
    setup = written.setup
    setup.mode = "vision"
    assert written.setup.mode == cal.FeedbackMode.force, "it is a copy"
    seen = cal.replayed(cal.Recording(written.rate, written.samples, inputs=written.inputs, setup=setup))
    assert not seen.samples["force"].any() and written.samples["force"].any()
    assert seen.setup == setup != written.setup
    bare = cal.Recording(written.rate, written.samples, inputs=written.inputs)
    assert bare.setup is None
    with pytest.raises(cal.InvalidValue, match="without a set-up its ticks cannot be made again"):
        cal.replayed(bare)


def test_a_recording_without_a_setup_is_not_written(written, tmp_path):
    bare = cal.Recording(written.rate, written.samples, inputs=written.inputs)
    for name in ("plain", "some.gz"):
        with pytest.raises(cal.InvalidValue, match="without a set-up its forces could not be made again"):
            cal.write_recording(tmp_path / name, bare)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("share", [0.5, 0.7, 0.9, 0.99])
def test_a_compressed_recording_that_was_cut_off_is_read_up_to_its_last_whole_block(share, written, stored, tmp_path):
    cut = stored[: int(share * len(stored))]
    (tmp_path / "cut.gz.part").write_bytes(cut)
    again = cal.read_recording(tmp_path / "cut.gz.part")
    assert not again.is_complete and not again.has_same_forces
    count = len(again.recording)
    assert same(again.recording.samples, written.samples[:count])
    last_block = cut.rindex(b"\0\0\xff\xff") + 4  # a block that was flushed ends like this
    whole = zlib.decompressobj(wbits=31).decompress(cut[:last_block])
    ticks = whole[whole.index(b"\nticks\n") + 7 :].count(b"\n")
    assert ticks <= count < ticks + 500 and ticks > 10


def test_a_compressed_recording_of_which_only_the_checksum_is_missing_is_complete(written, stored, tmp_path):
    (tmp_path / "cut.gz").write_bytes(stored[:-4])
    again = cal.read_recording(tmp_path / "cut.gz")
    assert again.is_complete and again.has_same_forces and again.recording == written


def test_a_large_recording_is_read_in_pieces(written, tmp_path):
    """Longer than a piece, compressed or not; its last bytes are of another gzip file."""
    tenfold = {name: np.tile(getattr(written, name), 60) for name in ("samples", "inputs")}
    many = cal.Recording(written.rate, setup=written.setup, page=written.page, law=written.law, **tenfold)
    cal.write_recording(tmp_path / "plain", many)
    text = (tmp_path / "plain").read_bytes()
    (tmp_path / "two.gz").write_bytes(gzip.compress(text[:-9], 1) + gzip.compress(text[-9:]))
    assert (tmp_path / "two.gz").stat().st_size > 150_000
    again = cal.read_recording(tmp_path / "two.gz")
    assert again.is_complete and same(again.recording.inputs, many.inputs)


@pytest.mark.parametrize("at", [0.2, 0.6])
def test_damaged_compressed_data_is_refused_by_name(at, stored, tmp_path):
    place = int(at * len(stored))
    damaged = stored[:place] + bytes(byte ^ 0xFF for byte in stored[place : place + 100]) + stored[place + 100 :]
    (tmp_path / "damaged.gz").write_bytes(damaged)
    with pytest.raises(cal.FormatError) as refused:
        cal.read_recording(tmp_path / "damaged.gz")
    assert str(refused.value) == f"{tmp_path / 'damaged.gz'}: the compressed data is damaged"


def test_a_checksum_of_compressed_data_that_is_wrong_is_refused(stored, tmp_path):
    (tmp_path / "wrong.gz").write_bytes(stored[:-8] + b"abcd" + stored[-4:])
    with pytest.raises(cal.FormatError, match="wrong.gz: the compressed data is damaged"):
        cal.read_recording(tmp_path / "wrong.gz")


@pytest.mark.parametrize("size", [2, 12, 100])
def test_a_compressed_recording_without_a_tick_is_refused_by_name(size, stored, tmp_path):
    (tmp_path / "short.gz").write_bytes(stored[:size])
    with pytest.raises(cal.FormatError, match="short.gz"):
        cal.read_recording(tmp_path / "short.gz")


@pytest.mark.parametrize("with_inputs", [True, False])
@pytest.mark.parametrize("name", ["ticks.csv", "ticks.csv.gz"])
def test_the_columns_are_those_of_the_table_of_ticks(name, with_inputs, written, tmp_path):
    inputs = written.inputs.copy()
    for column in ("tip_force", "altitude", "azimuth", "twist"):
        inputs[column] = np.linspace(0.0, 1.0, len(inputs))
    samples = written.samples.copy()
    samples["time"] += 2.5
    recording = cal.Recording(written.rate, samples, inputs=inputs if with_inputs else [])
    cal.write_ticks(tmp_path / name, recording)
    content = (tmp_path / name).read_bytes()
    text = (gzip.decompress(content) if name.endswith(".gz") else content).decode()
    lines = [line.split(",") for line in io.StringIO(text).read().splitlines()]
    columns = recording.columns()
    assert list(columns) == lines[0] and ("height_m" in columns) == with_inputs
    for (called, column), cells in zip(columns.items(), zip(*lines[1:], strict=True), strict=True):
        assert column.shape == (len(recording),) and column.flags.writeable and column.base is None
        if called in ("state", "status"):
            assert column.dtype.kind == "U" and column.tolist() == list(cells)
            continue
        step = {"s": 1e-6, "m": 1e-7, "N": 1e-4, "rad": 1e-4}.get(called.split("_")[-1], 1.0)
        step = {"pressure": 1e-5, "height_m": 1e-5}.get(called, step)
        read = np.array([float(cell or "nan") for cell in cells])
        assert np.array_equal(np.isnan(read), np.isnan(column))
        assert np.nanmax(abs(read - column)) <= 0.51 * step, called
        assert np.ptp(read[~np.isnan(read)]) > 0 or called in ("buttons", "tick_ns", "character", "status"), called
    assert columns["time_s"][0] == 0.0 < recording.samples["time"][0]


def test_the_columns_take_one_line_to_a_parquet_file(written, tmp_path):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("pyarrow")
    pandas.DataFrame(written.columns()).to_parquet(tmp_path / "ticks.parquet")
    again = pandas.read_parquet(tmp_path / "ticks.parquet")
    for name, column in written.columns().items():
        assert np.array_equal(again[name].to_numpy().astype(column.dtype), column, equal_nan=column.dtype.kind == "f")
    assert len(cal.Recording(1.0, written.samples[:0]).columns()["time_s"]) == 0


@pytest.mark.parametrize("name", ["plain", "page-1.recording.gz"])
def test_every_kind_of_session_stores_its_recording(name, tmp_path):
    trace = cal.PenTrace("一", [[[0.1, 0.5, 0.0], [0.9, 0.5, 0.8]]])
    states = [cal.DeviceState(time=1e-3 * i, position=(0, 0, 0.02)) for i in range(300)]
    left = iter(range(300))
    sessions = {
        "write_page": lambda path: cal.write_page(PAGE, options_with(), store=path),
        "follow_trace": lambda path: cal.follow_trace(PAGE, trace, options_with(), store=path),
        "replay_page": lambda path: cal.replay_page(PAGE, cal.ReplayDevice(states, DEVICE), options_with(), store=path),
        "run_session": lambda path: cal.run_session(
            PAGE, options_with(), lambda tick, _: cal.Intention() if next(left, None) else None, store=path
        ),
        "write_with_device": lambda path: cal.write_with_device(
            PAGE, cal.PointerDevice(DEVICE), cal.LiveOptions(timeout=0.4), store=path
        ).recording,
    }
    for which, session in sessions.items():
        path = tmp_path / which / name
        path.parent.mkdir()
        recording = session(path)
        again = cal.read_recording(path)
        assert [each.name for each in path.parent.iterdir()] == [name]
        assert path.read_bytes().startswith(b"\x1f\x8b") == name.endswith(".gz")
        assert again.is_complete and len(again.recording) == len(recording) > 0, which
        assert same(again.recording.inputs, recording.inputs)


def test_a_session_does_not_overwrite_a_stored_recording(tmp_path):
    for name in ("some.gz", "other.gz.part"):
        (tmp_path / name).write_text("of a person")
    for name, of in (("some.gz", "some.gz"), ("other.gz", "other.gz.part")):
        for session in (
            lambda path: cal.write_page(PAGE, options_with(), store=path),
            lambda path: cal.write_with_device(PAGE, cal.PointerDevice(DEVICE), BRIEF, store=path),
        ):
            with pytest.raises(cal.FileError, match="cannot be written: File exists") as refused:
                session(tmp_path / name)
            assert refused.value.filename == str(tmp_path / of)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["other.gz.part", "some.gz"]
    assert [path.read_text() for path in tmp_path.iterdir()] == ["of a person"] * 2
    with pytest.raises(FileNotFoundError):
        cal.write_page(PAGE, options_with(), store=tmp_path / "nowhere" / "some.gz")


def test_what_was_written_before_an_exception_is_on_disk(tmp_path):
    def broken(view):
        if view.started and view.newest["time"] > 0.3:
            raise KeyError("mine")

    with pytest.raises(KeyError) as raised:
        cal.write_with_device(PAGE, cal.PointerDevice(DEVICE), BRIEF, broken, store=tmp_path / "live.gz")
    again = cal.read_recording(tmp_path / "live.gz.part")
    assert not again.is_complete and not (tmp_path / "live.gz").exists()
    recording = raised.value.result.recording
    assert same(again.recording.inputs, recording.inputs) and len(recording) > 100


KILLED = """
import os, signal, sys
import calligraphy as cal
page = cal.lay_out([cal.built_in_characters()["永"]])[0]
def watch(view):
    if view.started and view.newest["time"] > 1.5:
        print(view.newest["time"], flush=True)
        os.kill(os.getpid(), signal.SIGKILL)
device = cal.PointerDevice(cal.device_profile("desktop"))
cal.write_with_device(page, device, cal.LiveOptions(timeout=9.0), watch, store=sys.argv[1])
"""


def environment():
    return {**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(cal.__file__))}


@pytest.mark.parametrize("name", ["plain", "some.gz"])
def test_what_a_person_wrote_until_the_program_was_killed_is_there(name, tmp_path):
    command = [sys.executable, "-c", KILLED, str(tmp_path / name)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, env=environment(), cwd=tmp_path)
    assert done.returncode == -signal.SIGKILL, done.stderr
    again = cal.read_recording(tmp_path / f"{name}.part")
    assert not again.is_complete
    assert float(done.stdout) - 0.5 < again.recording.samples["time"][-1] <= float(done.stdout)


FULL = """
import resource, sys
import calligraphy as cal
page = cal.lay_out([cal.built_in_characters()["永"]])[0]
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]),) * 2)
device = cal.PointerDevice(cal.device_profile("desktop"))
try:
    cal.write_with_device(page, device, cal.LiveOptions(timeout=3.0), store=sys.argv[1])
except cal.FileError as error:
    print(error, error.errno, error.filename, len(error.result.recording))
"""


def test_a_disk_that_fills_ends_a_session_whose_result_has_everything(tmp_path):
    page = cal.lay_out([cal.built_in_characters()["永"]])[0]
    cal.write_with_device(page, cal.PointerDevice(DEVICE), cal.LiveOptions(timeout=0.1), store=tmp_path / "head")
    limit = (tmp_path / "head").stat().st_size + 1000
    command = [sys.executable, "-c", FULL, str(tmp_path / "full"), str(limit)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, env=environment(), cwd=tmp_path)
    path = f"{tmp_path / 'full'}.part"
    assert done.stdout.startswith(f"{path}: cannot be written: File too large 27 {path} "), done.stdout + done.stderr
    assert 100 < int(done.stdout.split()[-1]) < 2900
    assert len(cal.read_recording(path).recording) > 10


def test_an_option_is_told_and_set_in_words():
    options = cal.RendererOptions()
    told = cal.option_values(options)
    assert told["guidance.stiffness"] == "600" and told["rules"] == "revised" and told["energy.budget"] == "inf"
    given = {"guidance.stiffness": "0.1", "guidance.force": "saturating", "guidance.to_start": "true"}
    for name, value in given.items():
        cal.set_option(options, name, value)
        told[name] = value
    assert (options.guidance.stiffness, options.guidance.force, options.guidance.to_start) == (0.1, "saturating", True)
    assert cal.option_values(options) == told
    again = cal.RendererOptions()
    for name, value in told.items():
        cal.set_option(again, name, value)
    assert again == options
    options.guidance.force = lambda given: (0.0, 0.0)
    assert cal.option_values(options)["guidance.force"] == "own"


@pytest.mark.parametrize(
    ("name", "value"), [("stiffness", "600"), ("guidance.stiffness", "soft"), ("guidance.force", "own")]
)
def test_an_option_that_cannot_be_set_is_refused_and_nothing_changes(name, value):
    options = cal.RendererOptions()
    with pytest.raises(cal.InvalidValue) as refused:
        cal.set_option(options, name, value)
    assert name in str(refused.value) and options == cal.RendererOptions()


def test_compressed_pen_traces_are_written_and_read(tmp_path):
    trace = cal.PenTrace("一", [[[0.1, 0.5, 0.0], [0.9, 0.5, 0.75]]], buttons=[[1, 1]], set="page")
    for name in ("pens.txt", "pens.gz"):
        cal.write_pen_traces(tmp_path / name, [trace] * 3, notice="Mine")
        assert cal.read_pen_traces(tmp_path / name) == [trace] * 3
    text = (tmp_path / "pens.txt").read_bytes()
    assert gzip.decompress((tmp_path / "pens.gz").read_bytes()) == text
    (tmp_path / "saved-by-the-page").write_bytes(gzip.compress(text))
    assert cal.read_pen_traces(tmp_path / "saved-by-the-page") == [trace] * 3


def test_pen_traces_that_were_cut_off_or_damaged_are_refused_by_name(tmp_path):
    trace = cal.PenTrace("一", [[[0.1, 0.5, 0.0], [0.9, 0.5, 0.75]]])
    cal.write_pen_traces(tmp_path / "pens.gz", [trace] * 3)
    content = (tmp_path / "pens.gz").read_bytes()
    for part, told in ((content[:-1], "cut off"), (content[:-20], "cut off"), (content[:-8] + bytes(8), "damaged")):
        (tmp_path / "pens.gz").write_bytes(part)
        with pytest.raises(cal.FormatError, match=f"pens.gz: the compressed data is {told}"):
            cal.read_pen_traces(tmp_path / "pens.gz")
