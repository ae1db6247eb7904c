"""Phantoms from Python, using an emulated one behind the real libusb and hidapi (docs/emulated-phantom.md).

CALLIGRAPHY_EMULATED_PHANTOM names the program emulated_phantom of a build with tests.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import calligraphy as cal

EMULATOR = os.environ.get("CALLIGRAPHY_EMULATED_PHANTOM", "")


def why_not():
    if "phantom" not in cal.backends:
        return "this module was built without Phantoms"
    if not pathlib.Path(EMULATOR).is_file():
        return "CALLIGRAPHY_EMULATED_PHANTOM names no emulator"
    return "" if shutil.which("umockdev-wrapper") else "umockdev-wrapper is not installed"


pytestmark = pytest.mark.skipif(bool(why_not()), reason=why_not() or "no reason")

OPENED = """
import json, os, signal, threading
import calligraphy as cal

signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored if the tests run in the background
found = cal.plugged_devices()
device = cal.PhantomDevice(cal.PhantomOptions(wire_profile="simulated"))
able = device.capabilities()
page = cal.lay_out(
    [cal.built_in_characters()["一"]], cal.PageLayout(width=able.workspace[0], height=able.workspace[1])
)[0]
options = cal.LiveOptions(renderer=cal.RendererOptions.for_device(able), timeout=20.0)
# A busy machine keeps neither the emulated bus nor the loop at 1 kHz.
options.servo = cal.ServoLoopOptions(servo=cal.ServoOptions(timeout=0.5))
"""


def on_a_phantom(program, kind="usb"):
    """The JSON printed by the program in its last line."""
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(cal.__file__).parents[1])}
    done = subprocess.run(
        [EMULATOR, "--kind", kind, "--serial", "540-12345", "--write", "一", "--skill", "skilled", "--",
         sys.executable, "-c", OPENED + program],
        capture_output=True, text=True, env=environment, timeout=300,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.parametrize(("kind", "ids"), [("usb", "2988:0302"), ("hid", "2988:0304")])
def test_a_character_is_written_in_real_time_with_a_phantom(kind, ids):
    told = on_a_phantom(
        """
views = []
result = cal.write_with_device(page, device, options, views.append)
score = cal.score_page(page, result.recording)[0]
with device:
    still_open = device.read().status.name
print(json.dumps({
    "found": [str(each) for each in found], "link": found[0].link.name, "may_open": found[0].may_open,
    "name": device.description, "model": able.model, "views": len(views), "written": score.strokes_completed,
    "peak": score.peak_force, "status": still_open, "closed": device.read().status.name,
    "reports": device.statistics["used_reports"], "ticks": result.statistics["ticks"], "samples": len(result.recording),
    "warnings": device.warnings, "faults": {fault.name: n for fault, n in result.statistics["faults"].items() if n},
}))
""",
        kind,
    )
    assert told["found"] == [told["name"]] == [f"{ids} on bus 1, port 2, serial 540-12345"]
    assert told["link"] == kind and told["may_open"] and told["model"] == "Touch"
    # If the machine delayed the bus for too long, the force ramped down, correctly, and the stroke may be lost.
    faults = told["faults"].keys() - {"not_calibrated"}  # reported until the pen has been in the inkwell
    assert faults or (told["written"] == 1 and told["peak"] > 0.05)
    assert told["status"] != "disconnected" and told["closed"] == "disconnected"
    assert all("priority" in warning for warning in told["warnings"])  # depends on the privileges on this machine
    assert told["views"] > 0 and told["reports"] > 500 and told["samples"] <= told["ticks"]
    assert faults or told["samples"] > 500


@pytest.mark.parametrize("priority", [-1, 100])
def test_an_invalid_priority_is_named(priority):
    with pytest.raises(cal.InvalidValue, match=f"priority = {priority}, must be from 1 to 99, or 0"):
        cal.PhantomDevice(cal.PhantomOptions(priority=priority))


def test_ctrl_c_releases_a_phantom_and_keeps_the_recording():
    told = on_a_phantom("""
views = []
def press():
    while not (views and views[-1].newest["time"] > 0):
        pause.wait(0.01)
    os.kill(os.getpid(), signal.SIGINT)
pause = threading.Event()
threading.Thread(target=press).start()
try:
    cal.write_with_device(page, device, options, views.append)
    print(json.dumps("written"))
except KeyboardInterrupt as pressed:
    print(json.dumps([len(pressed.result.recording), device.statistics["commands"]]))
""")
    assert told != "written" and min(told) > 0


def test_a_force_law_in_python_runs_on_a_phantom():
    told = on_a_phantom("""
asked = []
def law(state):
    asked.append(state.position.tolist())
    return [0.0, 0.0, 0.1]
pause = threading.Event()
with cal.ServoLoop(device, law, options.servo) as loop:
    while len(asked) < 300:
        pause.wait(0.01)
    try:
        device.joints
    except cal.Error as error:
        refused = str(error)
print(json.dumps([len(asked), loop.statistics["ticks"], refused, device.joints.tolist()]))
""")
    asked, ticks, refused, joints = told
    assert 300 <= asked <= ticks and "in use" in refused and len(joints) == 3


def test_a_phantom_is_opened_with_the_given_options(tmp_path):
    shipped = pathlib.Path(__file__).parents[3] / "data" / "profiles" / "simulated.txt"
    lines = shipped.read_text().splitlines(keepends=True)
    (tmp_path / "no-torque").write_text("".join(line for line in lines if not line.startswith("torque-per-count")))
    told = on_a_phantom(f"""
device.close()
told = []
for wanted in (
    dict(serial="none-such", wire_profile="simulated"), dict(wire_profile={str(tmp_path / "no-torque")!r}),
    dict(model="tuch", wire_profile="simulated"), dict(velocity_cutoff=0.0, wire_profile="simulated"),
):
    try:
        cal.PhantomDevice(cal.PhantomOptions(**wanted))
    except cal.Error as error:
        told.append(type(error).__name__ + ": " + str(error))
with cal.PhantomDevice(cal.PhantomOptions(wire_profile={str(tmp_path / "no-torque")!r}, drive=False, serial="540-12345")):
    told.append("opened")
print(json.dumps(told))
""")
    values = ["InvalidValue: .*force.*torque", "InvalidValue: .*tuch", "InvalidValue: .*cutoff"]
    expected = ["DeviceError: .*none-such", *values, "opened"]
    assert len(told) == len(expected)
    for text, words in zip(told, expected):
        assert re.search(words, text), text


@pytest.mark.parametrize(("kind", "ids"), [("usb", "2988:0302"), ("hid", "2988:0304")])
def test_descriptors_and_packets_of_a_phantom_are_captured(kind, ids, tmp_path):
    told = on_a_phantom(
        f"""
device.close()
got = cal.capture_packets(found[0], transfers=50, seconds=60.0, path={str(tmp_path / "capture.txt")!r})
asked = []
brief = cal.capture_packets(found[0], transfers=10**9, seconds=20.0, stop=lambda: asked.append(1) or len(asked) > 2)
class Pressed(Exception):
    pass
seen = []
def press(*_):
    seen.append(1)
    if len(seen) == 3:  # one is still pending when a call without checks returns
        raise Pressed
signal.signal(signal.SIGALRM, press)
try:
    signal.setitimer(signal.ITIMER_REAL, 0.1, 0.1)
    cal.capture_packets(found[0], transfers=10**9, seconds=20.0)
    signal.setitimer(signal.ITIMER_REAL, 0)
    pressed = False
except Pressed:
    pressed = True
signal.setitimer(signal.ITIMER_REAL, 0)
refused = []
for wrong in (dict(transfers=0), dict(seconds=0.0)):
    try:
        cal.capture_packets(found[0], **wrong)
    except cal.InvalidValue as error:
        refused.append(str(error))
print(json.dumps([
    cal.dump_descriptors(found[0]), got["time"].tolist(), [each.hex(" ") for each in got["bytes"]], len(asked), pressed,
    refused,
]))
""",
        kind,
    )
    descriptors, times, packets, asked, pressed, refused = told
    assert f"idVendor 0x{ids[:4]}" in descriptors or ids[:4] in descriptors
    assert len(times) == len(packets) == 50
    assert times == sorted(times) and times[0] >= 0.0 and asked == 3 and pressed
    assert len(refused) == 2 and all("capture: " in each and " = 0" in each for each in refused)
    written = (tmp_path / "capture.txt").read_text().splitlines()
    assert written[1] == f"# {ids} on bus 1, port 2, serial 540-12345"
    lines = [line.split(" ", 1) for line in written if not line.startswith("#")]
    assert [rest for _, rest in lines] == [packet or "-" for packet in packets]
    assert [float(time) for time, _ in lines] == pytest.approx(times, abs=1e-6)
