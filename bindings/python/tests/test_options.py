"""Arguments reach C++: every option of a call has its effect, and none are swapped."""

import copy

import numpy as np
import pytest

import calligraphy as cal

PROFILE = cal.device_profile("desktop")
CHARACTERS = cal.built_in_characters()
PLACED = cal.lay_out([CHARACTERS["永"]])[0].characters[0]
LOOPED = np.array([[0.0, 0.0], [4.0, 3.0], [-1.0, 3.0], [3.0, 0.0]])
AROUND = np.random.default_rng(1).uniform(-1, 4, size=(400, 2))


def stepped(seconds=0.3, law=lambda state: (0, 0, 1.0), device=None, **options):
    """The force sent to the device in every tick, and the servo."""
    device = cal.SimulatedDevice(PROFILE) if device is None else device
    servo = cal.Servo(device, law, **options)
    sent = []
    for tick in range(round(seconds * 1000)):
        device.advance(1e-3)
        servo.step(tick * 1e-3)
        sent.append(device.applied_force[2])
    return np.array(sent), servo


def test_the_tolerance_limits_the_error_of_a_search():
    coarse, fine = (cal.nearest_point(LOOPED, AROUND, "wang2006", tolerance=t) for t in (0.1, 1e-9))
    assert not np.array_equal(coarse.parameter, fine.parameter)
    assert int(cal.NearestPointStatus.approximate) in fine.status and not fine.certified.any()
    best = cal.nearest_point(LOOPED, AROUND).distance
    assert np.mean(coarse.distance - best) > np.mean(fine.distance - best)


def test_samples_and_refinements_are_used_by_the_sampled_method():
    best = cal.nearest_point(LOOPED, AROUND).distance
    errors = {
        (samples, refinements): np.mean(
            cal.nearest_point(LOOPED, AROUND, "sampled", samples=samples, refinements=refinements).distance - best
        )
        for samples, refinements in ((4, 0), (16, 0), (16, 2))
    }
    assert errors[4, 0] > errors[16, 0] > errors[16, 2] >= -1e-12


def test_tangents_and_derivatives_point_along_the_curve():
    element = cal.StrokeElement(LOOPED)
    found = cal.nearest_point(element, AROUND)
    inside = (found.parameter > 1e-3) & (found.parameter < 1 - 1e-3)
    ahead, behind = element.point(found.parameter + 1e-6), element.point(found.parameter - 1e-6)
    assert np.allclose(element.derivative(found.parameter), (ahead - behind) / 2e-6, atol=1e-4)
    along = (ahead - behind) / np.linalg.norm(ahead - behind, axis=1)[:, None]
    assert inside.sum() > 100 and np.allclose(found.tangent[inside], along[inside], atol=1e-4)
    t = np.linspace(0, 1, 10_001)
    turn = np.gradient(np.unwrap(np.arctan2(*element.tangent(t).T[::-1])), t)
    bend = element.curvature(t) * np.linalg.norm(element.derivative(t), axis=1)
    assert np.allclose(bend[1:-1], turn[1:-1], atol=1e-4)
    assert element.curvature(0.3) == element.curvature([0.3])[0]
    assert element.parameter_at(element.arc_length(0.3)) == pytest.approx(0.3, abs=0.01)


def test_an_alternate_order_is_found_by_its_name(tmp_path):
    usual = CHARACTERS["十"] if "十" in CHARACTERS else CHARACTERS["人"]
    other = cal.Character(**{**usual.__reduce__()[0].keywords, "order": "the other way"})
    assert other.order == "the other way" and other != usual
    both = cal.CharacterList([usual, other], cal.Provenance(source="a test", licence="MIT"))
    for kept in (both, cal.CharacterSet(both)):
        assert kept.find(usual.code).order == "" and kept.find(usual.code, "the other way").order == "the other way"
        assert kept.find(usual.code, "no such") is None
    assert sorted(cal.CharacterSet(both).orders(usual.code)) == ["", "the other way"]
    assert both.provenance.source == "a test" and cal.CharacterSet(both)[usual.code] == usual
    assert [p.licence for p in cal.CharacterSet(both).provenances()] == ["MIT"]


def test_characters_that_differ_only_in_feel_are_unequal():
    usual = CHARACTERS["人"]
    inputs = [cal.StrokeInput(s.type.id, s.control_points, list(2 * s.attraction_factors)) for s in usual.strokes()]
    firmer = cal.make_character("人", inputs)
    assert np.array_equal(firmer.attraction_factors, 2 * usual.attraction_factors) and firmer != usual


def test_the_first_of_several_layered_sets_takes_precedence():
    one, other = CHARACTERS["人"], cal.with_quartic_curves(CHARACTERS["人"])
    sets = [cal.CharacterSet(cal.CharacterList([c])) for c in (one, other)]
    assert cal.CharacterSet.layered(sets)["人"] == one
    assert cal.CharacterSet.layered(sets[::-1])["人"] == other


def test_a_set_has_the_requested_coordinate_precision():
    errors = [
        cal.CharacterSet.from_bytes(cal.encode_character_set(CHARACTERS, precision)).coordinate_error()
        for precision in cal.CoordinatePrecision
    ]
    assert errors == sorted(errors, reverse=True) and errors[0] > errors[1] > errors[2] > errors[3] == 0.0


def test_a_character_has_the_requested_curve_degree():
    quartic = cal.with_quartic_curves(CHARACTERS["人"])
    inputs = [cal.StrokeInput(s.type.id, s.control_points, list(s.attraction_factors)) for s in quartic.strokes()]
    assert cal.make_character("人", inputs, 4) == quartic
    with pytest.raises(cal.InvalidValue):
        cal.make_character("人", inputs)


def test_a_servo_runs_at_the_given_rate():
    quick, _ = stepped(ramp_up=0.05)
    slow, _ = stepped(ramp_up=0.2)
    assert np.argmax(quick >= 0.999) < 60 < 150 < np.argmax(slow >= 0.999) < 210
    _, usual = stepped()
    assert usual.statistics["missed_deadlines"] == 0
    with pytest.raises(cal.InvalidValue, match="rate"):
        stepped(rate=-1.0)


def test_a_servo_ramps_down_in_the_given_time():
    def fall(ramp_down):
        device = cal.SimulatedDevice(PROFILE)
        servo = cal.Servo(device, lambda state: (0, 0, 1.0), ramp_up=0.0, ramp_down=ramp_down)
        sent = []
        for tick in range(200):
            if tick == 50:
                servo.release()
            device.advance(1e-3)
            servo.step(tick * 1e-3)
            sent.append(device.applied_force[2])
        assert sent[49] == pytest.approx(1.0, abs=PROFILE.force_step) and sent[-1] == 0.0
        return sum(force > 0 for force in sent[50:])

    assert fall(5e-3) <= 6 < 20 <= fall(30e-3) <= 31


def test_a_servo_applies_the_given_timeout():
    def ticks_with_force(timeout):
        device = Weak()
        device.stale_from = 30
        servo = cal.Servo(device, lambda state: (0, 0, 0.1), ramp_up=0.0, timeout=timeout)
        for tick in range(130):
            servo.step(tick * 1e-3)
        return sum(force[2] == 0.1 for force in device.forces[30:])

    assert ticks_with_force(4e-3) < 8 and 35 < ticks_with_force(40e-3) < 45


def test_a_slow_law_takes_no_virtual_time():
    """By a real clock, a law this slow would be a fault."""

    def slow(state):
        sum(range(400_000))  # some 5 ms, more than the timeout of 4 ms
        return (0, 0, 1.0)

    sent, servo = stepped(0.02, law=slow, ramp_up=0.0)
    assert servo.statistics["work"]["worst"] == 0.0 and servo.status.fault == cal.DeviceFault.none
    assert sent[-1] == pytest.approx(1.0, abs=PROFILE.force_step)


def test_a_reset_servo_starts_again():
    _, servo = stepped(ramp_up=0.05)
    assert servo.status.phase == cal.ServoPhase.running
    servo.reset()
    assert servo.status.phase == cal.ServoPhase.zero and servo.status.gain == 0.0


def test_fault_names_are_valid_python_identifiers():
    assert cal.DeviceFault.timed_out.name == "timed_out"
    assert all(name.isidentifier() for name in cal.DeviceFault.__members__)


def test_a_simulated_device_has_the_given_position_grip_and_buttons():
    device = cal.SimulatedDevice(PROFILE, cal.GripImpedance(mass=0.1, damping=3.0, stiffness=300.0), (0.01, 0.02, 0.03))
    assert np.allclose(device.true_position, (0.01, 0.02, 0.03)) and not device.true_velocity.any()
    device.set_intention(cal.Intention(position=(0.05, 0.02, 0.03)))
    device.advance(0.01)
    assert device.true_velocity[0] > 0.01 and abs(device.true_velocity[1]) < 1e-6
    device.set_buttons(5)
    device.advance(1e-3)
    assert device.read().buttons == 5
    let_go = cal.SimulatedDevice(PROFILE, cal.GripImpedance(mass=0.1, damping=3.0, stiffness=300.0), (0.01, 0.02, 0.03))
    let_go.set_grip(cal.GripImpedance(mass=0.0, damping=0.0, stiffness=0.0))
    let_go.set_intention(cal.Intention(position=(0.05, 0.02, 0.03)))
    let_go.advance(1.0)
    assert np.allclose(let_go.true_position, (0.01, 0.02, 0.03))
    device.close()
    assert device.read().status == cal.DeviceStatus.disconnected


def test_a_force_that_is_not_finite_is_refused_and_leaves_none_behind():
    device = cal.SimulatedDevice(PROFILE)
    device.write((1.0, 0.0, 0.0))
    with pytest.raises(cal.InvalidValue, match=r"force: got \[.*nan.*\] N, expected finite numbers"):
        device.write((0.0, float("nan"), 0.0))
    assert not device.applied_force.any() and device.refused_forces == 1


def test_time_does_not_run_backwards():
    device = cal.SimulatedDevice(PROFILE)
    for seconds in (-1.0, float("nan"), float("inf")):
        with pytest.raises(cal.InvalidValue, match="seconds = "):
            device.advance(seconds)
    device.advance(0.0)
    assert device.time == 0.0


def test_a_simulated_device_shows_faults_on_schedule():
    device = cal.SimulatedDevice(PROFILE)
    kinds = cal.SimulatedFaultKind
    device.schedule([
        cal.SimulatedFault(begin=0.001, duration=0.001, kind=kinds.garbage),
        cal.SimulatedFault(begin=0.002, duration=0.001, kind=kinds.unplugged),
        cal.SimulatedFault(begin=0.003, duration=float("inf"), kind=kinds.reported, status=cal.DeviceStatus.warm_motors),
    ])
    seen = []
    for _ in range(5):
        seen.append(device.read())
        device.advance(0.001)
    assert [np.isnan(state.position).all() for state in seen] == [False, True, False, False, False]
    assert [state.status.name for state in seen] == ["ok", "ok", "disconnected", "warm_motors", "warm_motors"]
    assert seen[2].fault == cal.DeviceFault.unplugged
    with pytest.raises(cal.InvalidValue, match="scheduled fault 0: duration = 0 s"):
        device.schedule([cal.SimulatedFault(duration=0.0)])


def test_velocity_is_measured_or_estimated_as_the_profile_says():
    for name, estimated in (("desktop", True), ("ideal", False)):
        profile = cal.device_profile(name)
        assert (profile.velocity == cal.VelocitySource.estimated) == estimated
        device = cal.SimulatedDevice(profile, cal.GripImpedance(mass=0.1, damping=3.0, stiffness=300.0))
        device.set_intention(cal.Intention(velocity=(0.1, 0.0, 0.0)))
        estimator = cal.VelocityEstimator(profile.velocity_cutoff)
        estimator.update(device.read().position, 0.0)
        for _ in range(100):
            device.advance(1e-3)
            state = device.read()
            estimate = estimator.update(state.position, 1e-3)
            assert state.velocity_estimated == estimated
            assert np.array_equal(state.velocity, estimate if estimated else device.true_velocity)
        estimator.restart()
        assert not estimator.velocity.any()
    with pytest.raises(cal.InvalidValue, match="cut-off frequency of the velocity = 0 Hz"):
        cal.VelocityEstimator(0.0)


def test_a_force_law_sees_a_velocity_and_the_force_at_work_of_a_device_that_has_neither():
    seen = []

    class Silent(Weak):
        def read(self):
            self.reads += 1
            return cal.DeviceState(position=(1e-4 * self.reads, 0, 0))

    device = Silent()
    servo = cal.Servo(device, lambda state: seen.append(copy.deepcopy(state)) or (0.4, 0, 0), ramp_up=0.01)
    for tick in range(100):
        servo.step(1e-3 * tick)
    assert seen[-1].velocity == pytest.approx((0.1, 0, 0)) and seen[-1].velocity_estimated
    assert [state.force[0] for state in seen[1:]] == [force[0] for force in device.forces[:-1]]


def test_a_replayed_device_keeps_the_last_force():
    device = cal.ReplayDevice([cal.DeviceState()], PROFILE)
    device.write((1.0, 2.0, 3.0))
    assert device.last_force.tolist() == [1.0, 2.0, 3.0] and not device.finished
    assert device.capabilities() == PROFILE


class Weak(cal.HapticDevice):
    """A device with a peak force of 0.5 N and no fresh samples from some tick on."""

    def __init__(self):
        super().__init__()
        self.forces, self.reads, self.stale_from = [], 0, 10**9

    def capabilities(self):
        return cal.Capabilities(peak_force=0.5, continuous_force=0.5)

    def read(self):
        self.reads += 1
        status = cal.DeviceStatus.stale if self.reads > self.stale_from else cal.DeviceStatus.ok
        return cal.DeviceState(time=1e-3 * min(self.reads, self.stale_from), velocity=(0, 0, 0), status=status)

    def write(self, force):
        self.forces.append(force)

    def close(self):
        self.forces.append("closed")


def test_the_force_is_limited_to_the_peak_of_your_own_device():
    device = Weak()
    servo = cal.Servo(device, lambda state: (0, 0, 3.0), ramp_up=0.0)
    for tick in range(10):
        servo.step(tick * 1e-3)
    assert device.forces[-1] == pytest.approx([0, 0, 0.5])


def test_a_renderer_skips_strokes():
    page = cal.lay_out([CHARACTERS["十"]])[0]
    renderer = cal.HapticRenderer(page.characters, cal.upright_page(page.width, page.height), PROFILE)
    assert renderer.skip_stroke() and renderer.last.stroke == 0
    in_the_air = cal.DeviceState(position=(0, 0, 0.01))
    assert renderer.update(in_the_air).stroke == 1
    assert renderer.skip_stroke() and not renderer.skip_stroke()
    tick = renderer.update(in_the_air)
    assert tick.character == 1 and not tick.events
    assert renderer.set_due(0, 1) and not renderer.set_due(0, 2)
    tick = renderer.update(in_the_air)
    assert (tick.character, tick.stroke) == (0, 1) and not tick.events


def test_a_renderer_reports_what_it_clipped_and_can_be_restarted():
    page = cal.lay_out([CHARACTERS["一"]])[0]
    mapping = cal.upright_page(page.width, page.height)
    options = cal.RendererOptions(paper=cal.PaperOptions(stiffness=1e6), stiffness_check=cal.StiffnessCheck.clip)
    renderer = cal.HapticRenderer(page.characters, mapping, PROFILE, options)
    assert any("paper.stiffness" in reason for reason in renderer.clipped)
    assert renderer.options.paper.stiffness < 1e6 and renderer.page == page.characters
    renderer.trace(np.zeros((10, 3)))
    assert renderer.last.time == pytest.approx(0.01)
    again = renderer.trace(np.zeros((10, 3)))
    assert again["time"][0] == pytest.approx(0.011) and renderer.last.time == again["time"][-1]
    late = renderer.trace(np.zeros((3, 3)), [1.0, 1.5, 2.0])
    assert late["time"].tolist() == [1.0, 1.5, 2.0]
    renderer.restart()
    assert renderer.last.state == cal.InteractionState.separation and renderer.last.character == 0
    with pytest.raises(cal.InvalidValue, match="stiffness|damping"):
        cal.validate(cal.RendererOptions(), PROFILE, 1e3)
    with pytest.raises(cal.InvalidValue, match="stiffness|damping"):
        cal.validate(cal.RendererOptions(), PROFILE, scale=1e3)


def test_a_tick_of_a_trace_equals_that_of_update_in_every_column():
    page = cal.lay_out([CHARACTERS["十"] if "十" in CHARACTERS else CHARACTERS["人"]])[0]
    mapping = cal.MotionMapping(rotation=[[0, 1, 0], [0, 0, 1], [1, 0, 0]], offset=(0.01, 0.02, 0.0), scale=0.8)
    options = cal.RendererOptions.everything(PROFILE)
    session = cal.SessionOptions(device=PROFILE, renderer=options, skill=cal.WriterSkill.novice())
    written = cal.write_page(page, session)
    states = cal.device_states(written, mapping)
    one, all_at_once = (cal.HapticRenderer(page.characters, mapping, PROFILE, options) for _ in range(2))
    rows = all_at_once.trace([s.position for s in states], [s.time for s in states])
    ticks = [one.update(cal.DeviceState(time=s.time, position=s.position)) for s in states]
    for name in rows.dtype.names:
        values = np.array([getattr(tick, name) for tick in ticks])
        assert np.array_equal(rows[name], values, equal_nan=True), name
    for name in ("attraction", "friction", "viscous", "page_force", "force", "heat", "energy_given"):
        assert np.abs(rows[name]).max() > 0, name
    turned = (np.asarray(mapping.rotation).T @ rows["page_force"].T).T
    assert np.allclose(turned * np.abs(rows["force"]).max() / np.abs(turned).max(), rows["force"], atol=1e-9)
    direction = mapping.force_to_device((0, 0, 1.0))
    assert np.allclose(direction / np.linalg.norm(direction), (1, 0, 0) @ np.eye(3))
    assert ticks[0].events == cal.TickEvent(0) and (rows["events"] & cal.TickEvent.contact).any()


def test_a_trace_file_has_the_given_notice_and_unit(tmp_path):
    trace = cal.PenTrace("一", [[[0.1, 0.5, 0.0], [0.9, 0.5, 1.0]]], set="mine", em=250.0)
    cal.write_pen_traces(tmp_path / "traces.txt", [trace], notice="made by a test\nfor nobody")
    text = (tmp_path / "traces.txt").read_text(encoding="utf-8")
    assert "# made by a test\n# for nobody\n" in text
    again = cal.read_pen_traces(str(tmp_path / "traces.txt"))[0]
    assert (again.em, again.set, trace.em) == (250.0, "mine", 250.0)


def test_a_default_trace_can_be_written(tmp_path):
    path = tmp_path / "traces.txt"
    cal.write_pen_traces(path, [cal.PenTrace("一", [[[0.1, 0.5, 0.0], [0.9, 0.5, 0.4]]])])
    (read,) = cal.read_pen_traces(path)
    assert (read.character, read.set, read.em) == ("一", "unnamed", 1000.0)
    with pytest.raises(cal.InvalidValue, match="pen trace 1: its set is 'two words': expected a word"):
        cal.write_pen_traces(path, [cal.PenTrace("一", [[[0.1, 0.5, 0.0]]], set="two words")])


def test_import_options_are_applied(tmp_path):
    source = tmp_path / "characters.txt"
    cal.write_characters(str(source), CHARACTERS)
    assert len(cal.import_characters(source)[0]) == len(CHARACTERS)
    assert [c.code for c in cal.import_characters(source, only="永")[0]] == ["永"]
    with pytest.raises(cal.InvalidValue, match="letters"):
        cal.import_characters(source, letters=tmp_path / "letters.tgz")


def test_a_page_has_the_dimensions_of_its_layout():
    page = cal.lay_out([CHARACTERS["永"]], cal.PageLayout(width=0.2, height=0.1, em=0.05))[0]
    assert (page.width, page.height, page.characters[0].placement.em) == (0.2, 0.1, 0.05)
    placement = cal.Placement(origin=(1.0, 2.0), em=0.5)
    assert placement.to_page([[0, 0], [1, 0], [0, 1]]).tolist() == [[1, 2], [1.5, 2], [1, 2.5]]


def test_a_recording_keeps_its_rate_and_accepts_only_a_list_of_samples():
    rows = np.zeros(3, dtype=cal.sample_dtype)
    assert cal.Recording(250.0, rows).rate == 250.0 and len(cal.Recording(250.0, rows[::2])) == 2
    assert len(cal.Recording(250.0, rows[:0])) == 0
    with pytest.raises(cal.InvalidValue, match=r"samples: expected shape \(n,\), got \(3, 1\)"):
        cal.Recording(250.0, rows[:, None])
    rows["status"][1] = 77
    with pytest.raises(cal.InvalidValue, match=r"samples\[1\].*status 77"):
        cal.Recording(250.0, rows)
    for rate in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(cal.InvalidValue, match="rate"):
            cal.Recording(rate, rows[:1])
    with pytest.raises(cal.FileError, match="nowhere"):
        cal.read_recording("nowhere.csv")


def test_a_tradeoff_uses_the_given_queries_and_seed():
    def errors(**options):
        tradeoff = cal.nearest_point_tradeoff([CHARACTERS["永"]], rounds=1, **options)
        return [tradeoff["name"].tolist(), *(tradeoff[k][f].tolist() for k in ("real", "hard", "ticks") for f in ("error_worst", "error"))]

    usual = errors(queries=64)
    assert usual == errors(queries=64) and usual != errors(queries=64, seed=2) and usual != errors(queries=128)
    told = []
    cal.nearest_point_tradeoff([CHARACTERS["永"]], queries=16, rounds=3, progress=told.append)
    work = told[: told.index(1.0) + 1]
    assert len(work) % 3 == 0 and work == pytest.approx(np.linspace(0, 1, len(work) + 1)[1:])
    assert set(told[len(work) :]) == {1.0}  # while errors are computed


def test_a_force_field_uses_the_given_stroke_progress_and_options():
    def forces(stroke=1, progress=0.3, corner=PLACED.placement.origin, edge=PLACED.placement.em, **options):
        return cal.guidance_field(PLACED, stroke, progress, corner, edge, **{"columns": 16, **options})["forces"]

    usual = forces()
    assert np.allclose(forces(stiffness=1200.0), 2 * usual) and np.abs(usual).max() > 0.1
    assert forces(columns=9).shape == (9, 9, 2) and forces(corner=(0, 0), columns=96).shape[0] == 96
    for other in (
        forces(stroke=2), forces(progress=0.9), forces(attractor=cal.Attractor.nearest_stroke),
        forces(options=cal.StrokeOptions(space=cal.ConstraintSpace(radius=0.004, fade_width=0.002))),
        forces(corner=(0.0, 0.0)), forces(edge=0.02),
    ):  # fmt: skip
        assert not np.allclose(other, usual)


def test_the_jumps_of_a_force_field_are_where_its_force_jumps():
    placement, attractor = PLACED.placement, cal.Attractor.nearest_stroke
    field = cal.guidance_field(PLACED, 1, 0.3, placement.origin, placement.em, columns=48, attractor=attractor)
    jumps = field["jumps"]
    assert jumps.dtype.names == ("begin", "end", "size", "from_stroke", "passes_feature")
    assert jumps["begin"].shape == (len(jumps), 2) and jumps["passes_feature"].dtype == bool
    steps = [np.linalg.norm(np.diff(field["forces"], axis=axis), axis=2).max() for axis in (0, 1)]
    assert len(jumps) > 0 and 0.1 <= jumps["size"].max() <= 1.05 * max(steps)
    corner, edge = placement.origin, placement.em
    for end in ("begin", "end"):
        assert (jumps[end] >= corner).all() and (jumps[end] <= corner + edge).all()
    cell = edge / 48
    assert (np.linalg.norm(jumps["end"] - jumps["begin"], axis=1) <= 1.5 * cell).all()


def test_a_stability_map_has_the_requested_loops():
    result = cal.stability_map(cal.StabilityMapOptions(
        device=cal.Capabilities(apparent_mass=0.1, peak_force=5.0), per_decade=1, min_stiffness=100.0, max_stiffness=1e4,
        dampings=[0.5, 1.0], rates=[1000.0], delays=[2], encoder_steps=[0.0], wall_dampings=[0.0],
        grips=[cal.GripImpedance(mass=0.1, damping=3, stiffness=300)], contact=cal.WallContact(seconds=0.1), with_sweeps=False,
    ))  # fmt: skip
    grid = result["grid"]
    assert result["sweeps"] == {} and result["stiffnesses"].tolist() == pytest.approx([100.0, 1e3, 1e4])
    assert grid["viscous_friction"].tolist() == [0.5, 1.0] and grid["stable_at"].shape == (2, 3)
    for row in grid:
        assert (row["rate"], row["apparent_mass"], row["sample_delay"]) == (1000.0, 0.1, 2)
        assert row["grip"].tolist() == [0.1, 3.0, 300.0]
        device = cal.Capabilities(
            apparent_mass=0.1, viscous_friction=row["viscous_friction"], sample_delay=2, peak_force=5.0
        )
        advice = cal.advise_stiffness(cal.SampledLoop(device=device, grip=cal.GripImpedance(mass=0.1, damping=3, stiffness=300)))
        assert {name: row[name] for name in advice} == {name: bound["value"] for name, bound in advice.items()}
    brief = cal.WallContact(seconds=0.01)
    swept = cal.stability_map(
        cal.StabilityMapOptions(contact=brief, per_decade=1, min_stiffness=100.0, max_stiffness=1e3, with_grid=False)
    )
    assert len(swept["grid"]) == 0 and {"damping", "rate"} <= set(swept["sweeps"])
    for sweep in swept["sweeps"].values():
        assert sweep["label"] and len(sweep["values"]) == len(sweep["lines"]) > 1
        assert sweep["lines"].dtype == swept["grid"].dtype
