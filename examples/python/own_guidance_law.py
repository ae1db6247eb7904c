"""Your own guidance law in the closed loop: a channel, in which the writer is free, beside the built-in spring."""

import matplotlib.pyplot as plt
import numpy as np
from plotting import output_directory, save

import calligraphy as cal
from calligraphy import experiment

TEXT, SEEDS = "永国", 20


class Channel:
    """No force up to 1 mm from where guidance leads, a spring beyond."""

    stiffness = 600.0  # by how much the force changes at most with the place of the pen [N/m]

    def force(self, given: cal.GuidanceInput) -> np.ndarray:
        beyond = 1.0 - 1e-3 / max(1e-3, float(np.linalg.norm(given.way)))
        return np.asarray(given.share * self.stiffness * beyond * given.way)


if __name__ == "__main__":
    out = output_directory(__doc__)
    grid = experiment.Grid(TEXT, modes=["force"], law={"spring": "linear", "channel": Channel}, seeds=SEEDS)
    table = experiment.run(grid)
    errors = {}  # of each law, in the same order: the same writers with the same beliefs and mistakes
    for law in grid.laws:
        rows = np.asarray(table["law"]) == law
        errors[law] = np.asarray(table["rms_error"])[rows]
    draws = range(errors["spring"].size)  # a seed and a character each
    change = cal.mean_interval(errors["channel"] / errors["spring"] - 1.0, list(draws))
    told = f"{100 * change.mean:+.1f} ± {100 * change.half_width:.1f} % (95 % interval, {change.draws} pairs)"
    print("RMS error in the channel, beside that with the spring:", told)

    figure, axes = plt.subplots(figsize=(5, 5), layout="constrained")
    axes.plot(1e3 * errors["spring"], 1e3 * errors["channel"], "o")
    most = 1.1e3 * max(map(np.max, errors.values()))
    axes.plot([0, most], [0, most], color="grey", linewidth=0.8)
    axes.set(xlim=(0, most), ylim=(0, most), aspect="equal", title=f"A novice's RMS error: {told}")
    axes.set(xlabel="with the spring [mm]", ylabel="in the channel [mm]")
    axes.title.set_fontsize(9)
    save(figure, out / "own-guidance-law.png")
