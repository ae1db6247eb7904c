"""What the pictures of these examples have in common."""

from __future__ import annotations

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import calligraphy as cal

plt.rcParams.update({"figure.dpi": 110, "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True, "font.size": 9})


def output_directory(description: str | None) -> pathlib.Path:
    """The directory of --out, made if it is not there."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out"), help="where pictures go [out]")
    directory: pathlib.Path = parser.parse_args().out
    directory.mkdir(parents=True, exist_ok=True)
    return directory


def name_of(character: cal.Character) -> str:
    """Latin, as the fonts of matplotlib have no Chinese."""
    return f"U+{ord(character.code):04X}"


def curve(element: cal.StrokeElement) -> np.ndarray:
    """Points along an element, (n, 2)."""
    return element.point(np.linspace(0.0, 1.0, 40))


def draw_template(axes: Axes, placed: cal.PlacedCharacter, color: str = "#4477aa", width: float = 6.0) -> None:
    """The strokes of a character as they should be [mm]."""
    for stroke in placed.character.strokes():
        points = np.concatenate([curve(e) for e in cal.place_elements(stroke, placed.placement)])
        axes.plot(*(1e3 * points.T), color=color, linewidth=width, alpha=0.35, solid_capstyle="round", zorder=1)


def draw_trace(axes: Axes, samples: np.ndarray, color: str = "#228833", label: str | None = None) -> None:
    """What the pen left on the paper while it wrote [mm]."""
    writing = samples["state"] == int(cal.InteractionState.writing)
    tip = np.where(writing[:, None], 1e3 * samples["pen_tip"][:, :2], np.nan)
    axes.plot(tip[:, 0], tip[:, 1], color=color, linewidth=1.2, label=label, zorder=2)


def square(axes: Axes, placed: cal.PlacedCharacter) -> None:
    """The em square with a margin, no distortion [mm]."""
    left, bottom = 1e3 * placed.placement.origin
    em = 1e3 * placed.placement.em
    axes.set(xlim=(left - 4, left + em + 4), ylim=(bottom - 4, bottom + em + 4), aspect="equal")


def save(figure: Figure, path: pathlib.Path) -> None:
    figure.savefig(path)
    plt.close(figure)
    print(path)
