"""Methods of characters, pages and recordings: what notebooks show, and tables."""

from __future__ import annotations

import html
from typing import Any, Callable, Iterable

import numpy as np
import numpy.typing as npt

import calligraphy as cal

_SIDE = 240.0  # of a character's square [px]
_LONGEST = 480.0  # side of a page or a recording [px]
_MARGIN = 8.0  # [px]
_POINTS, _RUNS = 20_000, 2_000  # in the paths of a recording at most, some 150 kB of text
_WRITING, _OTHER = "#2f9e44", "#e08a00"

Points = npt.NDArray[np.float64]


def _method(kind: type, name: str) -> Callable[[Any], Any]:
    """Adds a function to a class of the extension, as a method; make_stubs.py adds it to the stubs."""

    def add(function: Any) -> Any:
        function.__name__, function.__qualname__ = name, f"{kind.__name__}.{name}"
        setattr(kind, name, function)
        return function

    return add


@_method(cal.Character, "_repr_svg_")
def _show_character(self: cal.Character) -> str:
    """What a notebook shows, as SVG: the ink, its own or the typical one, in its square."""
    corner = np.array([_MARGIN, _MARGIN + _SIDE])
    return _svg(_SIDE, _SIDE, _square(corner, _SIDE) + _ink(self, corner, _SIDE))


@_method(cal.PracticePage, "_repr_svg_")
def _show_page(self: cal.PracticePage) -> str:
    """What a notebook shows, as SVG: the characters in their squares."""
    placed = [(each.character, each.placement.origin, each.placement.em) for each in self.characters]
    placed = [each for each in placed if np.isfinite([*each[1], each[2]]).all() and each[2] > 0.0]
    corners = [np.array(each) for each in ((0.0, 0.0), (self.width, self.height)) if np.isfinite(each).all()]
    low, scale, width, height = _fit(np.array([*corners, *(p for _, o, em in placed for p in (o, o + em))]))
    parts = []
    for drawn, origin, em in placed:
        corner = _to_picture(origin, low, scale, height)
        parts.append(_square(corner, scale * em) + _ink(drawn, corner, scale * em))
    return _svg(width, height, _frame(width, height) + "".join(parts))


@_method(cal.Recording, "_repr_svg_")
def _show_recording(self: cal.Recording) -> str:
    """What a notebook shows, as SVG: the paths of the pen on the paper, a dot where it was put down."""
    samples = self.samples
    seconds = f"{len(samples) / self.rate:.1f} s"
    on_paper = samples["state"] != int(cal.InteractionState.separation)
    writing = samples["state"] == int(cal.InteractionState.writing)
    good = on_paper & (samples["status"] == int(cal.TickStatus.ok)) & np.isfinite(samples["pen_tip"]).all(axis=1)
    if not good.any():
        return _svg(_SIDE, 12.0, _text(12.0, f"{seconds}, no pen on the paper"))
    down = np.cumsum(np.diff(on_paper, prepend=False))[good]  # number of the pen-down, and of the pause before it
    run = down + np.cumsum(np.diff(writing, prepend=False))[good]
    low, scale, width, height = _fit(samples["pen_tip"][good, :2])
    points, writing = _to_picture(samples["pen_tip"][good, :2], low, scale, height), writing[good]
    put_down = np.flatnonzero(np.diff(down, prepend=-1))
    dots = np.round(points[put_down[:: 1 + len(put_down) // _RUNS]], 1)
    for step in (0.1, 0.2, 0.4, 0.8):  # [px]
        begun = np.diff(run, prepend=-1) != 0
        kept = begun | np.diff(np.round(points / step), axis=0, prepend=0.0).any(axis=1)  # where the pen moved
        points, run, writing = points[kept], run[kept], writing[kept]
        if len(points) <= _POINTS:
            break
    else:  # nothing but noise is as long
        kept = (np.diff(run, prepend=-1) != 0) | (np.arange(len(points)) % (1 + len(points) // _POINTS) == 0)
        points, run, writing = points[kept], run[kept], writing[kept]
    grid = np.round(10.0 * points).astype(np.int64)  # [px / 10]
    starts = np.flatnonzero(np.diff(run, prepend=-1))
    ends = np.append(starts[1:], len(run))
    longest = np.sort(np.argsort(starts - ends, kind="stable")[:_RUNS])
    paths = {True: "", False: ""}
    for start, end in zip(starts[longest].tolist(), ends[longest].tolist()):
        paths[bool(writing[start])] += _line(grid[start:end])
    lines = "".join(
        f'<path d="{path}" stroke="{_WRITING if kind else _OTHER}"/>' for kind, path in paths.items() if path
    )
    dotted = "".join(f"M{x:g},{y:g}h0" for x, y in dots.tolist())
    group = (
        '<g fill="none" stroke-linecap="round" stroke-linejoin="round">'
        f'<g transform="scale(0.1)" stroke-width="15">{lines}</g><path d="{dotted}" stroke="#333333" stroke-width="4"/></g>'
    )
    millimetres = f"{1e3 * width / scale:.0f} x {1e3 * height / scale:.0f} mm"
    told = _text(height + 22.0, f"{seconds}, pen-downs: {len(put_down)}, {millimetres}")
    colours = _text(height + 38.0, "green: writing, orange: not")
    return _svg(max(width, 270.0), height + 36.0, _frame(width, height) + group + told + colours)


@_method(cal.StrokeRemark, "_repr_html_")
def _show_remark(self: cal.StrokeRemark) -> str:
    """What a notebook shows: what is wrong, as a table."""
    return html_table([_remark(self)], _REMARK[:2])


@_method(cal.MatchResult, "_repr_html_")
def _show_match(self: cal.MatchResult) -> str:
    """What a notebook shows: the remarks, as a table."""
    rows = [_remark(remark, remark.text(self.character)) for remark in self.remarks]
    return html_table(rows, _REMARK) if rows else "no remarks"


@_method(cal.CharacterScore, "_repr_html_")
def _show_score(self: cal.CharacterScore) -> str:
    """What a notebook shows: the measures, and the remarks, as tables."""
    rows = [
        ("character", self.character),
        ("strokes written", f"{self.strokes_written} of {self.stroke_count}"),
        ("RMS error [mm]", _number(1e3 * self.rms_error)),
        ("with what was left out [mm]", _number(1e3 * self.overall_error)),
        ("written in order [%]", _number(100.0 * self.coverage)),
        ("time [s]", _number(self.time)),
        *((name.replace("_", " "), _number(getattr(self, name))) for name in _ELEMENTS),
    ]
    return html_table(rows) + str(_show_match(self.match))


@_method(cal.MeanScore, "_repr_html_")
def _show_mean(self: cal.MeanScore) -> str:
    """What a notebook shows: the means, as a table."""
    rows = [
        ("characters written", f"{self.characters_written} of {self.characters}"),
        ("strokes written", f"{self.strokes_written} of {self.stroke_count}"),
        ("RMS error [mm]", _number(1e3 * self.rms_error)),
        ("with what was left out [mm]", _number(1e3 * self.overall_error)),
        ("written in order [%]", _number(100.0 * self.coverage)),
    ]
    return html_table(rows)


_REMARK = ("remark", "stroke", "what to do")
_ELEMENTS = ("contour", "external_sequence", "internal_sequence", "fidelity")


def _remark(remark: cal.StrokeRemark, *what: str) -> tuple[str, ...]:
    return remark.kind.name, str(remark.stroke + 1) if remark.stroke >= 0 else "", *what


def _number(value: float) -> str:
    return f"{value:.2f}" if np.isfinite(value) else "not measured"


def html_table(rows: Iterable[Iterable[object]], head: Iterable[str] = ()) -> str:
    """An HTML table; text is escaped."""

    def row(cells: Iterable[object], kind: str) -> str:
        return f"<tr>{''.join(f'<{kind}>{html.escape(str(cell))}</{kind}>' for cell in cells)}</tr>"

    names = list(head)
    return f"<table>{row(names, 'th') if names else ''}{''.join(row(cells, 'td') for cells in rows)}</table>"


@_method(cal.Recording, "to_pandas")
def _to_pandas(self: cal.Recording) -> Any:
    """A pandas.DataFrame with a row per tick.

    time [s]; device_x, device_y, device_z, tip_x, tip_y, tip_z [m] and force_x, force_y, force_z [N] in page axes;
    state (an InteractionState) and status (a TickStatus), categories by name; events, the sum of TickEvent's bits;
    character and stroke, indices of the active ones; tick_ns [ns]. Raises ImportError without pandas.
    """
    try:
        import pandas
    except ImportError as error:
        raise ImportError("Recording.to_pandas() needs pandas: pip install pandas") from error
    samples = self.samples
    columns: dict[str, Any] = {}
    for name in samples.dtype.names or ():
        short = {"device_point": "device", "pen_tip": "tip"}.get(name, name)
        kind = {"state": cal.InteractionState, "status": cal.TickStatus}.get(name)
        if samples[name].ndim == 2:
            columns.update({f"{short}_{axis}": samples[name][:, i] for i, axis in enumerate("xyz")})
        elif kind is not None:
            columns[name] = pandas.Categorical.from_codes(samples[name].astype(np.int8), list(kind.__members__))
        else:
            columns[name] = samples[name]
    return pandas.DataFrame(columns)


def _texts(kind: Any, codes: npt.NDArray[Any]) -> Any:
    """to_string() of the members of an enumeration with these values."""
    return np.array([cal.to_string(member) for member in kind])[codes]


@_method(cal.Recording, "columns")
def _columns(self: cal.Recording) -> dict[str, npt.NDArray[Any]]:
    """One-dimensional arrays with an element per tick, named as the columns of write_ticks() but not rounded.

    Those from buttons on only if there are inputs. state and status are str: to_string() of an InteractionState, such
    as "SS", and of a TickStatus. events is the sum of TickEvent's bits.
    """
    samples, inputs = self.samples, self.inputs
    columns: dict[str, Any] = {"time_s": samples["time"] - samples["time"][:1]}
    for name, short, unit in (("device_point", "device", "m"), ("pen_tip", "tip", "m"), ("force", "force", "N")):
        columns.update({f"{short}_{axis}_{unit}": samples[name][:, i].copy() for i, axis in enumerate("xyz")})
    columns["state"] = _texts(cal.InteractionState, samples["state"])
    columns["events"] = samples["events"].copy()
    columns["status"] = _texts(cal.TickStatus, samples["status"])
    columns.update({name: samples[name].copy() for name in ("character", "stroke", "tick_ns")})
    if len(inputs) == len(samples):
        units = {"tip_force": "_N", "altitude": "_rad", "azimuth": "_rad", "twist": "_rad", "height": "_m"}
        for name in ("buttons", "pressure", *units):
            columns[name + units.get(name, "")] = inputs[name].copy()
    return columns


def _svg(width: float, height: float, content: str) -> str:
    size = f"{width + 2 * _MARGIN:g}", f"{height + 2 * _MARGIN:g}"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size[0]}" height="{size[1]}" '
        f'viewBox="0 0 {size[0]} {size[1]}"><rect width="100%" height="100%" fill="#ffffff"/>{content}</svg>'
    )


def _text(y: float, line: str) -> str:
    return f'<text x="{_MARGIN:g}" y="{y:g}" font-family="sans-serif" font-size="12" fill="#333333">{line}</text>'


def _frame(width: float, height: float) -> str:
    return (
        f'<rect x="{_MARGIN:g}" y="{_MARGIN:g}" width="{width:g}" height="{height:g}" fill="none" stroke="#bbbbbb"/>'
    )


def _fit(points: Points) -> tuple[Points, float, float, float]:
    """The lower left of the points [m], the scale that fits them [px/m], and the size of the picture [px]."""
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(2), np.zeros(2))
    size = np.maximum(high - low, 0.01)
    scale = min(_LONGEST / float(size.max()), _SIDE / 0.04)
    return low, scale, round(scale * float(size[0]), 1), round(scale * float(size[1]), 1)


def _to_picture(points: Points, low: Points, scale: float, height: float) -> Points:
    return scale * (points - low) * (1.0, -1.0) + (_MARGIN, _MARGIN + height)


def _square(corner: Points, side: float) -> str:
    """The square of practice paper with this lower left corner, with its middle lines."""
    (x, y), half = corner.tolist(), 0.5 * side
    return (
        f'<path d="M{x:.1f},{y:.1f}h{side:.1f}v{-side:.1f}h{-side:.1f}z" fill="none" stroke="#dddddd"/>'
        f'<path d="M{x:.1f},{y - half:.1f}h{side:.1f}M{x + half:.1f},{y:.1f}v{-side:.1f}" stroke="#dddddd" '
        f'stroke-dasharray="{0.03 * side:.1f}"/>'
    )


def _ink(shown: cal.Character, corner: Points, side: float) -> str:
    outlines = [
        cal.ink_outline(stroke, max(5e-4, 0.1 / side)) * (side, -side) + corner
        for stroke in cal.with_typical_ink(shown).strokes()
    ]
    paths = ("L".join(f"{x:.1f},{y:.1f}" for x, y in outline.tolist()) for outline in outlines)
    return "".join(f'<path d="M{path}z" fill="#333333"/>' for path in paths)


def _line(grid: npt.NDArray[np.int64]) -> str:
    moves = " ".join(f"{x},{y}" for x, y in np.diff(grid, axis=0).tolist())
    return f"M{grid[0, 0]},{grid[0, 1]}l{moves or '0,0'}"
