"""The arm of a Phantom against its formulas, written out with NumPy."""

import numpy as np
import pytest

import calligraphy as cal

RANDOM = np.random.default_rng(1)
SHOULDER = RANDOM.uniform(0.0, 1.75, 200)
#: Within the limits of the Omni.
JOINTS = np.stack([RANDOM.uniform(-0.98, 0.98, 200), SHOULDER, SHOULDER + RANDOM.uniform(-0.81, 1.25, 200)], axis=1)
MODELS = ["omni", "touch", "premium-1.5"]


def reach(arm, q):
    return arm.upper_arm * np.cos(q[..., 1]) + arm.forearm * np.sin(q[..., 2])


def tip(arm, q):
    l1, l2, r = arm.upper_arm, arm.forearm, reach(arm, q)
    height = l1 * np.sin(q[..., 1]) - l2 * np.cos(q[..., 2]) + l2
    return np.stack([arm.waist_sense * r * np.sin(q[..., 0]), height, r * np.cos(q[..., 0]) - l1], axis=-1)


def jacobian(arm, q):
    columns = []
    for joint in range(3):
        step = 1e-6 * np.eye(3)[joint]
        columns.append((tip(arm, q + step) - tip(arm, q - step)) / 2e-6)
    return np.stack(columns, axis=-1)


def test_arms_have_the_measures_that_are_published():
    omni, premium = cal.linkage("omni"), cal.linkage("premium-1.5")
    assert omni == cal.linkage("touch") and omni.waist_sense == -1.0 and premium.waist_sense == 1.0
    assert (omni.upper_arm, omni.forearm) == (0.13335, 0.13335)
    assert (premium.upper_arm, premium.forearm) == (0.20955, 0.169545)
    assert omni.limits == cal.JointLimits(
        waist=0.98, shoulder_min=0.0, shoulder_max=1.75, elbow_min=-0.81, elbow_max=1.25
    )
    with pytest.raises(cal.InvalidValue, match='"falcon".*omni'):
        cal.linkage("falcon")
    omni.forearm = 1.0  # a copy: the library's own stays as it is
    assert cal.linkage("omni").forearm == 0.13335


@pytest.mark.parametrize("model", MODELS)
def test_tip_and_jacobian_are_those_of_the_formulas(model):
    arm = cal.linkage(model)
    assert np.allclose(cal.tip_position(arm, JOINTS), tip(arm, JOINTS), rtol=0, atol=1e-15)
    assert cal.tip_position(arm, (0, 0, 0)).tolist() == [0.0, 0.0, 0.0]
    assert np.allclose(cal.tip_jacobian(arm, JOINTS), jacobian(arm, JOINTS), rtol=0, atol=1e-9)
    across = np.linalg.det(cal.tip_jacobian(arm, JOINTS))
    manipulability = reach(arm, JOINTS) * np.cos(JOINTS[:, 1] - JOINTS[:, 2]) / (arm.upper_arm + arm.forearm)
    assert np.allclose(cal.manipulability(arm, JOINTS), manipulability, rtol=0, atol=1e-15)
    assert np.allclose(np.abs(across), arm.upper_arm * arm.forearm * (arm.upper_arm + arm.forearm) * np.abs(manipulability))


@pytest.mark.parametrize("model", MODELS)
def test_the_inverse_leads_back_to_the_joints_and_says_what_is_out_of_reach(model):
    arm = cal.linkage(model)
    before = JOINTS[reach(arm, JOINTS) > 0.01]  # behind the waist there is another solution
    joints, reachable = cal.inverse_kinematics(arm, cal.tip_position(arm, before))
    assert reachable.all() and reachable.dtype == bool and len(before) > 150
    assert np.allclose(joints, before, rtol=0, atol=1e-9)
    joints, reachable = cal.inverse_kinematics(arm, [[0, 0, 5.0], [np.nan, 0, 0], [0, 0.05, 0.05]])
    assert reachable.tolist() == [False, False, True] and joints[1].tolist() == [0, 0, 0]
    joints, reachable = cal.inverse_kinematics(arm, (0.01, 0.05, 0.05))
    assert joints.shape == (3,) and reachable.shape == () and bool(reachable)
    assert np.allclose(cal.tip_position(arm, joints), (0.01, 0.05, 0.05))


def test_torques_are_those_of_virtual_work_and_of_the_weight():
    arm = cal.linkage("omni")
    forces = RANDOM.normal(size=JOINTS.shape)
    expected = np.einsum("nij,ni->nj", jacobian(arm, JOINTS), forces)
    assert np.allclose(cal.joint_torque(arm, JOINTS, forces), expected, rtol=0, atol=1e-8)
    held = cal.gravity_torque((0.3, 0.2), JOINTS)
    assert np.allclose(held, np.stack([np.zeros(200), 0.3 * np.cos(JOINTS[:, 1]), 0.2 * np.sin(JOINTS[:, 2])], axis=1))


def test_limits_are_kept_to_within_the_margin():
    arm = cal.linkage("omni")
    assert cal.within_limits(arm, JOINTS).all()
    joints = [[0.0, 0.5, 0.5], [1.0, 0.5, 0.5], [0.0, -0.015, 0.0], [0.0, 0.5, 1.8]]
    assert cal.within_limits(arm, joints).tolist() == [True, False, False, False]
    assert cal.within_limits(arm, joints, margin=0.021).tolist() == [True, True, True, False]
    assert cal.within_limits(arm, joints, margin=0.051).all()
    arm.limits.waist = 0.5
    assert not cal.within_limits(arm, (0.6, 0.5, 0.5))


CALLS = {
    "tip_position": (cal.tip_position, (3,)),
    "tip_jacobian": (cal.tip_jacobian, (3, 3)),
    "inverse_kinematics": (lambda arm, rows: cal.inverse_kinematics(arm, rows)[0], (3,)),
    "within_limits": (cal.within_limits, ()),
    "manipulability": (cal.manipulability, ()),
    "joint_torque": (lambda arm, rows: cal.joint_torque(arm, rows, np.ones(np.shape(rows))), (3,)),
    "gravity_torque": (lambda arm, rows: cal.gravity_torque((0.3, 0.2), rows), (3,)),
}


@pytest.mark.parametrize("name", CALLS)
def test_one_set_of_joints_is_answered_as_many_are(name):
    call, each = CALLS[name]
    arm = cal.linkage("premium-1.5")
    rows = JOINTS[:5] * 0.1
    many = call(arm, rows)
    assert many.shape == (5, *each) and call(arm, rows[:0]).shape == call(arm, []).shape == (0, *each)
    for row, answer in zip(rows, many):
        assert call(arm, row).shape == each and np.array_equal(call(arm, row), answer)
        assert np.array_equal(call(arm, row.tolist()), answer)
    assert np.array_equal(call(arm, np.repeat(rows, 2, axis=0)[::2]), many)
    for wrong in (np.zeros(4), np.zeros((2, 2)), np.zeros((1, 1, 3)), 1.0):
        with pytest.raises(cal.InvalidValue, match=r"shape \(n, 3\) is expected"):
            call(arm, wrong)


def test_forces_that_do_not_fit_the_joints_are_refused():
    for joints, force in ((JOINTS, np.zeros(3)), (JOINTS[0], np.zeros((1, 3))), (JOINTS, np.zeros((7, 3)))):
        with pytest.raises(cal.InvalidValue, match=r"force: shape \(.*\) of the joints is expected, not \("):
            cal.joint_torque(cal.linkage("omni"), joints, force)
