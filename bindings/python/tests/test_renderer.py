"""The renderer's options act from Python as documented: one test per mechanism."""

import math

import numpy as np
import pytest

import calligraphy as cal

DESKTOP = cal.device_profile("desktop")
PAGE = cal.lay_out([cal.built_in_characters()["一"]])[0]
MAPPING = cal.MotionMapping()  # device axes are page axes
PLACED = PAGE.characters[0]
START = cal.place_elements(PLACED.character.strokes()[0], PLACED.placement)[0].point(0.0)
AWAY = START + (0.0, 0.009)  # within the box of the character, too far from the start of the stroke to begin it


def renderer(paper=None, **options):
    """At 1 kHz."""
    options = cal.RendererOptions(paper=cal.PaperOptions(**(paper or {})), **options)
    return cal.HapticRenderer(PAGE.characters, MAPPING, DESKTOP, options)


def trace(heights, at=AWAY, speed=0.0, **options):
    """A pen at these heights [m], one per millisecond, that moves along the page at `speed` [m/s]."""
    heights = np.asarray(heights)
    x = at[0] + speed * 1e-3 * np.arange(len(heights))
    return renderer(**options).trace(np.column_stack([x, np.full(len(heights), at[1]), heights]))


def test_paper_presses_back_more_softly_in_its_first_half_millimetre():
    depths = np.array([0.0, 0.1e-3, 0.25e-3, 0.5e-3, 1e-3])
    ticks = trace(np.repeat(-depths, 500), paper={"stiffness": 600.0, "onset": 0.5e-3})
    strained = np.where(depths < 0.5e-3, depths**2 / 1e-3, depths - 0.25e-3)  # the integral of min(1, depth / onset)
    assert ticks["normal"][499::500] == pytest.approx(600.0 * strained, abs=1e-6)


def test_paper_damps_motion_along_its_normal():
    sinking = -0.001 - 0.01e-3 * np.arange(200)  # 10 mm/s
    ticks = trace(sinking, paper={"damping": 3.0}, velocity_cutoff=50.0)
    assert ticks["viscous"][-1] == pytest.approx((0, 0, 0.03))
    assert ticks["normal"][-1] == pytest.approx(600.0 * (ticks["penetration"][-1] - 0.25e-3) + 0.03)
    assert not trace(sinking, paper={"damping": 0.0, "stiffness": 0.0})["viscous"].any()
    settled = 1.0 - math.exp(-2.0 * math.pi * 50.0 * 5e-3)  # of the low-pass, five ticks after the first
    assert ticks["viscous"][5, 2] == pytest.approx(0.03 * settled)


def test_guidance_damps_motion_across_the_stroke_more_than_along_it():
    tangent = cal.place_elements(PLACED.character.strokes()[0], PLACED.placement)[0].tangent(0.1)
    across = np.array([-tangent[1], tangent[0]])
    steps = 0.02e-3 * np.arange(1, 201)[:, None]  # 20 mm/s: 4 mm along the stroke, then 2 mm across it
    path = np.vstack([START + steps * tangent, START + 0.004 * tangent + steps[:100] * across])
    ticks = renderer(guidance=cal.GuidanceOptions(damping=4.0)).trace(np.column_stack([path, np.full(300, -0.001)]))
    assert (ticks["state"][[199, 299]] == int(cal.InteractionState.writing)).all()
    drag = -ticks["viscous"][199, :2] @ tangent
    assert 0.0 <= drag < 0.25 * 4.0 * 0.02
    weight = ticks["weight"][299]
    assert weight > 0.5 and -ticks["viscous"][299, :2] @ across == pytest.approx(4.0 * 0.02 * weight, rel=0.05)


def test_friction_damps_its_spring_and_not_a_sliding_pen():
    heights = np.full(2000, -0.002)
    friction = cal.FrictionOptions(coefficient=0.5, stiffness=300.0, damping=2.0)
    unguided = cal.GuidanceOptions(stiffness=0.0, damping=0.0, wrong_way_stiffness=0.0)
    ticks = trace(heights, speed=0.002, paper={"friction": friction}, guidance=unguided)
    pressed = 600.0 * (0.002 - 0.25e-3)
    sticking = ticks["friction"][200] - (-300.0 * 200 * 2e-6, 0.0)  # 0.4 mm from the anchor
    assert sticking == pytest.approx((-2.0 * 0.002, 0.0), rel=0.05)
    assert ticks["viscous"][200, :2] == pytest.approx(sticking, abs=1e-6)
    assert ticks["friction"][-1] == pytest.approx((-0.5 * pressed, 0.0), rel=1e-3)
    assert np.abs(ticks["viscous"][-1]).max() < 1e-6


def test_a_pen_that_bounces_has_not_been_lifted():
    def lifts_after(height, **options):
        heights = [-0.001] * 10 + [height] * 100
        leaping = cal.ForceLimits(max_acceleration=np.inf)
        events = trace(heights, contact=cal.ContactOptions(**options), limits=leaping)["events"]
        lifts = events & int(cal.TickEvent.lift) != 0
        return int(np.argmax(lifts)) - 10 if lifts.any() else None

    assert lifts_after(0.001, lift_time=0.05) in (49, 50)
    assert lifts_after(0.001, lift_time=0.02) in (19, 20)
    assert lifts_after(0.004, lift_time=0.05, lift_clearance=0.003) == 0
    assert lifts_after(0.001, lift_time=0.05, lift_clearance=0.0008) == 0
    assert lifts_after(0.0004, lift_time=0.05) is None  # within the hysteresis of the contact


def test_a_stale_sample_holds_the_force_for_4_ms():
    pen = renderer()
    position = (*AWAY, -0.002)
    for tick in range(100):
        pen.update(cal.DeviceState(time=1e-3 * tick, position=position))
    held = pen.last.force[2]
    stale = cal.DeviceState(time=0.099, position=position, status=cal.DeviceStatus.stale)
    ticks = [pen.update(stale) for _ in range(20)]
    assert held == pytest.approx(600.0 * (0.002 - 0.25e-3))
    assert {tick.status for tick in ticks} == {cal.TickStatus.stale}
    forces = [tick.force[2] for tick in ticks]
    assert forces[:4] == [held] * 4 and forces[4] < held and forces[-1] == 0.0


def test_with_a_longer_permitted_gap_less_of_the_energy_budget_is_given_at_once():
    def pushed(max_gap):
        ticks = trace(np.full(100, -0.003), energy=cal.EnergyOptions(budget=0.1, max_gap=max_gap))
        return ticks["force"][-1, 2]

    assert 0.0 < pushed(0.05) < pushed(0.016)
    with pytest.raises(cal.InvalidValue, match="energy.max_gap = -1 s"):
        pushed(-1.0)


def test_only_a_simulated_device_may_be_unstable():
    unstable = cal.RendererOptions(paper=cal.PaperOptions(stiffness=1e5), stiffness_check=cal.StiffnessCheck.off)
    real = cal.Capabilities(peak_force=3.0, apparent_mass=0.05)
    assert DESKTOP.simulated and not real.simulated
    assert cal.HapticRenderer(PAGE.characters, MAPPING, DESKTOP, unstable).options.paper.stiffness == 1e5
    with pytest.raises(cal.InvalidValue, match="stiffness_check = off.*only simulated devices may be unstable"):
        cal.HapticRenderer(PAGE.characters, MAPPING, real, unstable)
    assert cal.SimulatedDevice(real).capabilities().simulated


def test_stiffnesses_are_clipped_to_what_is_stable_in_any_hand():
    device = cal.Capabilities(peak_force=3.0, apparent_mass=0.05, viscous_friction=0.1, sample_delay=1)
    loop = cal.SampledLoop(device=device, rate=1000.0, wall_damping=4.0)
    stable = cal.stiffness_for_any_hand(loop, 50.0, 1e6)
    assert 0.0 < stable < cal.critical_stiffness(loop) and cal.stiffness_for_any_hand(loop, 50.0, 100.0) == 100.0
    bare = cal.SampledLoop(device=cal.Capabilities(apparent_mass=0.05), rate=1000.0)
    assert cal.stiffness_for_any_hand(bare, 50.0, 1e6) == 0.0  # without damping none is
    options = cal.RendererOptions(paper=cal.PaperOptions(stiffness=1e5))
    (reason,) = cal.clip_stiffness(options, device)
    assert options.paper.stiffness == pytest.approx(stable, rel=1e-6) and "stiffness_for_any_hand" in reason
    cal.validate(options, device)


def test_the_presets_clip():
    for name in ("omni", "touch", "desktop", "premium-1.5", "ideal"):
        device = cal.device_profile(name)
        usual, full = cal.RendererOptions.for_device(device), cal.RendererOptions.everything(device)
        for options in (usual, full):
            assert options.stiffness_check == cal.StiffnessCheck.clip
            cal.validate(options, device)
            stiffest = max(options.paper.stiffness, options.guidance.stiffness)
            assert stiffest <= (device.usable_stiffness or math.inf)
        assert math.isinf(usual.energy.budget) and full.energy.budget < math.inf
        own = device.coulomb_friction / 1.0  # under a pen pressed with 1 N
        assert usual.paper.friction.coefficient == 0.0
        assert full.paper.friction.coefficient == pytest.approx(max(0.0, 0.15 - own))


def test_the_presets_feel_the_same_at_every_motion_scale():
    device = cal.device_profile("desktop")
    for preset in (cal.RendererOptions.for_device, cal.RendererOptions.everything):
        at_one = preset(device)
        for scale in (0.5, 2.0):  # powers of two: nothing is rounded
            options = preset(device, scale=scale)
            cal.validate(options, device, scale)
            for name in ("stiffness", "damping", "wrong_way_stiffness"):
                assert scale**2 * getattr(options.guidance, name) == getattr(at_one.guidance, name)
            for name in ("limit", "wrong_way_limit"):
                assert scale * getattr(options.guidance, name) == getattr(at_one.guidance, name)
            assert scale**2 * options.paper.stiffness == at_one.paper.stiffness
        with pytest.raises(cal.InvalidValue, match="scale = 0"):
            preset(device, 0.0)


def test_the_forces_of_a_device_with_a_coarse_dac_are_multiples_of_its_step():
    device = cal.SimulatedDevice(cal.Capabilities(apparent_mass=0.05, peak_force=1.0, force_step=0.25))
    device.write((0.3, -0.4, 5.0))
    assert device.applied_force.tolist() == [0.0, 0.0, 1.0]
    device.write((0.3, -0.4, 0.0))
    assert device.applied_force.tolist() == [0.25, -0.5, 0.0]
