"""What accuracy costs: every method of the nearest point at every setting, on real and on hostile curves."""

import matplotlib.pyplot as plt
import numpy as np
from plotting import output_directory, save

import calligraphy as cal

out = output_directory(__doc__)
characters = [cal.built_in_characters()[code] for code in "永和九年"]
tradeoff = cal.nearest_point_tradeoff(characters, queries=640, rounds=5)

colors = {"exact": "#4477aa", "tracked": "#228833", "sampled": "#ee6677", "wang2006": "#aa3377"}
figure, columns = plt.subplots(1, 2, figsize=(11, 4.4), sharey=True, layout="constrained")
for axes, kind, title in zip(columns, ("real", "hard"), ("on real strokes", "on hostile curves")):
    for method, color in colors.items():
        costs = np.sort(tradeoff[kind][tradeoff["method"] == method], order="ns")
        worst = np.maximum(costs["error_worst"], 1e-17)  # none at all is drawn there
        axes.loglog(costs["ns"], worst, "o-", color=color, label=method, markersize=4)
    axes.axhline(1e-3, color="black", linewidth=0.8, linestyle="--", label="above: another branch")
    axes.set(xlabel="time per query [ns]", title=title)
    axes.set_xticks([50, 100, 200, 400], ["50", "100", "200", "400"])
    axes.minorticks_off()
columns[0].set_ylabel("largest error of the distance [sizes of the curve]")
figure.legend(*columns[1].get_legend_handles_labels(), loc="outside right center")
figure.suptitle("Nearest point: speed against accuracy")
save(figure, out / "speed-accuracy-tradeoff.png")
for entry in tradeoff:
    real, hard = entry["real"], entry["hard"]
    print(f"{entry['name']:22} {real['ns']:7.0f} ns, worst {real['error_worst']:8.1e}; hostile: wrong {hard['wrong']:7.2%}")
