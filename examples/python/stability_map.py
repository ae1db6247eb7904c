"""How stiff virtual paper may be: a pen is let fall on walls of many stiffnesses, beside the bounds of theory."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from plotting import output_directory, save

import calligraphy as cal

out = output_directory(__doc__)
stiffnesses = np.geomspace(100.0, 1e5, 37)
contact = cal.WallContact(seconds=4.0)
device = cal.Capabilities(apparent_mass=0.045, viscous_friction=0.1, peak_force=7.9)
rates = [250.0, 500.0, 1000.0, 2000.0, 4000.0]

figure, axes = plt.subplots(figsize=(8.5, 5), layout="constrained")
bounds: dict[str, list[float]] = {"passive": [], "stable": [], "approximate": []}
for rate in rates:
    loop = cal.SampledLoop(device=device, rate=rate, grip=cal.GripImpedance())
    outcomes = [cal.simulate_wall_contact(loop, k, contact) for k in stiffnesses]
    # A swing that dies down to a smaller one, as large as the device's peak force keeps it, is no rest.
    stable = np.array([outcome["stable"] and outcome["last_force"] < device.peak_force for outcome in outcomes])
    at = np.full(len(stiffnesses), rate)
    axes.plot(at[stable], stiffnesses[stable], "o", color="#228833", markersize=5)
    axes.plot(at[~stable], stiffnesses[~stable], "x", color="#ee6677", markersize=5)
    advice = cal.advise_stiffness(loop)
    for name, values in bounds.items():
        values.append(advice[name]["value"])
    last = max(int(np.argmin(stable)) - 1, 0)
    print(f"{rate:6.0f} Hz: settles up to {stiffnesses[last]:7.0f} N/m, no more at {stiffnesses[last + 1]:7.0f}; "
          f"theory {advice['stable']['value']:7.0f} N/m")  # fmt: skip
styles: dict[str, dict[str, Any]] = {  # the last two all but coincide
    "passive": {"color": "black", "linestyle": "--"},
    "stable": {"color": "#ddaa33", "linewidth": 4.0, "zorder": 1},
    "approximate": {"color": "black", "linestyle": ":"},
}
for name, values in bounds.items():
    axes.plot(rates, values, label=f"bound: {name}", **{"linewidth": 1.4, **styles[name]})
axes.plot([], [], "o", color="#228833", label="the pen comes to rest")
axes.plot([], [], "x", color="#ee6677", label="it keeps swinging")
axes.set(
    xscale="log", yscale="log", xlabel="servo rate [Hz]", ylabel="stiffness of the wall [N/m]",
    title="45 g with b = 0.1 N s/m in a normal grip, on a virtual wall",
)  # fmt: skip
axes.set_xticks(rates, [f"{rate:.0f}" for rate in rates])
axes.minorticks_off()
figure.legend(loc="outside right center")
save(figure, out / "stability-map.png")
