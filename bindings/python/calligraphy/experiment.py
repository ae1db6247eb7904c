"""Closed-loop trials over a grid of conditions: a simulated writer, a simulated device and the renderer.

A trial is deterministic: its row depends only on its condition, not on the order, the process or the machine's load.
"""

from __future__ import annotations

import concurrent.futures
import contextlib
import copy
import csv
import errno
import functools
import hashlib
import inspect
import io
import itertools
import json
import math
import operator
import os
import pathlib
import pickle
import queue
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TypeVar, Union

import numpy as np
import numpy.typing as npt

import calligraphy as cal
from calligraphy._display import html_table

__all__ = [
    "Condition",
    "Grid",
    "Reduction",
    "TrialsLost",
    "conditions",
    "novice_and_skilled",
    "reduction",
    "run",
    "to_table",
    "trial",
    "write",
]

Row = dict[str, Any]
_Value = TypeVar("_Value")


class TrialsLost(RuntimeError):
    """Trials that failed, or whose worker died, more often than `retries` allows."""

    table: Any  #: of the trials that did not

    def __init__(self, *args: object) -> None:  # for inspect.signature()
        super().__init__(*args)


class Condition(NamedTuple):
    """The condition of one trial."""

    character: str
    writer: str  #: name of the writer
    mode: str  #: "vision" or "force"
    stiffness: float  #: guidance and paper stiffness [N/m]
    rate: float  #: servo rate [Hz]
    method: str  #: nearest-point method: "exact", "tracked", "sampled", "wang2006"
    tolerance: float  #: nearest-point tolerance, relative to the element's size
    seed: int
    device: str = ""  #: name of the device; by default the grid's first
    law: str = ""  #: name of the guidance law; by default the grid's first
    varied: tuple[tuple[str, Any], ...] = ()  #: of the options that the grid varies, path and value


class _Setup(NamedTuple):
    """What a device brings with it."""

    device: cal.Capabilities
    options: cal.RendererOptions
    layout: cal.PageLayout
    mapping: cal.MotionMapping
    rate: list[float]


class Grid:
    """The conditions of an experiment: every combination of the lists, in this order, the last one varying fastest,
    for each device, law and combination of varied options, which vary slowest.

    A value may occur only once per list, because a second one would be the same trial. To repeat a trial, use another
    seed.

    characters: looked up in `source`, a CharacterSet or CharacterList; by default the built-in characters.
    writers: names ("novice", "skilled") or a dict from name to WriterSkill.
    stiffness: guidance and paper stiffness as the hand feels them [N/m], clipped by clip_stiffness() to what is usable
    on the device and stable in any hand, unless the stiffness_check of `options` is off; the columns guidance_stiffness
    and paper_stiffness contain the effective values, that of guidance where the attraction factor is 1.
    rate: of the servo [Hz]; by default each device's.
    device: a name or Capabilities, or several: a list of names or a dict from name to Capabilities.
    page: "upright" or on the "desk", filling the device's workspace.
    motion_scale: K_S; the pen on the page moves this many times as far as the hand. Stiffnesses and forces in the table
    are those that the hand feels: on the page they are 1 / K_S^2 and 1 / K_S times as large.
    options: of all devices; by default RendererOptions.for_device(device, motion_scale) of each.
    law: guidance laws, a list of names ("linear", "saturating", "wang2006") or a dict from name to what
    `options.guidance.force` takes, such as a class; by default the law of `options`.
    vary: more axes, a dict from the path of a renderer option, such as "guidance.damping", to a list of its values or a
    dict from name to value; the path is a column with the value or its name. They are set last and as they are, also
    with a motion_scale: "paper.stiffness" sets that of the paper apart from the axis stiffness.
    """

    def __init__(
        self,
        characters: Iterable[str],
        *,
        writers: Union[Sequence[str], Mapping[str, cal.WriterSkill]] = ("novice",),
        modes: Sequence[Union[str, cal.FeedbackMode]] = ("vision", "force"),
        stiffness: Sequence[float] = (600.0,),
        rate: Sequence[float] | None = None,
        method: Sequence[Union[str, cal.NearestPointMethod]] = ("tracked",),
        tolerance: Sequence[float] = (1e-9,),
        seeds: Union[int, Iterable[int]] = 1,
        device: Union[str, cal.Capabilities, Sequence[str], Mapping[str, cal.Capabilities]] = "desktop",
        options: cal.RendererOptions | None = None,
        source: cal.CharacterSet | cal.CharacterList | None = None,
        character_timeout: float = 120.0,
        page: str = "upright",
        motion_scale: float = 1.0,
        law: Union[Sequence[str], Mapping[str, Any], None] = None,
        vary: Mapping[str, Union[Iterable[Any], Mapping[str, Any]]] | None = None,
    ) -> None:
        codes = _axis("characters", characters, _text)
        if source is None:
            source = cal.built_in_characters()
        elif not isinstance(source, cal.CharacterSet):
            source = _one("source", source, cal.CharacterList)
        found = [_character(source, code) for code in codes]
        self.characters = {character.code: character for character in found}
        self.writers = _writers(writers)
        self.modes = _axis("modes", _list("modes", modes), _name_of(cal.FeedbackMode))
        self.stiffness = _axis("stiffness", stiffness, _positive)
        rates = None if rate is None else _axis("rate", rate, _positive)
        self.method = _axis("method", _list("method", method), _name_of(cal.NearestPointMethod))
        self.tolerance = _axis("tolerance", tolerance, _positive)
        if isinstance(seeds, Iterable):
            self.seeds = _axis("seeds", seeds, lambda what, seed: _whole(what, seed, most=2**64 - 1))
        else:
            self.seeds = list(range(1, _whole("seeds", seeds) + 1))
        self.motion_scale = _positive("motion_scale", motion_scale)
        given = None if options is None else _one("options", options, cal.RendererOptions)
        self.character_timeout = _positive("character_timeout", character_timeout)
        if not isinstance(page, str) or page not in _PAGES:
            raise cal.InvalidValue(f"page: expected one of {', '.join(_PAGES)}, got {page!r}")
        self.page = page

        def setup(able: cal.Capabilities) -> _Setup:
            layout = cal.workspace_layout(able, _PAGES[page](0.0, 0.0, self.motion_scale))
            return _Setup(
                able,
                cal.RendererOptions.for_device(able, self.motion_scale) if given is None else given,
                layout,
                _PAGES[page](layout.width, layout.height, self.motion_scale),
                _axis("rate", (able.update_rate,), _positive) if rates is None else rates,
            )

        self.devices = {name: setup(able) for name, able in _devices(device).items()}
        # Those of the first device.
        self.device, self.options, self.layout, self.mapping, self.rate = next(iter(self.devices.values()))
        self.laws = _laws(law, self.options)
        self.vary = _varied({} if vary is None else vary, self.options)
        # The type of each option in a table: that of its values, or of their names.
        kinds = {path: type(next(iter(values), "")) for path, values in self.vary.items()}
        self._columns = {**{name: _COLUMNS[name] for name in _CONDITION}, **kinds, **_COLUMNS}

    def _axes(self) -> dict[str, list[Any]]:
        rates = [setup.rate for setup in self.devices.values()]
        return {
            "characters": list(self.characters),
            "writers": list(self.writers),
            "modes": self.modes,
            "stiffness": self.stiffness,
            "rate": self.rate if all(rate == self.rate for rate in rates) else ["each device's"],
            "method": self.method,
            "tolerance": self.tolerance,
            "seeds": self.seeds,
            "devices": list(self.devices),
            "laws": list(self.laws),
            **{path: list(values) for path, values in self.vary.items()},
        }

    def __repr__(self) -> str:
        lengths = " x ".join(f"{len(values)} {axis}" for axis, values in self._axes().items())
        return f"Grid({len(self)} trials: {lengths})"

    def _repr_html_(self) -> str:
        """What a notebook shows: the axes and their values, the first twenty of each."""
        axes = self._axes().items()
        rows = [(axis, len(values), ", ".join(map(str, values[:20])) + ", ..." * (len(values) > 20)) for axis, values in axes]
        return html_table([*rows, ("trials", len(self), "")], ("axis", "", "values"))

    def __len__(self) -> int:
        return math.prod(map(len, self._axes().values()))

    def __iter__(self) -> Iterator[Condition]:
        varied = [tuple(zip(self.vary, values)) for values in itertools.product(*self.vary.values())]
        for (device, setup), law, options in itertools.product(self.devices.items(), self.laws, varied):
            for values in itertools.product(
                self.characters,
                self.writers,
                self.modes,
                self.stiffness,
                setup.rate,
                self.method,
                self.tolerance,
                self.seeds,
            ):
                yield Condition(*values, device, law, options)


_PAGES = {"upright": cal.upright_page, "desk": cal.desk_page}

#: The columns of a table and their types, those of Condition first; those of the varied options follow these.
_COLUMNS: dict[str, type] = {
    "character": str,
    "writer": str,
    "mode": str,
    "stiffness": float,
    "rate": float,
    "method": str,
    "tolerance": float,
    "seed": int,
    "device": str,
    "law": str,
    "guidance_stiffness": float,
    "paper_stiffness": float,
    "time": float,
    "rms_error": float,
    "max_error": float,
    "overall_error": float,
    "coverage": float,
    "dtw_distance": float,
    "duration": float,
    "time_on_paper": float,
    "time_in_air": float,
    "pen_ups": int,
    "path_length": float,
    "mean_speed": float,
    "peak_speed": float,
    "velocity_peaks": int,
    "smoothness": float,
    "mean_pressure": float,
    "peak_force": float,
    "max_force_step": float,
    "stroke_count": int,
    "strokes_written": int,
    "strokes_completed": int,
    "order_mistakes": int,
    "direction_mistakes": int,
    "extra_pen_downs": int,
    "missing_strokes": int,
    "lost_samples": int,
    "contour": float,
    "external_sequence": float,
    "internal_sequence": float,
    "fidelity": float,
    "simulated_time": float,
}

_CONDITION = Condition._fields[:-1]

#: The options that are axes of their own.
_OWN_AXES = {
    "servo_rate": "rate",
    "nearest.method": "method",
    "nearest.tolerance": "tolerance",
    "guidance.stiffness": "stiffness",
    "guidance.force": "law",
}

#: The columns that count remarks of cal.match_strokes().
_REMARKS = {
    "order_mistakes": cal.StrokeRemarkKind.order,
    "direction_mistakes": cal.StrokeRemarkKind.direction,
    "extra_pen_downs": cal.StrokeRemarkKind.extra,
    "missing_strokes": cal.StrokeRemarkKind.missing,
}


def conditions(grid: Grid) -> list[Condition]:
    """Every condition of the grid, in the order of the rows of the table."""
    return list(grid)


def novice_and_skilled() -> dict[str, cal.WriterSkill]:
    """The writers of the library, by name."""
    return {"novice": cal.WriterSkill.novice(), "skilled": cal.WriterSkill.skilled()}


def trial(grid: Grid, condition: Condition) -> Row:
    """Runs one trial in this process and returns its row: the condition and the results."""
    condition = condition._replace(
        device=condition.device or next(iter(grid.devices)), law=condition.law or next(iter(grid.laws))
    )
    device, usual, layout, mapping, _ = grid.devices[condition.device]
    character = grid.characters[condition.character]
    options = cal.SessionOptions(
        mode=getattr(cal.FeedbackMode, condition.mode),
        device=device,
        renderer=usual,
        mapping=mapping,
        skill=grid.writers[condition.writer],
        seed=condition.seed,
        character_timeout=grid.character_timeout,
    )
    renderer = options.renderer
    renderer.servo_rate = condition.rate
    square = grid.motion_scale**2
    renderer.paper.stiffness = renderer.guidance.stiffness = condition.stiffness / square
    renderer.nearest.method = getattr(cal.NearestPointMethod, condition.method)
    renderer.nearest.tolerance = condition.tolerance
    renderer.guidance.force = copy.deepcopy(grid.laws[condition.law])  # an object keeps nothing from trial to trial
    for path, value in condition.varied:
        _set(renderer, path, grid.vary[path][value])
    if renderer.stiffness_check == cal.StiffnessCheck.reject:
        renderer.stiffness_check = cal.StiffnessCheck.clip
    # Clipped here as the session's renderer would, which does not report the effective values.
    cal.clip_stiffness(renderer, device, grid.motion_scale)
    page = cal.lay_out([character], layout)[0]
    recording = cal.write_page(page, options)
    score = cal.score_page(page, recording)[0]
    row = {
        **condition._asdict(),
        **dict(condition.varied),
        "guidance_stiffness": square * renderer.guidance.stiffness,
        "paper_stiffness": square * renderer.paper.stiffness,
        **{name: getattr(of, name) for of in (score.motion, score) for name in _COLUMNS if hasattr(of, name)},
        **{name: grid.motion_scale * getattr(score, name) for name in ("mean_pressure", "peak_force", "max_force_step")},
        **{column: score.match.count(kind) for column, kind in _REMARKS.items()},
        "simulated_time": len(recording) / recording.rate,
    }
    return {name: row[name] for name in grid._columns}


def run(
    grid: Grid,
    executor: concurrent.futures.Executor | None = None,
    *,
    path: str | os.PathLike[str] | None = None,
    progress: bool = True,
    chunk: int = 8,
    retries: int = 3,
) -> Any:
    """Runs every trial of the grid and returns the table: a pandas.DataFrame, or a structured array without pandas.

    executor: any concurrent.futures.Executor, for example a process pool on one machine or
    `dask.distributed.Client.get_executor()` on several; None: run in this process, one by one. Trials are submitted in
    chunks of `chunk`. A chunk whose worker died is submitted again, up to `retries` times, so that no trial is lost; if
    the whole pool breaks (as that of concurrent.futures does), its chunks run in this process. Rows are in the order of
    conditions(grid), whichever finishes first, and identical for the same condition and seed. With tqdm installed, a
    progress bar is shown on a terminal.
    path: a .csv file that keeps every row as soon as its chunk has finished, in that order, below one line that says
    what the rows depend on. A run with the path of an earlier one, however that ended, takes the rows from there and
    runs only what is missing; the axes of the grid may have grown, but `vary` must have the same paths.
    `pandas.read_csv(path, skiprows=1)` reads it.
    Raises TrialsLost naming the first condition of a chunk that failed too often; InvalidValue naming what differs when
    the file is of another experiment, and FormatError or FileError. KeyboardInterrupt, TrialsLost and every other
    exception that ends the trials have the table of those that finished as their attribute `table`.
    """
    every = conditions(grid)
    chunk, retries = _whole("chunk", chunk, least=1), _whole("retries", retries)
    file = None if path is None else _File(grid, every, pathlib.Path(path))
    rows: dict[Condition, Row] = {} if file is None else file.rows
    missing = [condition for condition in every if condition not in rows]
    with _Bar(len(missing), progress) as bar:

        def done(part: Sequence[Condition], results: list[Row]) -> None:
            if len(results) != len(part):
                raise TrialsLost(f"the executor returned {len(results)} rows for {len(part)} trials: {part[0]}")
            rows.update(zip(part, results))
            if file is not None:
                file.append(results)
            bar.add(len(part))

        try:
            if executor is None:
                for condition in missing:
                    done([condition], [trial(grid, condition)])
            else:
                chunks = [missing[first : first + chunk] for first in range(0, len(missing), chunk)]
                _run_on(executor, grid, chunks, done, retries)
        except BaseException as error:
            finished = [rows[condition] for condition in every if condition in rows]
            setattr(error, "table", _table(finished, grid._columns))
            raise
    return _table([rows[condition] for condition in every], grid._columns)


def to_table(rows: Sequence[Row]) -> Any:
    """Rows as a pandas.DataFrame, or as a structured array where pandas is not installed."""
    return _table(rows, dict.fromkeys(rows[0]) if rows else _COLUMNS)


def _table(rows: Sequence[Row], columns: Mapping[str, Any]) -> Any:
    """The rows, or an empty table with the columns of these types."""
    try:
        import pandas
    except ImportError:
        return _structured(rows, columns)
    table = pandas.DataFrame(list(rows), columns=list(columns))
    return table if rows else table.astype(columns)  # pandas cannot infer the types of empty columns


class Reduction(NamedTuple):
    """By how much force makes a quantity smaller, relative to vision alone: 1 - force / vision, mean over the pairs."""

    mean: float  #: NaN without a pair
    half_width: float  #: of the 95 % confidence interval; NaN with fewer than two draws
    pairs: int  #: over which the mean is
    draws: int  #: independent ones
    omitted: int  #: other pairs: one was not finished or not measured, or vision is 0, as of a count of mistakes


def reduction(table: Any, column: str = "rms_error", *, unfinished: bool = False) -> Reduction:
    """The reduction of a column of a table of run() with force, over pairs of trials that differ only in the mode.

    A seed and a character are one draw: trials of other writers, devices, laws or options with the same ones share what
    the writer believes. The interval is clustered by draw, and uses Student's t (mean_interval).
    unfinished: over all pairs that were measured, and not only over those that completed every stroke: for
    "overall_error", which counts what was left out.
    Raises InvalidValue when the table lacks a column or a mode.
    """
    columns = _columns_of(table)
    for name in (*_CONDITION, "strokes_completed", "stroke_count", column):
        if name not in columns and name not in Condition._field_defaults:  # a table of an earlier version lacks these
            raise cal.InvalidValue(f"the table has no column {name!r}")
    values = np.asarray(columns[column], dtype=float)
    usable = np.isfinite(values)
    if not unfinished:
        usable &= np.asarray(columns["strokes_completed"]) >= np.asarray(columns["stroke_count"])
    others = [np.asarray(columns[name]).tolist() for name in columns if name in _PAIRED]
    rows: dict[str, dict[tuple[Any, ...], int]] = {"vision": {}, "force": {}}
    for row, (mode, *condition) in enumerate(zip(np.asarray(columns["mode"]).tolist(), *others)):
        rows[mode][tuple(condition)] = row
    for mode, found in rows.items():
        if not found:
            raise cal.InvalidValue(f"the table has no trial with mode {mode!r}")
    both = [(rows["vision"][condition], row) for condition, row in rows["force"].items() if condition in rows["vision"]]
    pairs = np.array([pair for pair in both if usable[list(pair)].all()], dtype=int).reshape(-1, 2)
    pairs = pairs[values[pairs[:, 0]] != 0.0]
    vision, force = values[pairs].T
    drawn = zip(np.asarray(columns["seed"])[pairs[:, 0]], np.asarray(columns["character"])[pairs[:, 0]])
    numbers: dict[Any, int] = {}
    interval = cal.mean_interval(1.0 - force / vision, [numbers.setdefault(draw, len(numbers)) for draw in drawn])
    return Reduction(interval.mean, interval.half_width, len(pairs), interval.draws, len(both) - len(pairs))


def write(table: Any, path: str | os.PathLike[str]) -> None:
    """Writes a table of run() as .csv or .parquet (requires pyarrow), atomically: the whole file or none.

    Raises FileError naming the file and the reason.
    """
    path = pathlib.Path(path)
    if path.suffix not in (".csv", ".parquet"):
        raise cal.InvalidValue(f"{path}: expected .csv or .parquet, got {path.suffix!r}")
    columns = _columns_of(table)
    with _replaced(path) as temporary:
        if path.suffix == ".csv":
            with open(temporary, "w", newline="", encoding="utf-8") as file:
                file.write(_csv([columns, *zip(*(np.asarray(column).tolist() for column in columns.values()))]))
        else:
            import pyarrow
            import pyarrow.parquet

            pyarrow.parquet.write_table(
                pyarrow.table({name: _parquet(np.asarray(column)) for name, column in columns.items()}), temporary
            )


@contextlib.contextmanager
def _writing(path: pathlib.Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        reason = os.strerror(error.errno) if error.errno else str(error)  # pyarrow's own message names the temporary file
        raise _file_error(error, path, f"cannot be written: {reason}") from error


def _file_error(error: OSError, path: pathlib.Path, what: str) -> cal.FileError:
    kind = cal.FileNotFound if error.errno == errno.ENOENT else cal.FileError
    told = kind(f"{path}: {what}")
    told.errno, told.filename = error.errno, os.fspath(path)
    return told


@contextlib.contextmanager
def _replaced(path: pathlib.Path) -> Iterator[pathlib.Path]:
    """A temporary file that replaces the one at `path` once it is complete."""
    temporary = path.with_name(path.name + f".{os.getpid()}.part")
    try:
        with _writing(path):
            yield temporary
            os.replace(temporary, path)
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink()


def _csv(rows: Iterable[Iterable[Any]]) -> str:
    """Floats have as many digits as they need to be read back exactly."""
    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    return text.getvalue()


def _paths(value: Any, prefix: str = "") -> Iterator[str]:
    """Of every field of a struct and of the structs in it."""
    for name in getattr(type(value), "__match_args__", ()):
        yield prefix + name
        yield from _paths(getattr(value, name), f"{prefix}{name}.")


#: What the two trials of a pair have in common.
_PAIRED = {*_CONDITION, *_paths(cal.RendererOptions())} - {"mode"}


class _File:
    """The file in which run() keeps its rows: what they depend on, as a comment, the names of the columns, and rows."""

    _MARK = "# calligraphy.experiment.run: "

    def __init__(self, grid: Grid, every: Iterable[Condition], path: pathlib.Path) -> None:
        if path.suffix != ".csv":
            raise cal.InvalidValue(f"path: expected .csv, got {str(path)!r}")
        self.path, self.grid = path, grid
        self.rows: dict[Condition, Row] = {}
        self.torn = False  # whether it may end within a line, after a failure to write, so that nothing may follow
        basis = _basis(grid)
        try:
            text = path.read_bytes().decode("utf-8", "replace")  # a line may end within a character
        except FileNotFoundError:
            text = ""
        except OSError as error:
            raise _file_error(error, path, f"cannot be read: {os.strerror(error.errno or 0)}") from error
        if text:
            head, _, rest = text.partition("\n")
            self._compare(head, basis)
            self._read(rest)
        wanted = set(every)
        for condition in self.rows:
            if condition not in wanted:
                raise cal.InvalidValue(f"{path}: of another experiment: the grid has no {condition}")
        # A new file is complete or absent; one that exists loses the line that was being written when its run ended.
        with _replaced(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
            file.write(self._MARK + json.dumps(basis) + "\n" + _csv([grid._columns]))
            file.write(_csv(row.values() for row in self.rows.values()))

    def append(self, rows: Iterable[Row]) -> None:
        if self.torn:
            return
        self.torn = True
        with _writing(self.path), open(self.path, "a", newline="", encoding="utf-8") as file:
            file.write(_csv([row[name] for name in self.grid._columns] for row in rows))
        self.torn = False

    def _compare(self, head: str, basis: dict[str, str]) -> None:
        try:
            there = json.loads(head[len(self._MARK) :] if head.startswith(self._MARK) else "")
        except ValueError:
            raise cal.InvalidValue(f"{self.path}: is not a file of experiment.run(), and is left as it is") from None
        both = [{_of(name) for name in names} for names in (there, basis)]
        for name in {**there, **basis}:
            one, other = there.get(name), basis.get(name)
            grown = name.startswith(_GROWING) and not all(_of(name) in names for names in both)
            if one != other and not grown:
                raise cal.InvalidValue(f"{self.path}: of another experiment: {name} is {one} there and {other} here")

    def _read(self, text: str) -> None:
        columns = self.grid._columns
        try:
            lines = list(csv.reader(io.StringIO(text[: text.rfind("\n") + 1], newline="")))
            if len(lines) > 1 and len(lines[-1]) < len(columns):  # ended at a line break within a name
                del lines[-1]
            if not lines or lines[0] != list(columns):
                raise ValueError("not the columns of a table")
            for line in lines[1:]:
                if len(line) != len(columns):
                    raise ValueError(f"{len(line)} values, expected {len(columns)}: {','.join(line)}")
                row = {name: _parsed(kind, value) for (name, kind), value in zip(columns.items(), line)}
                varied = tuple((path, row[path]) for path in self.grid.vary)
                self.rows[Condition(*(row[name] for name in _CONDITION))._replace(varied=varied)] = row
        except (ValueError, csv.Error) as error:
            raise cal.FormatError(f"{self.path}: {error}") from None


def _parsed(kind: type, text: str) -> Any:
    if kind is bool:
        if text not in ("True", "False"):
            raise ValueError(f"expected True or False, got {text!r}")
        return text == "True"
    return kind(text)


#: What rows depend on that belongs to one value of an axis: others may be added.
_GROWING = ("characters[", "writers[", "devices[", "options[", "laws[", "vary[")


def _of(name: str) -> str:
    """The value of an axis to which a field belongs."""
    return re.sub(r"(\.\w+|\[\d+\])*$", "", name)


def _basis(grid: Grid) -> dict[str, str]:
    """What a row of the grid depends on besides its condition, by name."""
    basis = {"version": cal.__version__, "vary": repr(list(grid.vary))}
    for name in ("character_timeout", "page", "motion_scale"):
        basis[name] = repr(getattr(grid, name))
    for name, setup in grid.devices.items():
        basis.update(_leaves(f"devices[{name!r}]", setup.device))
        options = _leaves("", setup.options)
        for path in ("guidance.force", *grid.vary):
            options = {n: v for n, v in options.items() if not f"{n}.".startswith(f".{path}.")}
        basis.update({f"options[{name!r}]{n}": v for n, v in options.items()})
    for name, law in grid.laws.items():
        basis[f"laws[{name!r}]"] = _told(law)
    for path, values in grid.vary.items():
        for name, value in values.items():
            basis.update(_leaves(f"vary[{path!r}][{name!r}]", value))
    for name, character in grid.characters.items():
        shape = repr(_leaves("", character)).encode("utf-8", "surrogatepass")
        basis[f"characters[{name!r}]"] = hashlib.sha256(shape).hexdigest()
    for name, skill in grid.writers.items():
        basis.update(_leaves(f"writers[{name!r}]", skill))
    return basis


def _told(law: Any) -> str:
    """What a guidance law is: its name and, of one in Python, a digest of its source and its bases'."""
    if isinstance(law, str):
        return law
    if isinstance(law, functools.partial):
        given = [*map(repr, law.args), *(f"{name}={value!r}" for name, value in law.keywords.items())]
        return f"{_told(law.func)}({', '.join(given)})"
    code = law if hasattr(law, "__qualname__") else type(law)
    source = []
    for part in getattr(code, "__mro__", (code,)):
        try:
            source.append(inspect.getsource(part))
        except (OSError, TypeError):
            source.append(repr(part))  # of a function with its address: no other process takes it for this one
    return f"{code.__qualname__} {hashlib.sha256(''.join(source).encode('utf-8', 'surrogatepass')).hexdigest()}"


def _leaves(name: str, value: Any) -> dict[str, str]:
    """The fields of a struct, those of its structs instead of them, as literals."""
    fields = getattr(type(value), "__match_args__", None)
    if fields is None:
        items = value.tolist() if isinstance(value, np.ndarray) else value
        if isinstance(items, list) and any(hasattr(type(item), "__match_args__") for item in items):
            return {n: v for i, item in enumerate(items) for n, v in _leaves(f"{name}[{i}]", item).items()}
        return {name: repr(items)}
    return {n: v for field in fields for n, v in _leaves(f"{name}.{field}", getattr(value, field)).items()}


def _run_chunk(grid: Grid, part: Sequence[Condition]) -> list[Row]:
    try:
        return [trial(grid, condition) for condition in part]
    except Exception as error:
        setattr(error, "of_trial", not isinstance(error, MemoryError))  # tells it from that of an executor
        raise


def _run_on(
    executor: concurrent.futures.Executor,
    grid: Grid,
    chunks: list[list[Condition]],
    done: Callable[[list[Condition], list[Row]], None],
    retries: int,
) -> None:
    failures = [0] * len(chunks)
    pending: dict[concurrent.futures.Future[list[Row]], int] = {}
    # Filled by each future's callback: concurrent.futures.wait misses a future cancelled before it ran.
    ended: queue.SimpleQueue[concurrent.futures.Future[list[Row]]] = queue.SimpleQueue()

    def send(index: int) -> None:
        future = executor.submit(_run_chunk, grid, chunks[index])
        pending[future] = index
        future.add_done_callback(ended.put)

    def failed(index: int, error: BaseException) -> None:
        known = isinstance(error, (cal.Error, TypeError, AttributeError, pickle.PicklingError))
        if known or getattr(error, "of_trial", False):
            raise error  # a retry would fail in the same way
        failures[index] += 1
        if failures[index] > retries:
            raise TrialsLost(f"{chunks[index][0]} and {len(chunks[index]) - 1} more: {error!r}") from error
        if isinstance(error, concurrent.futures.BrokenExecutor):
            done(chunks[index], _run_chunk(grid, chunks[index]))
            return
        try:
            send(index)
        except (concurrent.futures.BrokenExecutor, RuntimeError):
            done(chunks[index], _run_chunk(grid, chunks[index]))

    try:
        for index in range(len(chunks)):
            try:
                send(index)
            except concurrent.futures.BrokenExecutor as error:
                failed(index, error)
        while pending:
            future = ended.get()
            problem = concurrent.futures.CancelledError() if future.cancelled() else future.exception()
            if problem is None:
                done(chunks[pending[future]], future.result())
                del pending[future]
            else:
                failed(pending.pop(future), problem)
    except BaseException:
        for future, index in pending.items():
            if not future.cancel() and future.done() and future.exception() is None:
                with contextlib.suppress(Exception):  # the first one is raised
                    done(chunks[index], future.result())
        raise


class _Bar:
    """The progress bar of tqdm on a terminal or in a notebook, if installed; otherwise nothing."""

    def __init__(self, total: int, wanted: bool) -> None:
        self._bar: Any = None
        if wanted:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=total, unit="trial", disable=None)

    def add(self, count: int) -> None:
        if self._bar is not None:
            self._bar.update(count)

    def __enter__(self) -> _Bar:
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()


def _character(source: cal.CharacterSet | cal.CharacterList, code: str) -> cal.Character:
    found = source.find(code)
    if found is None:
        raise cal.InvalidValue(f"characters: {code!r} is not in the set")
    return found


def _writers(writers: Union[Sequence[str], Mapping[str, cal.WriterSkill]]) -> dict[str, cal.WriterSkill]:
    if isinstance(writers, Mapping):
        return {_text("writers", name): _one("writers", skill, cal.WriterSkill) for name, skill in writers.items()}
    known = novice_and_skilled()

    def named(what: str, name: Any) -> str:
        if not isinstance(name, str) or name not in known:
            raise cal.InvalidValue(f"{what}: expected one of {', '.join(known)} or a dict, got {name!r}")
        return name

    return {name: known[name] for name in _axis("writers", _list("writers", writers), named)}


def _devices(
    device: Union[str, cal.Capabilities, Sequence[str], Mapping[str, cal.Capabilities]],
) -> dict[str, cal.Capabilities]:
    if isinstance(device, Mapping):
        devices = {_text("device", name): _one("device", able, cal.Capabilities) for name, able in device.items()}
    elif isinstance(device, Iterable):
        names = [device] if isinstance(device, str) else device
        devices = {name: cal.device_profile(name) for name in _axis("device", names, _text)}
    else:
        devices = {_one("device", device, cal.Capabilities).name: device}
    if not devices:
        raise cal.InvalidValue("device: expected at least one")
    return devices


def _laws(laws: Union[Sequence[str], Mapping[str, Any], None], options: cal.RendererOptions) -> dict[str, Any]:
    def checked(what: str, value: Any) -> Any:
        try:
            cal.GuidanceOptions(force=value)
        except (TypeError, cal.InvalidValue) as error:
            raise cal.InvalidValue(f"{what}: {str(error).partition(': ')[2]}") from None
        return value

    if laws is None:
        law = options.guidance.force
        named = getattr(law, "func", law)  # of a functools.partial
        return {law if isinstance(law, str) else getattr(named, "__name__", type(named).__name__): law}
    if isinstance(laws, Mapping):
        return {_text("law", name): checked("law", value) for name, value in laws.items()}
    names = _axis("law", _list("law", laws), lambda what, name: checked(what, _text(what, name)))
    return {name: name for name in names}


def _varied(
    vary: Mapping[str, Union[Iterable[Any], Mapping[str, Any]]], options: cal.RendererOptions
) -> dict[str, dict[Any, Any]]:
    """Of each path, the value of each value or name in its column."""
    result: dict[str, dict[Any, Any]] = {}
    if not isinstance(vary, Mapping):
        raise cal.InvalidValue(f"vary: expected a dict, got {vary!r}")
    for path, values in vary.items():
        what = f"vary: {_text('vary', path)}"
        usual: Any = options
        for name in path.split("."):
            fields = getattr(type(usual), "__match_args__", ())
            if name not in fields:
                kind = type(usual).__name__
                raise cal.InvalidValue(f"{what}: {kind} has no field {name!r}; it has {', '.join(fields) or 'none'}")
            usual = getattr(usual, name)
        fields = getattr(type(usual), "__match_args__", ())
        if path in _OWN_AXES:
            raise cal.InvalidValue(f"{what}: is the axis {_OWN_AXES[path]!r}")
        if fields and (not isinstance(values, Mapping) or any(own.startswith(f"{path}.") for own in _OWN_AXES)):
            raise cal.InvalidValue(f"{what}: vary one of its fields: {', '.join(fields)}")
        for other in result:
            if f"{path}.".startswith(f"{other}.") or f"{other}.".startswith(f"{path}."):
                raise cal.InvalidValue(f"{what}: {other} is varied too")

        def checked(what: str, value: Any) -> Any:
            tried = copy.deepcopy(options)
            try:
                _set(tried, path, value)
            except (TypeError, cal.InvalidValue) as error:
                raise cal.InvalidValue(f"{what}: {str(error).partition(': ')[2]}") from None
            value = _get(tried, path)
            if value != value:
                raise cal.InvalidValue(f"{what}: expected a number, got {value!r}")
            return getattr(value, "name", value)

        if isinstance(values, Mapping):
            result[path] = {_text(what, name): checked(what, value) for name, value in values.items()}
        else:
            result[path] = {value: value for value in _axis(what, _list(what, values), checked)}
    return result


def _get(options: cal.RendererOptions, path: str) -> Any:
    return functools.reduce(getattr, path.split("."), options)


def _set(options: cal.RendererOptions, path: str, value: Any) -> None:
    *structs, name = path.split(".")
    setattr(functools.reduce(getattr, structs, options), name, value)


def _axis(what: str, values: Iterable[Any], checked: Callable[[str, Any], _Value]) -> list[_Value]:
    """The checked values of one axis; none may occur twice."""
    if not isinstance(values, Iterable):
        raise cal.InvalidValue(f"{what}: expected a list, got {values!r}")
    result: dict[_Value, None] = {}
    for value in values:
        right = checked(what, value)
        if right in result:
            raise cal.InvalidValue(f"{what}: {right!r} occurs twice")
        result[right] = None
    return list(result)


def _list(what: str, values: Any) -> Any:
    """Rejects a string, which would otherwise be read as a list of its characters."""
    if isinstance(values, str):
        raise cal.InvalidValue(f"{what}: expected a list, got {values!r}")
    return values


def _one(what: str, value: Any, kind: type[_Value]) -> _Value:
    if not isinstance(value, kind):
        raise cal.InvalidValue(f"{what}: expected a {kind.__name__}, got {value!r}")
    return value


def _text(what: str, value: Any) -> str:
    if not isinstance(value, str):
        raise cal.InvalidValue(f"{what}: expected a str, got {value!r}")
    return value


def _name_of(kind: Any) -> Callable[[str, Any], str]:
    def name_of(what: str, value: Any) -> str:
        name = value.name if isinstance(value, kind) else value
        if not isinstance(name, str) or name not in kind.__members__:
            raise cal.InvalidValue(f"{what}: expected one of {', '.join(kind.__members__)}, got {value!r}")
        return name

    return name_of


def _whole(what: str, value: Any, least: int = 0, most: float = np.inf) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise cal.InvalidValue(f"{what}: expected an integer, got {value!r}") from None
    if not least <= number <= most:
        raise cal.InvalidValue(f"{what}: {value!r} is not in [{least}, {most}]")
    return number


def _positive(what: str, value: Any) -> float:
    try:
        number = float("nan") if isinstance(value, (str, bytes)) else float(value)
    except TypeError:
        number = float("nan")
    if not 0.0 < number < np.inf:
        raise cal.InvalidValue(f"{what}: expected a positive number, got {value!r}")
    return number


def _parquet(column: npt.NDArray[Any]) -> Any:
    import pyarrow

    return pyarrow.array(column.tolist(), pyarrow.string()) if column.dtype.kind in "OUT" else pyarrow.array(column)


def _structured(rows: Sequence[Row], columns: Mapping[str, Any]) -> npt.NDArray[np.void]:
    types = []
    for name, kind in columns.items():
        values = [row[name] for row in rows]
        types.append((name, np.asarray(values).dtype if values else np.dtype(kind)))
    result = np.zeros(len(rows), dtype=types)
    for name, _ in types:
        result[name] = [row[name] for row in rows]
    return result


def _columns_of(table: Any) -> dict[str, Any]:
    if not hasattr(table, "columns") and getattr(getattr(table, "dtype", None), "names", None) is None:
        raise cal.InvalidValue(f"expected a table of run(), got a {type(table).__name__}")
    names = table.dtype.names if isinstance(table, np.ndarray) else list(table.columns)
    return {name: table[name] for name in names}
