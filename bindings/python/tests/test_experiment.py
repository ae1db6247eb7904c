"""Experiments: the table does not depend on the executor or the order of trials, and no trial is lost."""

import concurrent.futures
import concurrent.futures.process
import copy
import itertools
import multiprocessing
import os
import pickle
import random
import signal
import sys

import numpy as np
import pytest

import calligraphy as cal
from calligraphy import experiment


def grid(seeds=2, **axes):
    return experiment.Grid("一人", seeds=seeds, **axes)


def columns(table):
    names = table.dtype.names if isinstance(table, np.ndarray) else table.columns
    return {name: [comparable(value) for value in np.asarray(table[name]).tolist()] for name in names}


def comparable(value):
    """None for NaN, what was not measured, which equals nothing."""
    return None if value != value else value


class Own:
    """The linear law, in Python."""

    def force(self, given):
        return given.share * given.stiffness * given.way


class Forgetful(Own):
    """Is weaker with every stroke that it remembers."""

    strokes = 0

    def begin(self, stroke):
        self.strokes += 1

    def force(self, given):
        return super().force(given) / self.strokes


def broken(given):
    raise LookupError("of my own")


@pytest.fixture(scope="module")
def expected():
    return columns(experiment.run(grid(), progress=False))


class Shuffling(concurrent.futures.Executor):
    """Runs all work in reverse order, once everything has been submitted."""

    def __init__(self):
        self.waiting = []

    def submit(self, function, *arguments, **keywords):
        future = concurrent.futures.Future()
        self.waiting.append((future, function, arguments, keywords))
        if len(self.waiting) == 8:
            random.Random(1).shuffle(self.waiting)
            for task, call, args, kwargs in self.waiting:
                task.set_result(call(*args, **kwargs))
        return future


class Failing(concurrent.futures.Executor):
    """Fails the first attempts of every chunk, as if its worker had died."""

    def __init__(self, attempts):
        self.attempts = attempts
        self.seen = {}

    def submit(self, function, grid, part):
        future = concurrent.futures.Future()
        self.seen[tuple(part)] = self.seen.get(tuple(part), 0) + 1
        if self.seen[tuple(part)] <= self.attempts:
            future.set_exception(ConnectionError("the worker is gone"))
        else:
            future.set_result(function(grid, part))
        return future


def test_the_table_has_one_row_per_condition_in_grid_order(expected):
    rows = list(zip(*(expected[name] for name in experiment.Condition._fields[:-1])))
    assert rows == [c[:-1] for c in experiment.conditions(grid())]
    assert len(rows) == len(grid()) == 2 * 2 * 2
    assert all(error > 0 for error in expected["rms_error"])


def test_a_row_equals_that_of_a_single_trial(expected):
    condition = experiment.conditions(grid())[3]
    row = experiment.trial(grid(), condition)
    assert {name: values[3] for name, values in expected.items()} == {n: comparable(v) for n, v in row.items()}


def test_the_order_of_execution_does_not_matter(expected):
    assert columns(experiment.run(grid(), Shuffling(), chunk=1, progress=False)) == expected


def test_threads_give_the_same_table(expected):
    with concurrent.futures.ThreadPoolExecutor(3) as pool:
        assert columns(experiment.run(grid(), pool, chunk=3, progress=False)) == expected


def test_processes_give_the_same_table(expected):
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        assert columns(experiment.run(grid(), pool, chunk=2, progress=False)) == expected


def test_a_chunk_whose_worker_dies_is_submitted_again(expected):
    executor = Failing(attempts=3)
    assert columns(experiment.run(grid(), executor, chunk=2, retries=3, progress=False)) == expected
    assert set(executor.seen.values()) == {4}


def test_a_chunk_that_fails_too_often_is_named():
    with pytest.raises(experiment.TrialsLost, match="character='一'.*seed=1.*and 1 more.*the worker is gone"):
        experiment.run(grid(), Failing(attempts=99), chunk=2, retries=2, progress=False)


def test_an_invalid_option_is_not_retried():
    with pytest.raises(cal.InvalidValue, match="rate"):
        experiment.run(grid(rate=[1e-3]), _Here(), progress=False)


class _Cancelling(concurrent.futures.Executor):
    """Accepts work and cancels what has not started, like a pool that is shut down."""

    def __init__(self, shut):
        self.shut, self.count = shut, 0

    def submit(self, function, *arguments):
        self.count += 1
        if self.shut and self.count > 4:  # all four chunks have been submitted
            raise RuntimeError("cannot schedule new futures after shutdown")
        future = concurrent.futures.Future()
        if self.shut and self.count == 2:
            future.set_result(function(*arguments))
        else:
            future.cancel()
        return future


def test_work_cancelled_by_the_executor_is_completed_or_named(expected):
    assert columns(experiment.run(grid(), _Cancelling(shut=True), chunk=2, progress=False)) == expected
    with pytest.raises(experiment.TrialsLost, match="CancelledError"):
        experiment.run(grid(), _Cancelling(shut=False), chunk=2, retries=2, progress=False)


class _Here(concurrent.futures.Executor):
    def __init__(self):
        self.count = 0

    def submit(self, function, *arguments):
        self.count += 1
        assert self.count == 1
        future = concurrent.futures.Future()
        try:
            future.set_result(function(*arguments))
        except BaseException as error:
            future.set_exception(error)
        return future


def _die_once(path, real, *arguments):
    if not os.path.exists(path):
        open(path, "w").close()
        os.kill(os.getpid(), signal.SIGKILL)
    return real(*arguments)


class _Deadly:
    """An executor whose first worker is killed while it works."""

    def __init__(self, executor, path):
        self.executor, self.path = executor, path

    def submit(self, function, *arguments):
        return self.executor.submit(_die_once, self.path, function, *arguments)


@pytest.mark.skipif(sys.platform == "win32", reason="this system has no SIGKILL")
def test_a_broken_process_pool_loses_nothing(expected, tmp_path):
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        deadly = _Deadly(pool, str(tmp_path / "died"))
        assert columns(experiment.run(grid(), deadly, chunk=2, progress=False)) == expected
    assert (tmp_path / "died").exists()


def test_dask_distributed_with_a_worker_killed_midway_loses_nothing(tmp_path):
    distributed = pytest.importorskip("distributed")
    import dask

    # Limits how long the others wait for a worker that dies while transferring a result.
    dask.config.set({"distributed.comm.timeouts.connect": "10s"})
    large = grid(seeds=5, stiffness=[300.0, 600.0])
    expected = columns(experiment.run(large, progress=False))
    killed = []
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, local_directory=str(tmp_path)
    ) as cluster, distributed.Client(cluster) as client:
        executor = client.get_executor(pure=False)
        done = []

        class Watching:
            """Kills a worker, once, after the first chunks have completed."""

            def submit(self, function, *arguments):
                future = executor.submit(function, *arguments)
                future.add_done_callback(self.count)
                return future

            def count(self, _):
                done.append(1)
                if len(done) == 3 and not killed:
                    pid = next(iter(cluster.workers.values())).pid
                    killed.append(pid)
                    os.kill(pid, signal.SIGKILL)

        table = experiment.run(large, Watching(), chunk=1, progress=False)
    assert killed
    assert columns(table) == expected
    assert len(expected["seed"]) == len(large) == 40


def test_methods_and_rates_are_applied():
    table = columns(experiment.run(grid(seeds=1, rate=[500.0, 1000.0], method=["exact", "sampled"]), progress=False))
    assert set(table["rate"]) == {500.0, 1000.0} and set(table["method"]) == {"exact", "sampled"}
    times = {rate: [t for t, r in zip(table["simulated_time"], table["rate"]) if r == rate] for rate in (500.0, 1000.0)}
    assert all(abs(t * 500.0 - round(t * 500.0)) < 1e-6 for t in times[500.0])


def test_a_grid_accepts_your_own_writer():
    still = cal.WriterSkill.novice()
    still.tremor = 0.0
    table = columns(experiment.run(grid(writers={"still": still, "novice": cal.WriterSkill.novice()}), progress=False))
    assert table["writer"][0] == "still" and "novice" in table["writer"]


@pytest.mark.parametrize(
    "axes, name",
    [
        ({"modes": ["blind"]}, "modes"),
        ({"method": ["newton"]}, "method"),
        ({"writers": ["master"]}, "writers"),
        ({"rate": [0.0]}, "rate"),
        ({"tolerance": [float("nan")]}, "tolerance"),
        ({"stiffness": ["600"]}, "stiffness: expected a positive number, got '600'"),
        ({"seeds": [1, 1.7]}, "seeds: expected an integer, got 1.7"),
        ({"seeds": 2.0}, "seeds: expected an integer, got 2.0"),
        ({"seeds": "12"}, "seeds: expected an integer, got '1'"),
        ({"seeds": -2}, "seeds: -2 is not in"),
        ({"seeds": [-1]}, "seeds: -1 is not in"),
        ({"seeds": [2**64]}, "seeds: 18446744073709551616 is not in"),
        ({"seeds": [3, 1, 3]}, "seeds: 3 occurs twice"),
        ({"seeds": None}, "seeds: expected an integer, got None"),
        ({"stiffness": 600.0}, "stiffness: expected a list, got 600.0"),
        ({"stiffness": [None]}, "stiffness: expected a positive number, got None"),
        ({"stiffness": [[600.0]]}, "stiffness: expected a positive number, got .*600"),
        ({"stiffness": [600, 300.0, 600.0]}, "stiffness: 600.0 occurs twice"),
        ({"rate": [1000 + 0j]}, "rate: expected a positive number"),
        ({"stiffness": None}, "stiffness: expected a list, got None"),
        ({"modes": "force"}, "modes: expected a list, got 'force'"),
        ({"source": 3}, "source: expected a CharacterList, got 3"),
        ({"page": []}, r"page: expected one of upright, desk, got \[\]"),
        ({"modes": [["force"]]}, "modes: expected one of vision, force"),
        ({"modes": ["force", cal.FeedbackMode.force]}, "modes: 'force' occurs twice"),
        ({"modes": [cal.NearestPointMethod.exact]}, "modes: expected one of"),
        ({"writers": "novice"}, "writers: expected a list, got 'novice'"),
        ({"writers": {"mine": "novice"}}, "writers: expected a WriterSkill, got 'novice'"),
        ({"writers": {1: cal.WriterSkill.novice()}}, "writers: expected a str, got 1"),
        ({"device": 7}, "device: expected a Capabilities, got 7"),
        ({"device": []}, "device: expected at least one"),
        ({"device": ["omni", "omni"]}, "device: 'omni' occurs twice"),
        ({"device": ["omni", "pen"]}, 'device profile "pen" does not exist; available: omni'),
        ({"device": {"mine": "omni"}}, "device: expected a Capabilities, got 'omni'"),
        ({"law": "linear"}, "law: expected a list, got 'linear'"),
        ({"law": ["cubic"]}, "law: expected one of linear, saturating, wang2006, got 'cubic'"),
        ({"law": [Own]}, "law: expected a str, got "),
        ({"law": {"mine": 3}}, "law: expected linear, saturating, wang2006, a function, or a class .*, got 3"),
        ({"vary": ["guidance.damping"]}, r"vary: expected a dict, got \['guidance.damping'\]"),
        ({"vary": {"damping": [1.0]}}, "vary: damping: RendererOptions has no field 'damping'; it has servo_rate"),
        ({"vary": {"energy.bugdet": [1.0]}}, "EnergyOptions has no field 'bugdet'; it has budget, max_gap$"),
        ({"vary": {"energy.budget.joule": [1.0]}}, "float has no field 'joule'; it has none"),
        ({"vary": {"energy.budget": ["1"]}}, "vary: energy.budget: expected a number, got '1'"),
        ({"vary": {"energy.budget": [1, 1.0]}}, "vary: energy.budget: 1.0 occurs twice"),
        ({"vary": {"energy.budget": [float("nan")]}}, "vary: energy.budget: expected a number, got nan"),
        ({"vary": {"energy.budget": 1.0}}, "vary: energy.budget: expected a list, got 1.0"),
        ({"vary": {"rules": ["old"]}}, "vary: rules: expected one of revised, wang2006, got 'old'"),
        ({"vary": {"energy": [1.0]}}, "vary: energy: vary one of its fields: budget, max_gap"),
        ({"vary": {"guidance": {"usual": cal.GuidanceOptions()}}}, "guidance: vary one of its fields: stiffness, "),
        ({"vary": {"nearest.method": ["exact"]}}, "vary: nearest.method: is the axis 'method'"),
        ({"vary": {"energy.budget": [1], "energy": {"no": cal.EnergyOptions()}}}, "energy: energy.budget is varied"),
        ({"options": "default"}, "options: expected a RendererOptions, got 'default'"),
        ({"character_timeout": -1.0}, "character_timeout: expected a positive number, got -1.0"),
    ],
)
def test_invalid_axes_of_a_grid_are_rejected_naming_the_axis(axes, name):
    with pytest.raises(cal.InvalidValue, match=name):
        grid(**axes)


@pytest.mark.parametrize(
    "characters, what",
    [
        ("龘", "'龘' is not in the set"),
        ("永永", "'永' occurs twice"),
        ([7], "expected a str, got 7"),
        (7, "expected a list, got 7"),
    ],
)
def test_invalid_characters_of_a_grid_are_rejected(characters, what):
    with pytest.raises(cal.InvalidValue, match="characters: " + what):
        experiment.Grid(characters)


def test_enumeration_members_are_accepted_as_names():
    members = grid(modes=[cal.FeedbackMode.force], method=[cal.NearestPointMethod.exact])
    names = grid(modes=["force"], method=["exact"])
    assert experiment.conditions(members) == experiment.conditions(names)


def test_integers_of_any_type_are_accepted_as_seeds():
    assert experiment.Grid("一", seeds=np.int64(3)).seeds == [1, 2, 3] and experiment.Grid("一", seeds=0).seeds == []
    assert experiment.Grid("一", seeds=np.arange(4, 6, dtype=np.uint8)).seeds == [4, 5]
    assert experiment.Grid("一", seeds=(seed for seed in (0, 2**64 - 1))).seeds == [0, 2**64 - 1]
    assert experiment.Grid("一", stiffness=(value for value in (1, 2.5))).stiffness == [1.0, 2.5]
    for wrong in ({"chunk": 1.5}, {"chunk": 0}, {"retries": 0.5}, {"retries": -1}):
        with pytest.raises(cal.InvalidValue, match=next(iter(wrong))):
            experiment.run(grid(), progress=False, **wrong)


def dtypes(table):
    """The dtypes of the columns; all text dtypes count as equal."""
    names = table.dtype.names if isinstance(table, np.ndarray) else table.columns
    kinds = {name: table[name].dtype for name in names}
    return {name: "text" if getattr(kind, "kind", "O") in "OUT" else kind for name, kind in kinds.items()}


@pytest.mark.parametrize("with_pandas", [True, False])
def test_an_empty_grid_gives_an_empty_table_with_the_same_columns(with_pandas, monkeypatch, tmp_path):
    if with_pandas:
        pytest.importorskip("pandas")
    else:
        monkeypatch.setitem(sys.modules, "pandas", None)
    table = experiment.run(experiment.Grid(""), progress=False)
    full = experiment.run(experiment.Grid("一", modes=["force"]), progress=False)
    assert len(table) == 0 and len(full) == 1
    assert dtypes(table) == dtypes(full) and list(dtypes(table)) == list(dtypes(full))
    for place in ("nowhere/none.csv", "nowhere/none.parquet"):
        with pytest.raises(cal.FileError, match="nowhere/none[.][a-z]*: cannot be written: No such file or directory$"):
            experiment.write(table, tmp_path / place)
    experiment.write(table, tmp_path / "none.csv")
    experiment.write(full, tmp_path / "one.csv")
    header = (tmp_path / "none.csv").read_text(encoding="utf-8").splitlines()
    assert header == (tmp_path / "one.csv").read_text(encoding="utf-8").splitlines()[:1]
    parquet = pytest.importorskip("pyarrow.parquet")
    experiment.write(table, tmp_path / "none.parquet")
    experiment.write(full, tmp_path / "one.parquet")
    schemas = [parquet.read_schema(tmp_path / name) for name in ("none.parquet", "one.parquet")]
    assert schemas[0].equals(schemas[1])


def test_the_repr_of_a_grid_gives_its_size():
    assert repr(grid(stiffness=[300.0, 600.0])) == (
        "Grid(16 trials: 2 characters x 1 writers x 2 modes x 2 stiffness x 1 rate x 1 method x 1 tolerance x 2 seeds "
        "x 1 devices x 1 laws)"
    )


def test_without_pandas_the_table_is_a_structured_array(expected, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "pandas", None)
    table = experiment.run(grid(), progress=False)
    assert isinstance(table, np.ndarray) and table.dtype.names == tuple(expected)
    assert columns(table) == expected
    experiment.write(table, tmp_path / "table.csv")
    assert len((tmp_path / "table.csv").read_text(encoding="utf-8").splitlines()) == 9


def test_tables_are_written_completely(expected, tmp_path):
    pandas = pytest.importorskip("pandas")
    table = experiment.run(grid(), progress=False)
    experiment.write(table, tmp_path / "table.csv")
    assert columns(pandas.read_csv(tmp_path / "table.csv")) == expected
    pytest.importorskip("pyarrow")
    experiment.write(table, tmp_path / "table.parquet")
    assert columns(pandas.read_parquet(tmp_path / "table.parquet")) == expected
    with pytest.raises(cal.InvalidValue, match=".csv or .parquet"):
        experiment.write(table, tmp_path / "table.xls")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["table.csv", "table.parquet"]


def test_a_progress_bar_shows_every_trial(monkeypatch):
    tqdm = pytest.importorskip("tqdm.auto")
    seen = []

    class Bar:
        def __init__(self, total, **_):
            seen.append(("total", total))

        def update(self, count):
            seen.append(("done", count))

        def close(self):
            seen.append(("closed", 0))

    monkeypatch.setattr(tqdm, "tqdm", Bar)
    experiment.run(grid(), chunk=3)
    assert seen[0] == ("total", 8) and seen[-1][0] == "closed"
    assert sum(count for what, count in seen if what == "done") == 8


def test_a_grid_survives_pickling():
    again = pickle.loads(pickle.dumps(grid()))
    assert experiment.conditions(again) == experiment.conditions(grid())


def by_hand(condition, device, renderer):
    """The trial of a condition, computed step by step."""
    renderer = copy.deepcopy(renderer)
    renderer.servo_rate = condition.rate
    renderer.paper.stiffness = renderer.guidance.stiffness = condition.stiffness
    renderer.stiffness_check = cal.StiffnessCheck.clip
    clipped = copy.deepcopy(renderer)
    cal.clip_stiffness(clipped, device)
    renderer.nearest = cal.NearestPointOptions(
        method=cal.NearestPointMethod.__members__[condition.method], tolerance=condition.tolerance
    )
    options = cal.SessionOptions(
        mode=cal.FeedbackMode.__members__[condition.mode], device=device, renderer=renderer, seed=condition.seed,
        skill=cal.WriterSkill.novice() if condition.writer == "novice" else cal.WriterSkill.skilled(),
    )  # fmt: skip
    width, height, _ = device.workspace
    page = cal.lay_out([cal.built_in_characters()[condition.character]], cal.PageLayout(width=width, height=height))[0]
    recording = cal.write_page(page, options)
    score = cal.score_page(page, recording)[0]
    others = ("character", "match", "motion", "pen_downs", "strokes")
    figures = {name: getattr(score, name) for name in score.fields if name not in others}
    motion = {name: getattr(score.motion, name) for name in score.motion.fields}
    return {
        **dict(zip(condition._fields[:-1], condition)), **figures, **motion, "order_mistakes": score.order_mistakes(),
        "guidance_stiffness": clipped.guidance.stiffness, "paper_stiffness": clipped.paper.stiffness,
        "direction_mistakes": score.direction_mistakes(), "extra_pen_downs": score.match.count("extra"),
        "missing_strokes": score.match.count("missing"), "simulated_time": len(recording) / recording.rate,
    }  # fmt: skip


def test_a_trial_is_the_session_of_its_condition():
    """Varies one axis at a time; each variation changes the trial as expected."""
    usual = {"writers": ["novice"], "modes": ["force"], "seeds": [1], "method": ["wang2006"], "rate": [1000.0]}
    others = [
        {}, {"seeds": [2]}, {"modes": ["vision"]}, {"writers": ["skilled"]}, {"stiffness": [200.0]},
        {"stiffness": [1e7]}, {"rate": [500.0]}, {"method": ["exact"]}, {"tolerance": [0.3]}, {"device": "omni"},
        {"options": cal.RendererOptions.everything(cal.device_profile("desktop"))},
    ]  # fmt: skip
    seen = []
    for other in others:
        one = experiment.Grid("永", **{**usual, **other})
        (condition,) = experiment.conditions(one)
        row = experiment.trial(one, condition)
        profile = cal.device_profile(other.get("device", "desktop"))
        renderer = other.get("options", cal.RendererOptions.for_device(profile))
        assert repr(sorted(row.items())) == repr(sorted(by_hand(condition, profile, renderer).items()))
        figures = {name: value for name, value in row.items() if name not in experiment.Condition._fields}
        assert figures not in seen
        seen.append(figures)
    assert all(row["simulated_time"] < 60 for row in seen)


def test_a_trial_does_not_modify_the_grid():
    one = grid(stiffness=[200.0], rate=[500.0])
    before = copy.deepcopy(one.options)
    experiment.run(one, progress=False)
    assert one.options == before


def test_conditions_are_all_combinations_with_the_last_axis_fastest():
    large = experiment.Grid(
        "人一", writers=["skilled", "novice"], modes=["force", "vision"], stiffness=[2.0, 1.0], rate=[30.0, 40.0, 50.0],
        method=["exact", "sampled"], tolerance=[0.1, 0.2], seeds=[9, 4],
    )  # fmt: skip
    every = experiment.conditions(large)
    axes = ["人一", large.writers, large.modes, [2.0, 1.0], [30.0, 40.0, 50.0], large.method, [0.1, 0.2], [9, 4]]
    assert [c[:8] for c in every] == list(itertools.product(*axes)) and len(every) == len(large) == len(set(every))
    assert every[0] == experiment.Condition("人", "skilled", "force", 2.0, 30.0, "exact", 0.1, 9, "desktop", "linear")
    assert [c.seed for c in experiment.Grid("人", seeds=3, modes=["force"])] == [1, 2, 3]


def test_characters_come_from_the_given_source():
    mine = cal.CharacterList([cal.with_quartic_curves(cal.built_in_characters()["人"])])
    for source in (mine, cal.CharacterSet(mine)):
        assert experiment.Grid("人", source=source).characters["人"].curve_degree == 4
        with pytest.raises(cal.InvalidValue, match="'一' is not in the set"):
            experiment.Grid("一", source=source)


@pytest.mark.parametrize("name", ["stiffness", "rate", "tolerance"])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf")])
def test_invalid_numbers_are_rejected_by_name(name, value):
    with pytest.raises(cal.InvalidValue, match=f"{name}: expected a positive number"):
        grid(**{name: [1.0, value]})


def test_chunks_of_any_size_contain_every_trial(expected):
    for chunk in (1, 3, 8, 1000):
        assert columns(experiment.run(grid(), chunk=chunk, progress=False)) == expected
    for chunk in (0, -1):
        with pytest.raises(cal.InvalidValue, match=r"chunk: (0|-1) is not in \[1, inf\]"):
            experiment.run(grid(), chunk=chunk, progress=False)


def test_the_number_of_retries_is_as_requested(expected):
    assert columns(experiment.run(grid(), Failing(attempts=2), chunk=4, retries=2, progress=False)) == expected
    executor = Failing(attempts=99)
    with pytest.raises(experiment.TrialsLost, match="seed=1.*ConnectionError") as lost:
        experiment.run(grid(), executor, chunk=8, retries=2, progress=False)
    assert set(executor.seen.values()) == {3} and isinstance(lost.value.__cause__, ConnectionError)


class Cancelling(concurrent.futures.Executor):
    """Cancels the first attempt of every chunk, and never runs what comes after a failure."""

    def __init__(self):
        self.seen, self.given = set(), []

    def submit(self, function, grid, part):
        future = concurrent.futures.Future()
        self.given.append(future)
        if tuple(part) not in self.seen:
            self.seen.add(tuple(part))
            future.cancel()
            future.set_running_or_notify_cancel()
        else:
            future.set_result(function(grid, part))
        return future


def test_a_cancelled_chunk_is_submitted_again(expected):
    assert columns(experiment.run(grid(), Cancelling(), chunk=2, progress=False)) == expected


class Broken(concurrent.futures.Executor):
    """A pool that breaks immediately or on resubmission."""

    def __init__(self, good, error):
        self.good, self.error = good, error

    def submit(self, function, grid, part):
        if self.good == 0:
            raise self.error
        self.good -= 1
        future = concurrent.futures.Future()
        future.set_exception(ConnectionError("gone"))
        return future


@pytest.mark.parametrize("good", [0, 1, 4])
def test_no_trial_is_lost_when_the_pool_accepts_no_more_work(expected, good):
    broken = Broken(good, concurrent.futures.process.BrokenProcessPool("broken"))
    assert columns(experiment.run(grid(), broken, chunk=2, progress=False)) == expected


def test_pending_work_is_cancelled_when_a_run_ends_early():
    class Half(concurrent.futures.Executor):
        def __init__(self):
            self.given = []

        def submit(self, function, *arguments):
            future = concurrent.futures.Future()
            if not self.given:
                future.set_exception(cal.InvalidValue("no such thing"))
            self.given.append(future)
            return future

    half = Half()
    with pytest.raises(cal.InvalidValue, match="no such thing"):
        experiment.run(grid(), half, chunk=2, progress=False)
    assert len(half.given) == 4 and all(future.cancelled() for future in half.given[1:])


def test_a_failed_write_leaves_no_file_behind(tmp_path, monkeypatch):
    table = experiment.run(grid(seeds=1, modes=["force"]), progress=False)
    (tmp_path / "table.csv").write_text("before", encoding="utf-8")

    def broken(*_):
        raise OSError("disk full")

    monkeypatch.setattr(os, "replace", broken)
    with pytest.raises(OSError, match="disk full"):
        experiment.write(table, tmp_path / "table.csv")
    assert [p.name for p in tmp_path.iterdir()] == ["table.csv"]
    assert (tmp_path / "table.csv").read_text(encoding="utf-8") == "before"


def test_there_is_no_progress_bar_if_disabled(monkeypatch):
    tqdm = pytest.importorskip("tqdm.auto")
    monkeypatch.setattr(tqdm, "tqdm", None)
    experiment.run(grid(seeds=1, modes=["force"]), progress=False)


def test_rows_lost_by_an_executor_are_detected():
    class Losing(concurrent.futures.Executor):
        def submit(self, function, *arguments):
            future = concurrent.futures.Future()
            future.set_result(function(*arguments)[1:])
            return future

    with pytest.raises(experiment.TrialsLost, match="1 rows for 2 trials"):
        experiment.run(grid(), Losing(), chunk=2, progress=False)


@pytest.mark.parametrize("factor", [1.0, 1.7])
def test_the_table_has_the_effective_stiffness(factor):
    """Bit-identical to the options of a renderer of the same page, without constructing a second one in the trial."""
    drawn = cal.built_in_characters()["人"]
    inputs = [
        cal.StrokeInput(stroke.type.id, stroke.control_points, [factor] * len(stroke.attraction_factors))
        for stroke in drawn.strokes()
    ]
    character = cal.make_character("人", inputs)
    axes = {"modes": ["force"], "stiffness": [600.0, 1e6], "rate": [500.0, 1000.0]}
    grid = experiment.Grid("人", source=cal.CharacterList([character]), **axes)
    table = columns(experiment.run(grid, progress=False))
    assert table["stiffness"] == [600.0, 600.0, 1e6, 1e6]
    able = cal.device_profile("desktop")
    page = cal.lay_out([character], cal.PageLayout(width=able.workspace[0], height=able.workspace[1]))[0]
    for group in ("guidance", "paper"):
        for row, (asked, rate) in enumerate(zip(table["stiffness"], table["rate"])):
            options = cal.RendererOptions.for_device(able)
            options.guidance.stiffness = options.paper.stiffness = asked
            options.servo_rate = rate
            options.stiffness_check = cal.StiffnessCheck.clip
            renderer = cal.HapticRenderer(page.characters, cal.upright_page(page.width, page.height), able, options)
            assert table[f"{group}_stiffness"][row] == getattr(renderer.options, group).stiffness
        assert table[f"{group}_stiffness"][3] < 1e5
    assert table["paper_stiffness"][1] == 600.0 < table["paper_stiffness"][3]


def test_the_rate_is_the_devices_unless_asked_for():
    slow = cal.device_profile("desktop")
    slow.update_rate = 500.0
    assert experiment.Grid("一", device=slow).rate == [500.0]
    assert experiment.Grid("一", device=slow, rate=[2000.0]).rate == [2000.0]


def test_the_rules_of_the_paper_are_tried_with_their_stiffness():
    """Without dampers no stiffness is stable in any hand: clipped, the pen would feel nothing."""
    usual, undamped = cal.RendererOptions.for_device(cal.device_profile("desktop")), cal.RendererOptions.wang2006()
    usual.guidance.damping = usual.paper.damping = 0.0
    for options, effective in ((usual, 0.0), (undamped, 600.0)):
        grid = experiment.Grid("一", modes=["force"], options=options)
        table = columns(experiment.run(grid, progress=False))
        assert (table["guidance_stiffness"], table["paper_stiffness"]) == ([effective], [effective])


def rows(*trials, **others):
    """A table of run() with these (character, seed, mode, RMS error, strokes completed of 5) and usual conditions."""
    usual = {"writer": "novice", "stiffness": 600.0, "rate": 1000.0, "method": "tracked", "tolerance": 1e-9, **others}
    names = ("character", "seed", "mode", "rms_error", "strokes_completed")
    return [{**dict(zip(names, trial)), "stroke_count": 5, **usual} for trial in trials]


def test_a_reduction_is_clustered_by_character_and_seed():
    """By hand: reductions of 0.5 and 0.1 in one draw, 0.2 in a second, 0.6 in a third: mean 0.35, sums of deviations
    -0.1, -0.15 and 0.25; sqrt(3 / 2 * 0.095) / 4 times t(2) = 4.30265."""
    table = experiment.to_table(
        rows(("一", 1, "vision", 2.0, 5), ("一", 1, "force", 1.0, 5))
        + rows(("一", 1, "vision", 2.0, 5), ("一", 1, "force", 1.8, 5), stiffness=300.0)
        + rows(("一", 2, "force", 0.8, 5), ("人", 1, "vision", 4.0, 5), ("一", 2, "vision", 1.0, 5))
        + rows(("人", 1, "force", 1.6, 5), ("人", 2, "vision", 1.0, 4), ("人", 2, "force", 0.1, 5))
    )
    reduced = experiment.reduction(table)
    assert reduced.mean == pytest.approx(0.35)
    assert reduced.half_width == pytest.approx(4.30265 * np.sqrt(1.5 * 0.095) / 4, rel=1e-5)
    assert (reduced.pairs, reduced.draws, reduced.omitted) == (4, 3, 1)


def test_one_draw_has_no_interval_and_no_pair_no_mean():
    pair = rows(("一", 1, "vision", 2.0, 5), ("一", 1, "force", 1.0, 5))
    assert np.isnan(experiment.reduction(experiment.to_table(pair)).half_width)
    unfinished = rows(("一", 1, "vision", 2.0, 5), ("一", 1, "force", 1.0, 4))
    nothing = experiment.reduction(experiment.to_table(unfinished))
    assert np.isnan(nothing.mean) and nothing.omitted == 1


def test_what_was_not_measured_is_left_out_of_a_reduction_and_counted():
    nan = float("nan")
    pairs = rows(("一", 1, "vision", 2.0, 5), ("一", 1, "force", 1.0, 5), ("一", 2, "vision", nan, 0))
    pairs += rows(("一", 2, "force", 1.0, 5), ("一", 3, "vision", 4.0, 3), ("一", 3, "force", 1.0, 5))
    table = experiment.to_table(pairs)
    finished = experiment.reduction(table)
    assert (finished.mean, finished.pairs, finished.omitted) == (0.5, 1, 2)
    measured = experiment.reduction(table, unfinished=True)
    assert (measured.mean, measured.pairs, measured.omitted) == (0.625, 2, 1)
    interval = cal.mean_interval([1.0, nan, 3.0], [1, 2, 3])
    assert (interval.mean, interval.values, interval.draws, interval.missing) == (2.0, 2, 2, 1)


def test_trials_in_which_nothing_was_written_do_not_count_as_the_best():
    """A timeout before any writer touches the paper, and one after they have begun."""
    none, some = (
        [experiment.trial(grid, condition) for condition in grid]
        for grid in (experiment.Grid("永", seeds=3, character_timeout=timeout) for timeout in (0.6, 1.0))
    )
    for row in none:
        assert (row["strokes_written"], row["missing_strokes"], row["coverage"], row["fidelity"]) == (0, 5, 0.0, 0.0)
        assert all(np.isnan(row[name]) for name in ("time", "rms_error", "max_error", "overall_error"))
    for row in some:
        assert (row["strokes_written"], row["missing_strokes"]) == (1, 4)
        assert np.isnan(row["time"]) and 0.0 < row["rms_error"] < row["overall_error"]
    pandas = pytest.importorskip("pandas")
    means = pandas.DataFrame(none + some).groupby("mode").rms_error.agg(["mean", "count"])
    for mode in ("vision", "force"):
        errors = [row["rms_error"] for row in some if row["mode"] == mode]
        assert means["count"][mode] == len(errors) == 3
        assert means["mean"][mode] == pytest.approx(np.mean(errors))


def test_a_table_that_cannot_show_a_reduction_is_refused_by_name():
    table = experiment.to_table(rows(("一", 1, "force", 1.0, 5)))
    with pytest.raises(cal.InvalidValue, match="vision"):
        experiment.reduction(table)
    with pytest.raises(cal.InvalidValue, match="'speed'"):
        experiment.reduction(table, "speed")


def test_mean_interval_needs_a_draw_for_each_value():
    with pytest.raises(cal.InvalidValue, match="draws: expected one for each of 2 values, got 1"):
        cal.mean_interval([1.0, 2.0], [1])


def test_the_reduction_of_an_experiment_is_that_of_its_rows():
    table = experiment.run(experiment.Grid("一人", seeds=3), progress=False)
    every = columns(table)
    errors = dict(zip(zip(every["character"], every["seed"], every["mode"]), every["rms_error"]))
    reduced = [1 - errors[c, s, "force"] / errors[c, s, "vision"] for c in "一人" for s in (1, 2, 3)]
    found = experiment.reduction(table)
    assert found.mean == pytest.approx(np.mean(reduced))
    assert found.half_width == pytest.approx(2.570582 * np.std(reduced, ddof=1) / np.sqrt(6), rel=1e-6)  # t(5)


def test_a_page_on_a_desk_gives_the_same_rows_as_one_upright():
    upright, desk = (
        columns(experiment.run(experiment.Grid("一人", page=page), progress=False)) for page in ("upright", "desk")
    )
    assert upright == desk


def test_the_motion_scale_sets_page_and_stiffness():
    grid = experiment.Grid("一", page="desk", motion_scale=2.0, device="omni")
    assert (grid.layout.width, grid.layout.height) == (0.32, 0.14)
    assert grid.mapping == cal.desk_page(0.32, 0.14, 2.0)
    assert grid.options.guidance.stiffness == 600.0 / 4  # felt K_S^2 times
    row = experiment.trial(grid, experiment.conditions(grid)[0])
    assert row["guidance_stiffness"] == row["paper_stiffness"] == 600.0
    stiff = experiment.Grid("一", page="desk", motion_scale=2.0, device="omni", stiffness=[900.0])
    row = experiment.trial(stiff, experiment.conditions(stiff)[0])
    assert row["guidance_stiffness"] == 700.0  # usable on the device
    for wrong in ({"page": "wall"}, {"motion_scale": 0.0}):
        with pytest.raises(cal.InvalidValue, match=next(iter(wrong))):
            experiment.Grid("一", **wrong)


def test_a_session_takes_a_mapping_and_refuses_a_wrong_one():
    page = cal.lay_out([cal.built_in_characters()["一"]])[0]
    device = cal.device_profile("desktop")
    options = cal.SessionOptions(device=device, renderer=cal.RendererOptions.for_device(device))
    assert options.mapping is None
    upright = cal.write_page(page, options)
    options.mapping = cal.desk_page(page.width, page.height)
    assert options.mapping == cal.desk_page(page.width, page.height)
    assert np.array_equal(cal.write_page(page, options).samples, upright.samples)
    options.mapping = cal.desk_page(page.width, page.height, 0.0)
    with pytest.raises(cal.InvalidValue, match="motion mapping: scale"):
        cal.write_page(page, options)
    live = cal.LiveOptions(mapping=cal.desk_page(page.width, page.height, -1.0))
    with pytest.raises(cal.InvalidValue, match="motion mapping: scale"):
        cal.write_with_device(page, cal.SimulatedDevice(device), live)


def test_devices_laws_and_options_are_axes_that_vary_slowest():
    slow = cal.device_profile("omni")
    slow.update_rate = 500.0
    large = grid(
        device={"slow": slow, "desktop": cal.device_profile("desktop")}, law={"linear": "linear", "mine": Own},
        vary={"guidance.to_start": [False, True], "paper.stiffness": np.array([300.0, 500.0])},
    )  # fmt: skip
    every = experiment.conditions(large)
    assert len(every) == len(large) == len(set(every)) == 2 * 2 * 2 * 2 * 8
    assert [(c.rate, c.device) for c in every[::64]] == [(500.0, "slow"), (1000.0, "desktop")]
    assert [c.law for c in every[:64:32]] == ["linear", "mine"]
    assert every[8].varied == (("guidance.to_start", False), ("paper.stiffness", 500.0))
    assert pickle.loads(pickle.dumps(every)) == every
    assert "x 2 devices x 2 laws x 2 guidance.to_start x 2 paper.stiffness)" in repr(large)
    assert "each device" in large._repr_html_()


def test_a_grid_of_several_devices_and_laws_has_the_rows_of_one_for_each():
    devices = {"small": cal.device_profile("desktop"), "omni": cal.device_profile("omni")}
    devices["small"].workspace, devices["small"].sample_delay = [0.05, 0.05, 0.05], 4
    usual = {"stiffness": [600.0, 1e6], "modes": ["force"], "page": "desk"}
    both = grid(device=devices, law=["linear", "saturating"], **usual)
    rows = list(zip(*columns(experiment.run(both, progress=False)).values()))
    for device, law in itertools.product(devices, ["linear", "saturating"]):
        options = cal.RendererOptions.for_device(devices[device])
        assert both.devices[device].options == options
        options.guidance.force = law
        alone = grid(device={device: devices[device]}, options=options, **usual)
        assert rows[:8] == list(zip(*columns(experiment.run(alone, progress=False)).values()))
        assert rows[0][8:10] == (device, law)
        del rows[:8]
    assert rows == []


def test_an_option_is_set_as_by_hand_and_is_a_column():
    """A number, a truth value, an enumerator and a struct by its name."""
    vary = {
        "guidance.damping": [2, 4.0], "guidance.to_start": [True], "rules": [cal.Rules.revised],
        "tolerances": {"easy": cal.StrokeTolerances.lenient()}, "stiffness_check": ["reject"],
    }  # fmt: skip
    table = columns(experiment.run(grid(vary=vary), progress=False))
    assert [*table][10:16] == [*vary, "guidance_stiffness"]
    assert [table[path][-1] for path in vary] == [4.0, True, "revised", "easy", "reject"]
    rows = list(zip(*(table[name] for name in experiment._COLUMNS)))
    for damping in (2.0, 4.0):
        options = cal.RendererOptions.for_device(cal.device_profile("desktop"))
        options.guidance.damping, options.guidance.to_start = damping, True
        options.tolerances = cal.StrokeTolerances.lenient()
        assert rows[:8] == list(zip(*columns(experiment.run(grid(options=options), progress=False)).values()))
        del rows[:8]


def test_the_paper_may_be_as_stiff_as_asked_apart_from_guidance():
    apart = experiment.Grid("一", modes=["force"], stiffness=[200.0, 400.0], vary={"paper.stiffness": [600.0]})
    table = columns(experiment.run(apart, progress=False))
    assert table["guidance_stiffness"] == [200.0, 400.0] and table["paper_stiffness"] == [600.0, 600.0]


def test_a_value_that_set_up_refuses_ends_the_trials():
    with pytest.raises(cal.InvalidValue, match="energy.max_gap = 1 s") as raised:
        experiment.run(grid(seeds=1, vary={"energy.max_gap": [0.01, 1.0]}), progress=False)
    assert columns(raised.value.table)["energy.max_gap"] == [0.01] * 4


@pytest.mark.parametrize("with_pandas", [True, False])
def test_an_empty_table_has_the_columns_of_its_options(with_pandas, monkeypatch):
    if not with_pandas:
        monkeypatch.setitem(sys.modules, "pandas", None)
    vary = {"nearest.samples": [16], "guidance.to_start": [True], "rules": ["revised"], "energy.budget": [np.inf]}
    empty, full = (experiment.run(grid(seeds=seeds, vary=vary), progress=False) for seeds in (0, 1))
    assert dtypes(empty) == dtypes(full) and list(dtypes(empty)) == list(dtypes(full))


def test_a_law_in_python_gives_the_same_table_in_every_executor():
    mine = grid(modes=["force"], law={"linear": "linear", "mine": Own, "object": Forgetful()})
    here = columns(experiment.run(mine, progress=False))
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        assert columns(experiment.run(mine, pool, chunk=3, progress=False)) == here
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        assert columns(experiment.run(mine, pool, chunk=1, progress=False)) == here
    assert here["law"][::4] == ["linear", "mine", "object"] and mine.laws["object"].strokes == 0
    assert experiment.Grid("一", options=law_of(Own)).laws == {"Own": Own}


def law_of(law):
    return cal.RendererOptions(guidance=cal.GuidanceOptions(force=law))


def test_an_exception_of_a_law_ends_the_trials_with_its_traceback():
    mine = grid(law={"linear": "linear", "broken": broken})
    with pytest.raises(LookupError, match="of my own") as raised:
        experiment.run(mine, progress=False)
    assert raised.traceback[-1].name == "broken" and columns(raised.value.table)["law"] == ["linear"] * 8
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        with pytest.raises(LookupError, match="of my own") as raised:
            experiment.run(mine, pool, progress=False)
    assert "in broken" in str(raised.value.__cause__)


def test_a_law_that_cannot_be_pickled_ends_the_trials():
    mine = grid(law={"mine": eval("lambda given: given.way")})
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        with pytest.raises((pickle.PicklingError, AttributeError), match="lambda"):
            experiment.run(mine, pool, progress=False)


def test_the_pairs_of_a_reduction_share_device_law_and_options():
    """By hand: 0.5 for one of them and 0.1 for another, in one draw."""
    for apart in ("device", "law", "guidance.damping", "tolerances", "rules"):
        table = experiment.to_table(
            rows(("一", 1, "vision", 2.0, 5), ("一", 1, "force", 1.0, 5), **{apart: "one"})
            + rows(("一", 1, "vision", 4.0, 5), ("一", 1, "force", 3.6, 5), **{apart: "other"})
        )
        found = experiment.reduction(table)
        assert (found.mean, found.pairs, found.draws) == (pytest.approx(0.3), 2, 1), apart


def test_a_condition_made_by_hand_is_of_the_first_device_and_law():
    mine = experiment.Grid("一", device=["omni", "desktop"], law=["saturating", "linear"])
    row = experiment.trial(mine, experiment.Condition("一", "novice", "force", 600.0, 1000.0, "tracked", 1e-9, 1))
    assert row == experiment.trial(mine, experiment.conditions(mine)[1]) and row["device"] == "omni"
    assert mine.layout.width == 0.16 and mine.device == cal.device_profile("omni")
