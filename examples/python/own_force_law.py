"""Your own force law, unit-tested on the simulated device: a groove that attracts the pen."""

import unittest
from typing import Callable

import matplotlib.pyplot as plt
import numpy as np
from plotting import output_directory, save

import calligraphy as cal

PROFILE = cal.device_profile("desktop")


class Groove:
    """Pulls the pen into the plane y = 0: a spring of limited range and a damper [N, m].

    The velocity is an estimate, as on most devices; the Servo estimates that of a backend which has none. Without the
    damper, sampling and that lag would let the groove swing in some hand, however soft it is.
    """

    def __init__(self, stiffness: float = 400.0, damping: float = 2.0, reach: float = 0.01) -> None:
        self.stiffness, self.damping, self.reach = stiffness, damping, reach

    def __call__(self, state: cal.DeviceState) -> np.ndarray:
        y, speed = state.position[1], state.velocity[1]
        if abs(y) > self.reach:
            return np.zeros(3)
        fade = (1.0 - (y / self.reach) ** 2) ** 2  # continuous at the end of the range
        return np.array([0.0, -self.stiffness * y * fade - self.damping * speed * fade, 0.0])


def simulate(law: Callable[[cal.DeviceState], np.ndarray], start: float, meant: float, seconds: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """A hand at `start` moves to the intended position y = `meant`; returns the pen's y and the force, tick by tick."""
    device = cal.SimulatedDevice(PROFILE, cal.GripImpedance(mass=0.1, damping=3.0, stiffness=300.0), (0.0, start, 0.0))
    device.set_intention(cal.Intention(position=(0.0, meant, 0.0)))
    servo = cal.Servo(device, law, ramp_up=0.05)
    path, force = [], []
    for tick in range(round(seconds * 1000)):
        servo.step(tick * 1e-3)
        path.append(device.true_position[1])
        force.append(device.applied_force[1])
        device.advance(1e-3)
    return np.array(path), np.array(force)


class GrooveTest(unittest.TestCase):
    def test_the_groove_is_stable_in_any_hand(self) -> None:
        law = Groove()
        loop = cal.SampledLoop(device=PROFILE, rate=1000.0, wall_damping=law.damping)
        self.assertLess(law.stiffness, cal.stiffness_for_any_hand(loop, PROFILE.velocity_cutoff, 1e6))

    def test_the_pen_rests_where_hand_and_groove_balance(self) -> None:
        path, _ = simulate(Groove(), 0.004, 0.004)
        # 300 (0.004 - y) = 400 y (1 - (y / 0.01)^2)^2 has one root in (0, 4 mm): 1.86 mm, give or take dry friction.
        y = np.linspace(0, 0.004, 100_001)
        balance = y[np.argmin(np.abs(300 * (0.004 - y) - 400 * y * (1 - (y / 0.01) ** 2) ** 2))]
        self.assertAlmostEqual(path[-1], balance, delta=2e-4)

    def test_there_is_no_force_out_of_range(self) -> None:
        _, force = simulate(Groove(), 0.03, 0.03)
        self.assertEqual(np.abs(force).max(), 0.0)

    def test_the_force_is_continuous(self) -> None:
        law = Groove()
        path, force = simulate(law, 0.02, -0.02)
        travel = np.abs(np.diff(path)).max()  # per tick [m]
        speed, rounding = 1e3 * travel, 2 * PROFILE.encoder_step
        push = np.abs(1e3 * np.diff(path, 2)).max()  # change of speed per tick [m/s]
        steepest = 1.54 / law.reach  # slope of the fade, per metre
        spring, damper = law.stiffness * (travel + rounding), push + speed * steepest * (travel + rounding)
        self.assertLess(np.abs(np.diff(force)).max(), spring + law.damping * damper)


if __name__ == "__main__":
    out = output_directory(__doc__)
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.5, 5), sharex=True, layout="constrained")
    for stiffness in (0.0, 100.0, 200.0, 400.0):
        path, force = simulate(Groove(stiffness), 0.008, 0.002)
        above.plot(1e3 * path, label=f"{stiffness:.0f} N/m")
        below.plot(force)
    above.set(ylabel="y of the pen [mm]", title="A groove at y = 0 with a damper of 2 N s/m; intended position 2 mm")
    above.legend()
    below.set(xlabel="time [ms]", ylabel="force [N]")
    save(figure, out / "own-force-law.png")
    unittest.main(argv=["own_force_law"], exit=True)
