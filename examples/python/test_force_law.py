"""Unit tests of your own force law on the simulated device, in virtual time. Copy this file and replace wall()."""

import numpy as np
import pytest

import calligraphy as cal

DESKTOP = cal.device_profile("desktop")


def wall(state: cal.DeviceState) -> tuple[float, float, float]:
    """The law under test: a wall below z = 0, a spring and a damper that never pull [N]."""
    if state.position[2] >= 0.0:
        return 0.0, 0.0, 0.0
    return 0.0, 0.0, max(0.0, -800.0 * state.position[2] - 2.0 * state.velocity[2])


def simulate(grip: cal.GripImpedance, target: tuple[float, float, float]) -> tuple[np.ndarray, float]:
    """Position after two seconds at 1 kHz, held by a hand that aims at `target` [m], and the maximum force that the law
    asked for [N], which is not limited as that of the device is.
    """
    device = cal.SimulatedDevice(DESKTOP, grip, (0.0, 0.0, 0.01))
    device.set_intention(cal.Intention(position=target))
    forces = []

    def law(state: cal.DeviceState) -> tuple[float, float, float]:
        forces.append(wall(state))
        return forces[-1]

    servo = cal.Servo(device, law)
    for tick in range(2000):
        servo.step(1e-3 * tick)
        assert servo.status.fault == cal.DeviceFault.none, servo.error  # an exception, or a force that is not finite
        device.advance(1e-3)
    return np.array(device.true_position), float(np.linalg.norm(forces, axis=1).max())


def test_a_pressed_pen_comes_to_rest_where_hand_and_wall_balance() -> None:
    position, max_force = simulate(cal.GripImpedance(mass=0.15, damping=5.0, stiffness=500.0), (0.0, 0.0, -0.005))
    # Two springs; dry friction may stop the pen slightly short of equilibrium.
    assert position[2] == pytest.approx(-0.005 * 500.0 / (500.0 + 800.0), abs=2e-4)
    assert max_force < DESKTOP.peak_force


def test_a_device_that_is_unplugged_has_no_force_and_gets_it_back_by_a_ramp() -> None:
    device = cal.SimulatedDevice(DESKTOP, cal.GripImpedance(mass=0.15, damping=5.0, stiffness=500.0), (0.0, 0.0, -0.002))
    device.schedule([cal.SimulatedFault(begin=0.5, duration=0.1, kind=cal.SimulatedFaultKind.unplugged)])
    servo = cal.Servo(device, wall)
    force = np.zeros(1000)
    for tick in range(1000):
        servo.step(1e-3 * tick)
        force[tick] = device.applied_force[2]
        device.advance(1e-3)
    assert not force[500:600].any() and force[-1] > 0.5
    assert np.diff(force).max() < 0.05


def test_there_is_no_force_above_the_wall() -> None:
    _, max_force = simulate(cal.GripImpedance(mass=0.1, damping=3.0, stiffness=300.0), (0.02, 0.0, 0.01))
    assert max_force == 0.0
