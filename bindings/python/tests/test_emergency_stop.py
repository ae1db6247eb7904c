"""The emergency stop from Python: KeyboardInterrupt and exit codes stay as they were."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys

import pytest

import calligraphy as cal

EMULATOR = os.environ.get("CALLIGRAPHY_EMULATED_PHANTOM", "")

PUSHING = """
import os, signal, sys, threading, time
import calligraphy as cal

signal.signal(signal.SIGINT, signal.default_int_handler)  # both are ignored if the tests run in the background
signal.signal(signal.SIGQUIT, signal.SIG_DFL)
cal.install_emergency_stop()
device = cal.PointerDevice(cal.device_profile("desktop"))
options = cal.ServoLoopOptions(
    servo=cal.ServoOptions(timeout=1.0, ramp_up=0.0),
    thread=cal.ServoThreadOptions(priority=0, lock_memory=False),
)
loop = cal.ServoLoop(device, lambda state: (1.0, 0.0, 0.0), options)
loop.start()
while loop.status.phase is not cal.ServoPhase.running:
    time.sleep(1e-3)
"""


def outcome(program):
    """Exit code and output of a program of its own."""
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(cal.__file__).parents[1])}
    done = subprocess.run([sys.executable, "-c", PUSHING + program], capture_output=True, text=True, env=environment,
                          timeout=120)  # fmt: skip
    return done.returncode, done.stdout + done.stderr


def test_ctrl_c_stops_the_force_and_still_raises_keyboard_interrupt():
    code, told = outcome("""
try:
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(60)
except KeyboardInterrupt:
    pass
else:
    sys.exit("no KeyboardInterrupt")
assert cal.emergency_stopped()
while loop.status.fault is not cal.DeviceFault.emergency_stop:
    time.sleep(1e-3)
assert loop.status.phase is cal.ServoPhase.zero
loop.stop()
try:
    loop.start()
except cal.DeviceError as error:
    assert "clear_emergency_stop" in str(error)
else:
    sys.exit("started")
cal.clear_emergency_stop()
assert not cal.emergency_stopped()
loop.start()
while loop.status.phase is not cal.ServoPhase.running:
    time.sleep(1e-3)
loop.stop()
""")
    assert code == 0, told


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGQUIT, signal.SIGSEGV, signal.SIGUSR1, signal.SIGALRM])
def test_a_signal_ends_the_program_as_before(number):
    code, told = outcome(f"os.kill(os.getpid(), {int(number)}); time.sleep(60)")
    assert code == -number, told


def test_a_handler_written_in_python_is_still_called():
    code, told = outcome("""
signal.signal(signal.SIGTERM, lambda *_: sys.exit(7))
cal.install_emergency_stop()  # again: changes nothing
os.kill(os.getpid(), signal.SIGTERM)
time.sleep(60)
""")
    assert code == 7, told


def test_a_broken_pipe_is_an_exception_and_stops_nothing():
    code, told = outcome("""
reading, writing = os.pipe()
os.close(reading)
try:
    os.write(writing, b"x")
except BrokenPipeError:
    pass
else:
    sys.exit("written")
assert not cal.emergency_stopped()
loop.stop()
""")
    assert code == 0, told


def test_a_device_written_in_python_gets_its_zero_at_exit(tmp_path):
    written = tmp_path / "forces"
    code, told = outcome(f"""
loop.stop()

class Scripted(cal.HapticDevice):
    def __init__(self):
        super().__init__()
        self.last = None
    def capabilities(self):
        return cal.device_profile("desktop")
    def read(self):
        return cal.DeviceState(position=(0, 0, 0), velocity=(0, 0, 0))
    def write(self, force):
        self.last = force[0]
        with open({str(written)!r}, "a") as file:
            print(force[0], file=file)
    def close(self):
        pass

scripted = Scripted()
loop = cal.ServoLoop(scripted, lambda state: (1.0, 0.0, 0.0), options)
loop.start()
while scripted.last != 1.0:
    time.sleep(1e-3)
sys.exit(5)
""")
    assert code == 5, told
    assert written.read_text().splitlines()[-1] == "0.0"


def why_no_phantom():
    if "phantom" not in cal.backends:
        return "this module was built without Phantoms"
    if not pathlib.Path(EMULATOR).is_file() or not shutil.which("umockdev-wrapper"):
        return "there is no emulated Phantom"
    return ""


@pytest.mark.skipif(bool(why_no_phantom()), reason=why_no_phantom() or "no reason")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGSEGV])
def test_no_force_is_left_at_a_phantom(number):
    program = """
import time
import calligraphy as cal

cal.install_emergency_stop()
device = cal.PhantomDevice(cal.PhantomOptions(wire_profile="simulated"))
options = cal.ServoLoopOptions(servo=cal.ServoOptions(timeout=0.5))
loop = cal.ServoLoop(device, lambda state: (0.5, 0.0, 0.0), options)
loop.start()
while True:
    time.sleep(0.01)
"""
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(cal.__file__).parents[1])}
    done = subprocess.run(
        [EMULATOR, "--signal", str(int(number)), "--", sys.executable, "-c", program],
        capture_output=True, text=True, env=environment, timeout=300,
    )  # fmt: skip
    assert done.returncode == 128 + number, done.stdout + done.stderr
    assert "the last for 0 N" in done.stderr
