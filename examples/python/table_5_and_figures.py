"""Table 5 and Figs. 31 to 38 (Wang 2006, sec. 7): one text, vision alone and vision with force.

The paper's writers are people; here a simulated novice writes on a simulated device, so the figures show the same
quantities with different values.
"""

import matplotlib.pyplot as plt
import numpy as np
from plotting import draw_template, draw_trace, name_of, output_directory, save, square

import calligraphy as cal
from calligraphy import experiment

TEXT = "北京航空"
SEEDS = 10
out = output_directory(__doc__)

# Table 5: time and error of each character in both modes.
table = experiment.run(experiment.Grid(TEXT, seeds=SEEDS))
print("Table 5, means over", SEEDS, "simulated writers")
print(f"{'character':10} {'mode':7} {'time [s]':>9} {'RMS error [mm]':>15} {'maximum [mm]':>13}")
for code in TEXT:
    for mode in ("vision", "force"):
        rows = (np.asarray(table["character"]) == code) & (np.asarray(table["mode"]) == mode)
        time, rms, largest = (np.nanmean(np.asarray(table[n])[rows]) for n in ("time", "rms_error", "max_error"))
        print(f"{code:9} {mode:7} {time:9.2f} {1e3 * rms:15.3f} {1e3 * largest:13.3f}")
print("in the paper, force feedback reduced the time by 17.1 % (26, 12, 12, 18 %), for people writing four characters")
for column, what in (("time", "time"), ("rms_error", "RMS error")):
    less = experiment.reduction(table, column)
    print(f"{what} with force: {100 * less.mean:.1f} +- {100 * less.half_width:.1f} % less (95 % interval)")

# Fig. 31: one page, both modes.
profile = cal.device_profile("desktop")
characters = cal.built_in_characters()
page = cal.lay_out([characters[code] for code in TEXT], cal.PageLayout(width=0.22, height=0.06))[0]
options = cal.SessionOptions(
    device=profile,
    renderer=cal.RendererOptions.for_device(profile),
    skill=cal.WriterSkill.novice(),
    seed=3,
)
recordings = {}
figure, rows = plt.subplots(2, 1, figsize=(8, 4.8), layout="constrained")
for axes, kind in zip(rows, (cal.FeedbackMode.vision, cal.FeedbackMode.force)):
    options.mode = kind
    recordings[kind.name] = cal.write_page(page, options)
    for placed in page.characters:
        draw_template(axes, placed)
    draw_trace(axes, recordings[kind.name].samples)
    axes.set(
        aspect="equal", xlim=(10, 210), ylim=(4, 56), xlabel="x [mm]", ylabel="y [mm]", title=f"Fig. 31: {kind.name}"
    )
save(figure, out / "figure-31.png")

# Figs. 32 to 36: the force over time while the first character is written.
samples = recordings["force"].samples
samples = samples[samples["character"] == 0]
time, force = samples["time"], samples["force"]
figure, rows = plt.subplots(3, 1, figsize=(8, 6), sharex=True, layout="constrained")
in_plane = np.linalg.norm(force[:, :2], axis=1)
for axes, value, label in zip(rows, (force[:, :2], in_plane, force[:, 2]), ("x and y [N]", "in the plane [N]", "normal [N]")):
    lines = axes.plot(time, value, linewidth=0.9)
    axes.set_ylabel(label)
    writing = samples["state"] == int(cal.InteractionState.writing)
    axes.fill_between(time, 0, 1, where=writing, transform=axes.get_xaxis_transform(), color="#ccbb44", alpha=0.18)
    if value.ndim == 2:
        axes.legend(lines, ("x", "y"), loc="upper right", ncols=2)
rows[0].set_title(f"Figs. 32 to 36: force on the hand, {name_of(page.characters[0].character)}; shaded: writing")
rows[-1].set_xlabel("time [s]")
save(figure, out / "figures-32-36.png")

# Figs. 37 and 38: each character in both modes, enlarged.
figure, grid = plt.subplots(2, len(TEXT), figsize=(11, 5.8), layout="constrained")
for row, mode in zip(grid, ("vision", "force")):
    scores = cal.score_page(page, recordings[mode])
    for index, (axes, placed) in enumerate(zip(row, page.characters)):
        every = recordings[mode].samples
        draw_template(axes, placed)
        draw_trace(axes, every[every["character"] == index])
        square(axes, placed)
        axes.set_title(f"{name_of(placed.character)}: RMS {1e3 * scores[index].rms_error:.2f} mm")
        axes.set_xlabel("x [mm]")
    row[0].set_ylabel("y [mm]")
figure.suptitle("Figs. 37 (vision alone, above) and 38 (vision with force, below)")
save(figure, out / "figures-37-38.png")
