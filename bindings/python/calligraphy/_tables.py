"""Results of the extension as structured arrays, made from dicts with the fields of C++ structs."""

from __future__ import annotations

import functools
import operator
from typing import Any

import numpy as np
import numpy.typing as npt


def stability_map(results: dict[str, Any]) -> dict[str, Any]:
    each = f"({len(results['stiffnesses'])},)?"
    columns = (
        "loop.rate loop.device.apparent_mass loop.device.viscous_friction loop.device.coulomb_friction "
        "loop.device.encoder_step loop.device.sample_delay:i4 loop.wall_damping loop.grip:3f8 passive quantised stable "
        f"approximate stable_at:{each} controlled_stable_at:{each} max_stable controlled_max_stable "
        "controlled_max_stable_below_peak"
    )
    sweeps = {sweep.pop("name"): sweep | {"lines": table(sweep["lines"], columns)} for sweep in results["sweeps"]}
    return {"stiffnesses": np.array(results["stiffnesses"]), "sweeps": sweeps, "grid": table(results["grid"], columns)}


def nearest_point_tradeoff(results: list[dict[str, Any]]) -> npt.NDArray[np.void]:
    options = "method:U16 tolerance samples:i4 refinements:i4".split()
    cost = [(name, "f8") for name in ("ns", "ns_p90", "batch_ns", "error", "error_p99", "error_worst", "wrong")]
    columns = " ".join(["setting.name:U32", *(f"setting.options.{option}" for option in options)])
    return table(results, columns, real=cost, hard=cost, ticks=cost)


def import_report(results: dict[str, Any]) -> dict[str, Any]:
    same = "kind characters strokes labelled agreed allowed ids_used letters_unused notes"
    stroke = "place.code:U1 place.order:U32 place.stroke:i4 id:i4"
    measures = "frechet backward length source_length half_width false_corners:i4 lost_corners:i4 lost_inside"
    return {name: results[name] for name in same.split()} | {
        "within": table(results["within"], "error strokes:i4 characters:i4"),
        "worst": table(results["worst"], f"{stroke} error"),
        "measures": table(results["measures"], f"{stroke} {measures}"),
        "ink": np.array(results["ink"]["strokes"]),
        "crossings": tuple(results["crossings"].values()),
        "corrected": [tuple(each.values()) for each in results["corrected"]],
        "skipped": [(file["path"], file["reason"]) for file in results["skipped"]],
        "unusable": [(file["path"], file["reason"]) for file in results["skipped"] if file["unusable"]],
    }


def table(rows: list[dict[str, Any]], columns: str, **parts: Any) -> npt.NDArray[np.void]:
    """A structured array with the columns "path.to.field:format" (f8 by default), named after the fields, and parts."""
    formats = {**dict((column + ":f8").split(":")[:2] for column in columns.split()), **parts}
    paths = [path.split(".") for path in formats]
    dtype = np.dtype([(path[-1], form) for path, form in zip(paths, formats.values())])

    def cell(row: dict[str, Any], path: list[str]) -> Any:
        value: Any = functools.reduce(operator.getitem, path, row)
        return tuple(value[name] for name in dtype[path[-1]].names or value) if isinstance(value, dict) else value

    return np.array([tuple(cell(row, path) for path in paths) for row in rows], dtype)
