"""A study of four guidance laws: what each does to the error, the time and the force of a simulated novice.

linear: eq. (8) of Wang, Zhang and Yao 2006, Virtual Reality 9:118-132.
saturating: an attraction of limited force, as in the survey of Bowyer, Davies and Rodriguez y Baena 2014, IEEE
Transactions on Robotics 30(1):138-157.
leading: pulls the hand along the stroke too, as the robotic teacher of Teo, Burdet and Lim 2002, HAPTICS 2002,
335-341, did.
amplifying: pushes the pen away from the stroke, so that the hand learns to resist: Patton, Stoykov, Kovic and
Mussa-Ivaldi 2006, Experimental Brain Research 168:368-383.

The simulated writer does not learn: the study shows what a law does while it acts, and not what is left of it.
"""

import matplotlib.pyplot as plt
import numpy as np
from plotting import output_directory, save

import calligraphy as cal
from calligraphy import experiment

TEXT, SEEDS = "永国", 8


class Leading:
    """A spring to the point of the stroke that is 3 mm ahead."""

    name = "leading: 300 N/m to 3 mm ahead"
    stiffness = 300.0  # [N/m]
    power = 0.1  # with which it may lead the pen on [W]

    def begin(self, stroke: cal.ActiveStroke) -> None:
        self.stroke = stroke

    def force(self, given: cal.GuidanceInput) -> np.ndarray:
        to = self.stroke.at(given.arc + 3e-3).point if given.writing else given.target
        return np.asarray(given.share * self.stiffness * (to - given.tip))


class Amplifying:
    """Away from the stroke, in proportion to the error, up to 0.5 N."""

    name = "amplifying: 200 N/m, at most 0.5 N"
    stiffness = 200.0
    power = 0.1

    def force(self, given: cal.GuidanceInput) -> np.ndarray:
        if not given.writing:
            return np.asarray(given.share * self.stiffness * given.way)
        away = -self.stiffness * given.way
        return np.asarray(given.share * away / max(1.0, float(np.linalg.norm(away)) / 0.5))


LAWS = {"linear": "linear", "saturating": "saturating", "leading": Leading, "amplifying": Amplifying}

if __name__ == "__main__":
    out = output_directory(__doc__)
    table = experiment.run(experiment.Grid(TEXT, law=LAWS, seeds=SEEDS))
    laws = np.asarray(table["law"])
    figure, rows = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    print(f"change with each law, beside vision alone, of {SEEDS * len(TEXT)} pairs (95 % interval)")
    for axes, (column, what) in zip(rows, (("rms_error", "RMS error"), ("duration", "time"))):
        for place, law in enumerate(LAWS):
            less = experiment.reduction(table[laws == law], column)
            print(f"{law:11} {what:10} {-100 * less.mean:+6.1f} ± {100 * less.half_width:.1f} %, {less.pairs} pairs")
            axes.errorbar(place, -100 * less.mean, 100 * less.half_width, fmt="o", capsize=4)
        axes.axhline(0.0, color="grey", linewidth=0.8)
        axes.set(ylabel=f"change of the {what} [%]", xticks=range(len(LAWS)), xticklabels=list(LAWS), title=what)
    for law in LAWS:
        with_force = (laws == law) & (np.asarray(table["mode"]) == "force")
        peak = np.asarray(table["peak_force"])[with_force].max()
        done = np.asarray(table["strokes_completed"])[with_force].sum()
        print(f"{law:11} at most {peak:.2f} N, {done} of {np.asarray(table['stroke_count'])[with_force].sum()} strokes")
    figure.suptitle("Four guidance laws and a simulated novice on a Desktop, beside vision alone")
    save(figure, out / "four-laws.png")
