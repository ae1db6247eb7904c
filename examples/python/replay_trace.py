"""A recorded pen trace under guidance: what the renderer would have made of a person's own movement.

With a file in the format of docs/pen-traces.md its first trace of a known character is replayed (--characters: of a set
file, else of the built-in ones); without one, a trace is made: a hand that writes the character smaller, tilted, with a wobble and every stroke a little too long.
"""

import argparse
import pathlib

import matplotlib.pyplot as plt
import numpy as np
from plotting import curve, draw_template, draw_trace, name_of, save, square

import calligraphy as cal


def synthetic_trace(character: cal.Character) -> cal.PenTrace:
    """The character's own strokes at 0.5 em/s, sampled at 100 Hz, by a hand that errs."""
    random = np.random.default_rng(1)
    tilt = np.array([[np.cos(0.04), -np.sin(0.04)], [np.sin(0.04), np.cos(0.04)]])
    time, strokes = 0.0, []
    for stroke in character.strokes():
        elements = cal.place_elements(stroke, cal.Placement(em=1.0))
        points = np.concatenate([curve(e) for e in elements])
        points = np.vstack([points, points[-1] + 0.08 * elements[-1].tangent(1.0)])  # a little too far
        way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        times = np.arange(0.0, max(way[-1] / 0.5, 0.05), 0.01)
        path = np.column_stack([np.interp(times * 0.5, way, points[:, i]) for i in (0, 1)])
        wobble = 0.012 * np.sin(2 * np.pi * 1.5 * times + random.uniform(0, 6))[:, None] * [0.6, 0.8]
        path = 0.5 + 0.9 * (path + wobble - 0.5) @ tilt.T
        strokes.append(np.column_stack([path, time + times]))
        time += times[-1] + 0.4
    return cal.PenTrace(character.code, strokes, set="made")


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("file", nargs="?", type=pathlib.Path)
parser.add_argument("--characters", help="a set file, such as `calligraphy import` makes")
parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out"))
arguments = parser.parse_args()
arguments.out.mkdir(parents=True, exist_ok=True)
characters = cal.CharacterSet.open(arguments.characters) if arguments.characters else cal.built_in_characters()
path = arguments.file
if path is None:
    path = arguments.out / "trace.txt"
    cal.write_pen_traces(path, [synthetic_trace(characters["永"])], notice="made by replay_trace.py, not by a person")
known = [trace for trace in cal.read_pen_traces(str(path)) if trace.character in characters]
if not known:
    raise SystemExit(f"{path}: no trace of a character in {arguments.characters or 'the built-in set'}")
trace = known[0]

profile = cal.device_profile("desktop")
page = cal.lay_out([characters[trace.character]])[0]
placed = page.characters[0]
figure, columns = plt.subplots(1, 3, figsize=(12, 4.5), layout="constrained")
draw_template(columns[0], cal.PlacedCharacter(placed.character, cal.Placement(em=1e-3)))
for stroke in trace.strokes:
    columns[0].plot(stroke[:, 0], stroke[:, 1], color="#222222", linewidth=1.2)
columns[0].set(xlim=(-0.1, 1.1), ylim=(-0.1, 1.1), aspect="equal", xlabel="x [em]", ylabel="y [em]", title="as written")
for axes, mode in zip(columns[1:], (cal.FeedbackMode.vision, cal.FeedbackMode.force)):
    options = cal.SessionOptions(
        mode=mode,
        device=profile,
        renderer=cal.RendererOptions.for_device(profile),
        skill=cal.WriterSkill.skilled(),
    )
    recording = cal.follow_trace(page, trace, options)
    score = cal.score_page(page, recording)[0]
    draw_template(axes, placed)
    draw_trace(axes, recording.samples)
    square(axes, placed)
    axes.set(xlabel="x [mm]", title=f"{mode.name}: RMS {1e3 * score.rms_error:.2f} mm, "
             f"{score.strokes_completed} of {score.stroke_count} strokes")  # fmt: skip
    print(f"{mode.name:7} RMS error {1e3 * score.rms_error:.3f} mm, {score.strokes_completed} strokes completed")
figure.suptitle(f"{name_of(placed.character)}: a hand that does not look, on a simulated device")
save(figure, arguments.out / "replay-trace.png")
