"""A run that is interrupted keeps its finished rows, and goes on from its file to the same table."""

import concurrent.futures
import copy
import functools
import json
import linecache
import os
import signal
import subprocess
import sys
import time
import types

import pytest

import calligraphy as cal
from calligraphy import experiment
from test_experiment import Failing, columns, comparable, dtypes


def grid(seeds=2, characters="一人", **axes):
    return experiment.Grid(characters, seeds=seeds, **axes)


@pytest.fixture(scope="module")
def expected():
    return experiment.run(grid(), progress=False)


@pytest.fixture
def trials(monkeypatch):
    """The conditions of the trials run in this process."""
    run, real = [], experiment.trial

    def counted(grid, condition):
        run.append(condition)
        return real(grid, condition)

    monkeypatch.setattr(experiment, "trial", counted)
    return run


def interrupt(monkeypatch, after):
    """Ctrl-C in the trial after so many; returns what undoes it."""
    left, real = [after], experiment.trial

    def interrupted(grid, condition):
        if left[0] == 0:
            raise KeyboardInterrupt
        left[0] -= 1
        return real(grid, condition)

    monkeypatch.setattr(experiment, "trial", interrupted)
    return lambda: monkeypatch.setattr(experiment, "trial", real)


COLUMNS = len(columns(experiment.run(experiment.Grid("一", seeds=0), progress=False)))


def same(table, expected):
    """Equal in every bit, type and order."""
    assert dtypes(table) == dtypes(expected)
    found, wanted = columns(table), columns(expected)
    assert list(map(repr, found.items())) == list(map(repr, wanted.items()))


def head(table, count):
    return {name: values[:count] for name, values in columns(table).items()}


@pytest.mark.parametrize("after", [0, 1, 3, 7])
def test_an_interrupted_run_goes_on_to_the_table_of_an_uninterrupted_one(after, expected, trials, tmp_path, monkeypatch):
    path = tmp_path / "rows.csv"
    mend = interrupt(monkeypatch, after)
    with pytest.raises(KeyboardInterrupt) as pressed:
        experiment.run(grid(), path=path, progress=False)
    assert columns(pressed.value.table) == head(expected, after)
    assert len(path.read_text(encoding="utf-8").splitlines()) == 2 + after
    mend()
    trials.clear()
    same(experiment.run(grid(), path=str(path), progress=False), expected)
    assert trials == experiment.conditions(grid())[after:]
    assert [file.name for file in tmp_path.iterdir()] == ["rows.csv"]


def test_a_finished_file_runs_nothing_and_is_a_table(expected, trials, tmp_path):
    path = tmp_path / "rows.csv"
    same(experiment.run(grid(), path=path, progress=False), expected)
    trials.clear()
    before = path.read_bytes()
    same(experiment.run(grid(), Failing(attempts=99), path=path, progress=False), expected)
    assert trials == [] and path.read_bytes() == before
    pandas = pytest.importorskip("pandas")
    assert columns(pandas.read_csv(path, skiprows=1)) == columns(expected)


def test_without_pandas_too(expected, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    table = experiment.run(grid(), progress=False)
    mend = interrupt(monkeypatch, 5)
    with pytest.raises(KeyboardInterrupt) as pressed:
        experiment.run(grid(), path=tmp_path / "rows.csv", progress=False)
    assert columns(pressed.value.table) == head(expected, 5)
    mend()
    same(experiment.run(grid(), path=tmp_path / "rows.csv", progress=False), table)


def test_numbers_and_names_are_read_back_exactly(tmp_path, monkeypatch):
    """Numbers that need all digits, none or do not exist, and names with every separator."""
    numbers = [0.1 + 0.2, 5e-324, 1.7976931348623157e308, -0.0, float("nan"), float("inf")]
    mine = grid(seeds=[2**64 - 1], characters="一", writers={n: cal.WriterSkill.novice() for n in ('a,"b"\r\nc\nd', "#e", " ")})

    def made_up(grid, condition):
        row = {name: kind(7) for name, kind in experiment._COLUMNS.items()}
        return {**row, "time": numbers[len(condition.writer) % 6], "fidelity": numbers[3], **condition._asdict()}

    monkeypatch.setattr(experiment, "trial", made_up)
    table = experiment.run(mine, path=tmp_path / "rows.csv", progress=False)
    monkeypatch.setattr(experiment, "trial", None)
    same(experiment.run(mine, path=tmp_path / "rows.csv", progress=False), table)


def test_a_file_that_ends_anywhere_goes_on(trials, tmp_path):
    """Cut off after every byte of its last row, whose writer has a line break in its name."""
    mine = grid(seeds=1, characters="一", writers={"永\n,": cal.WriterSkill.novice()})
    path = tmp_path / "rows.csv"
    table = experiment.run(mine, path=path, progress=False)
    whole = path.read_bytes()
    start = whole.index("一".encode(), whole.index("一,".encode()) + 1)
    for length in range(start, len(whole)):
        path.write_bytes(whole[:length])
        trials.clear()
        same(experiment.run(mine, path=path, progress=False), table)
        assert trials == experiment.conditions(mine)[1:], whole[start:length]
        assert path.read_bytes() == whole


@pytest.mark.parametrize(
    "change, named",
    [
        ({"device": "omni"}, "the grid has no Condition.*device='desktop'"),
        ({"device": {"desktop": cal.device_profile("omni")}}, r"devices\['desktop'\][.]"),
        ({"options": cal.RendererOptions.everything(cal.device_profile("desktop"))}, r"options\['desktop'\][.]"),
        ({"character_timeout": 60.0}, "character_timeout is 120.0 there and 60.0 here"),
        ({"page": "desk"}, "page is 'upright' there and 'desk' here"),
        ({"motion_scale": 2.0}, "motion_scale is 1.0 there and 2.0 here"),
        ({"writers": {"novice": cal.WriterSkill.skilled()}}, r"writers\['novice'\][.]"),
        ({"source": cal.CharacterList([cal.with_quartic_curves(cal.built_in_characters()["一"])])}, r"characters\['一'\]"),
        ({"seeds": [2]}, "the grid has no Condition.*seed=1"),
        ({"characters": "人"}, "the grid has no Condition.*'一'"),
        ({"law": ["saturating"]}, "the grid has no Condition.*law='linear'"),
        ({"vary": {"energy.budget": [1.0]}}, r"vary is \[\] there and \['energy.budget'\] here"),
    ],
)
def test_the_file_of_another_experiment_is_refused_naming_what_differs(change, named, trials, tmp_path):
    path = tmp_path / "rows.csv"
    experiment.run(grid(seeds=1, characters="一"), path=path, progress=False)
    before = path.read_bytes()
    trials.clear()
    with pytest.raises(cal.InvalidValue, match=f"rows.csv: of another experiment: {named}"):
        experiment.run(grid(**{"seeds": 1, "characters": "一", **change}), path=path, progress=False)
    assert trials == [] and path.read_bytes() == before


def test_the_file_of_another_version_is_refused(tmp_path, monkeypatch):
    experiment.run(grid(seeds=1, characters="一"), path=tmp_path / "rows.csv", progress=False)
    monkeypatch.setattr(cal, "__version__", "9.9")
    with pytest.raises(cal.InvalidValue, match="version is .* there and 9.9 here"):
        experiment.run(grid(seeds=1, characters="一"), path=tmp_path / "rows.csv", progress=False)


def test_a_grid_may_grow(expected, trials, tmp_path):
    path = tmp_path / "rows.csv"
    small = grid(seeds=1, characters="人", modes=["force"])
    experiment.run(small, path=path, progress=False)
    trials.clear()
    same(experiment.run(grid(), path=path, progress=False), expected)
    assert trials == [each for each in experiment.conditions(grid()) if each not in experiment.conditions(small)]


def law(given):
    return given.way


def test_devices_laws_and_options_may_grow(trials, tmp_path):
    """What is varied no longer depends on the options of all."""
    usual, other = cal.RendererOptions(), cal.RendererOptions()
    other.guidance.damping, other.guidance.to_start, other.tolerances.slack = 3.0, True, 0.05
    vary = {"guidance.damping": [4.0], "guidance.to_start": [False], "tolerances": {"usual": usual.tolerances}}
    more = {"guidance.damping": [2.0, 4.0], "guidance.to_start": [True, False], "tolerances": {
        "normal": cal.StrokeTolerances.normal(), "usual": usual.tolerances}}  # fmt: skip
    path, usual.guidance.force = tmp_path / "rows.csv", law
    small = grid(seeds=1, characters="一", options=usual, vary=vary)
    laws = {"linear": "linear", "law": law}
    large = grid(seeds=1, characters="一", options=other, vary=more, device=["omni", "desktop"], law=laws)
    experiment.run(small, path=path, progress=False)
    trials.clear()
    table = experiment.run(large, path=path, progress=False)
    assert len(trials) == len(large) - len(small) == 2 * 2 * 8 * 2 - 2 and not set(trials) & {*small}
    same(table, experiment.run(large, progress=False))
    trials.clear()
    same(experiment.run(large, path=path, progress=False), table)
    more["tolerances"]["usual"] = other.tolerances
    with pytest.raises(cal.InvalidValue, match=r"vary\['tolerances'\]\['usual'\].slack is 0.04 there and 0.05 here"):
        experiment.run(grid(seeds=0, options=other, vary=more), path=path, progress=False)
    assert trials == []


LAWS = """
class Base:
    def force(self, given):
        return GAIN * given.way
class Law(Base):
    def __init__(self, scale=1.0):
        self.scale = scale
def law(given):
    return GAIN * given.way
"""


def test_a_function_without_source_is_known_by_itself_only(tmp_path):
    one, other = (eval("lambda given: given.way") for _ in range(2))
    for law in (one, one):
        experiment.run(grid(seeds=0, law={"mine": law}), path=tmp_path / "rows.csv", progress=False)
    with pytest.raises(cal.InvalidValue, match=r"laws\['mine'\] is <lambda> "):
        experiment.run(grid(seeds=0, law={"mine": other}), path=tmp_path / "rows.csv", progress=False)


@pytest.mark.parametrize("name", ["law", "Law", "Law()", "partial(Law, 1.0)", "partial(Law, scale=1.0)"])
def test_a_law_whose_source_or_argument_has_changed_is_another_experiment(name, tmp_path):
    def run(gain, name):  # linecache, which inspect reads, notices a file of another length
        module, made = tmp_path / "laws.py", {"__name__": "laws", "partial": functools.partial}
        module.write_text(LAWS.replace("GAIN", gain), encoding="utf-8")
        linecache.checkcache(str(module))
        exec(compile(module.read_text(encoding="utf-8"), str(module), "exec"), made)
        monkeypatch.setitem(sys.modules, "laws", types.SimpleNamespace(__file__=str(module), **made))
        experiment.run(grid(seeds=0, law={"mine": eval(name, made)}), path=tmp_path / "rows.csv", progress=False)

    with pytest.MonkeyPatch.context() as monkeypatch:
        for _ in range(2):
            run("1.0", name)
        for gain, other in {("3.50", name), ("1.0", name.replace("1.0", "2.0"))} - {("1.0", name)}:
            with pytest.raises(cal.InvalidValue, match=r"laws\['mine'\] is (law|Law) "):
                run(gain, other)


@pytest.mark.parametrize("text", ["mine", "a,b\n1,2\n", "# calligraphy.experiment.run: {\n", b"\xff\x00\n"])
def test_any_other_file_is_refused_and_left_as_it_is(text, tmp_path):
    path = tmp_path / "rows.csv"
    before = text if isinstance(text, bytes) else text.encode()
    path.write_bytes(before)
    with pytest.raises(cal.InvalidValue, match="rows.csv: is not a file of experiment.run"):
        experiment.run(grid(), path=path, progress=False)
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    "old, new, what",
    [(",force,", ",force,force,", f"{COLUMNS + 1} values, expected {COLUMNS}"), ("1000.0", "fast", "'fast'"), ("mode", "mood", "columns")],
)
def test_a_damaged_file_is_refused_and_left_as_it_is(old, new, what, tmp_path):
    path = tmp_path / "rows.csv"
    experiment.run(grid(seeds=1, characters="一", modes=["force", "vision"]), path=path, progress=False)
    first, _, rest = path.read_bytes().partition(b"\n")
    path.write_bytes(first + b"\n" + rest.replace(old.encode(), new.encode(), 1))
    before = path.read_bytes()
    with pytest.raises(cal.FormatError, match=f"rows.csv: .*{what}"):
        experiment.run(grid(seeds=1, characters="一"), path=path, progress=False)
    assert path.read_bytes() == before


def test_a_path_that_cannot_be_a_file_runs_nothing(trials, tmp_path):
    with pytest.raises(cal.FileError, match="rows.csv: cannot be written: No such file or directory"):
        experiment.run(grid(), path=tmp_path / "nowhere" / "rows.csv", progress=False)
    (tmp_path / "rows.csv").mkdir()
    with pytest.raises(cal.FileError, match="rows.csv: cannot be read: Is a directory"):
        experiment.run(grid(), path=tmp_path / "rows.csv", progress=False)
    with pytest.raises(cal.InvalidValue, match="path: expected .csv"):
        experiment.run(grid(), path=tmp_path / "rows.parquet", progress=False)
    assert trials == []


def test_a_full_disk_ends_the_run_with_what_is_finished(expected, tmp_path, monkeypatch):
    """Half of a line reaches the file; nothing is written below it."""
    path, appended = tmp_path / "rows.csv", experiment._File.append

    def full(self, rows):
        if len(self.rows) == 4 and not self.torn:
            self.torn = True
            with experiment._writing(self.path), open(self.path, "a", encoding="utf-8") as file:
                file.write("一,nov")
                raise OSError(28, "")
        appended(self, rows)

    monkeypatch.setattr(experiment._File, "append", full)
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        with pytest.raises(cal.FileError, match="rows.csv: cannot be written: No space left") as failed:
            experiment.run(grid(), pool, chunk=2, path=path, progress=False)
    assert len(failed.value.table) >= 4 and path.read_text(encoding="utf-8").endswith("\n一,nov")
    monkeypatch.undo()
    same(experiment.run(grid(), path=path, progress=False), expected)


def test_trials_lost_leave_the_others(expected, tmp_path):
    class Some(Failing):
        def submit(self, function, grid, part):
            self.attempts = 99 if part[0].character == "人" else 0
            return super().submit(function, grid, part)

    path = tmp_path / "rows.csv"
    with pytest.raises(experiment.TrialsLost) as lost:
        experiment.run(grid(), Some(0), chunk=2, retries=1, path=path, progress=False)
    assert columns(lost.value.table) == head(expected, 4)
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        same(experiment.run(grid(), pool, chunk=1, path=path, progress=False), expected)


def test_chunks_that_finished_before_ctrl_c_are_kept(expected, tmp_path):
    """All have finished when the first is taken from the executor."""

    class Pressed(concurrent.futures.Executor):
        def submit(self, function, *arguments):
            future = concurrent.futures.Future()
            future.set_result(function(*arguments))
            return future

    def pressed(*_):
        raise KeyboardInterrupt

    path, bar = tmp_path / "rows.csv", experiment._Bar
    patch = pytest.MonkeyPatch()
    patch.setattr(bar, "add", lambda self, count: patch.undo() or pressed())
    with pytest.raises(KeyboardInterrupt) as interrupted:
        experiment.run(grid(), Pressed(), chunk=2, path=path, progress=False)
    same(interrupted.value.table, expected)
    same(experiment.run(grid(), path=path, progress=False), expected)


def test_what_a_row_depends_on_is_all_of_the_grid(tmp_path):
    """Every field of every struct, so that a new one cannot be forgotten."""
    path = tmp_path / "rows.csv"
    experiment.run(grid(seeds=0), path=path, progress=False)
    basis = json.loads(path.read_text(encoding="utf-8").partition("\n")[0].partition(": ")[2])
    structs = {"options": grid().options, "devices": grid().device, "writers": cal.WriterSkill()}
    for axis, struct in structs.items():
        name = f"{axis}['{'novice' if axis == 'writers' else 'desktop'}']"
        for field in struct.fields:
            assert any(key == f"{name}.{field}" or key.startswith(f"{name}.{field}.") for key in basis), field
    assert basis["options['desktop'].nearest.method"] == repr(grid().options.nearest.method)
    other = copy.deepcopy(grid().options)
    other.nearest.samples += 1
    with pytest.raises(cal.InvalidValue, match=r"options\['desktop'\].nearest.samples is "):
        experiment.run(grid(seeds=0, options=other), path=path, progress=False)
    path.write_text(path.read_text(encoding="utf-8").replace(".nearest.samples", ".gone"), encoding="utf-8")
    with pytest.raises(cal.InvalidValue, match="gone is .* there and None here"):
        experiment.run(grid(seeds=0), path=path, progress=False)


PROGRAM = """
import sys
from calligraphy import experiment
experiment.run(experiment.Grid("一人永", seeds=50), path=sys.argv[1], progress=False)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="this system has no SIGKILL")
def test_a_run_killed_at_any_time_goes_on(trials, tmp_path):
    path = tmp_path / "rows.csv"
    mine = experiment.Grid("一人永", seeds=50)
    finished = 0
    for _ in range(3):
        program = subprocess.Popen([sys.executable, "-c", PROGRAM, str(path)])
        while program.poll() is None and (not path.exists() or path.read_bytes().count(b"\n") < finished + 12):
            time.sleep(0.01)
        program.send_signal(signal.SIGKILL)
        program.wait()
        finished = path.read_bytes().count(b"\n") - 2
    assert 30 <= finished < len(mine) and os.listdir(tmp_path) == ["rows.csv"]
    trials.clear()
    few = [each for each in mine][finished : finished + 3]
    with pytest.MonkeyPatch.context() as patch:
        interrupt(patch, 3)
        with pytest.raises(KeyboardInterrupt) as pressed:
            experiment.run(mine, path=path, progress=False)
    assert trials == few
    row = finished // 2
    found = {name: values[row] for name, values in columns(pressed.value.table).items()}
    again = experiment.trial(mine, [each for each in mine][row])
    assert found == {name: comparable(value) for name, value in again.items()}
