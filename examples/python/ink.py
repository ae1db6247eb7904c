"""Strokes with the width of the brush: a character as ink, and the width of each stroke along its path."""

import matplotlib.pyplot as plt
from plotting import output_directory, save

import calligraphy as cal

out = output_directory(__doc__)
# Characters imported from hanzi-writer-data have ink of their own; this one gets that of its kinds of strokes.
character = cal.with_typical_ink(cal.built_in_characters()["永"])

figure, (page, widths) = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained")
for stroke, ink in zip(character.strokes(), character.ink):
    path = cal.stroke_polyline(stroke)
    (filled,) = page.fill(*cal.ink_outline(stroke).T, label=stroke.type.pinyin)
    page.plot(*path.T, color="white", linewidth=0.8)

    knots = cal.ink_line(stroke).knots
    widths.plot(knots, ink.half_widths[: len(knots)], "o-", color=filled.get_facecolor())
page.set(aspect="equal", xlim=(0, 1), ylim=(0, 1), title="ink and path [em]")
page.legend(loc="upper right", fontsize=7)
widths.set(xlabel="along the stroke [em]", ylabel="half-width [em]", ylim=(0, None), title="width profiles")
save(figure, out / "ink.png")
