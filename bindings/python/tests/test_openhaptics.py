"""The vendor's runtime from Python, on the stand-in of the tests: its scheduler is the clock, in a thread of its own.

CALLIGRAPHY_STAND_IN_LIBHD names the library stand_in_libhd of a build with tests.
"""

import ctypes
import os
import pathlib
import time

import pytest

import calligraphy as cal

LIBRARY = os.environ.get("CALLIGRAPHY_STAND_IN_LIBHD", "")
pytestmark = [
    pytest.mark.skipif("openhaptics" not in cal.backends, reason="this module was built without OpenHaptics"),
    pytest.mark.skipif(not pathlib.Path(LIBRARY).is_file(), reason="CALLIGRAPHY_STAND_IN_LIBHD names no library"),
]


@pytest.fixture
def runtime():
    """A device that is plugged in, held by nobody, and a scheduler in real time."""
    library = ctypes.CDLL(LIBRARY)
    control = (ctypes.c_void_p * 32)()  # stand_in.hpp: reset, plug_in, run_in_real_time, ...
    library.stand_in_control(control)
    ctypes.CFUNCTYPE(None)(control[0])()
    ctypes.CFUNCTYPE(None, ctypes.c_char_p, ctypes.c_char_p, ctypes.c_char_p)(control[1])(
        b"Default Device", b"Touch", b"touch"
    )
    ctypes.CFUNCTYPE(None, ctypes.c_bool)(control[2])(True)
    yield cal.OpenHapticsOptions(library=LIBRARY)
    ctypes.CFUNCTYPE(None)(control[0])()


def test_a_force_law_in_python_runs_on_the_vendor_s_clock_again_and_again(runtime):
    assert cal.openhaptics_runtime(LIBRARY)["found"]
    for _ in range(3):
        asked = []

        def law(state):
            asked.append(state.position.tolist())
            return 0.0, 0.0, 0.1

        with cal.OpenHapticsDevice(runtime) as device:
            assert device.library == LIBRARY and device.last_error == 0
            patient = cal.ServoLoopOptions(servo=cal.ServoOptions(timeout=1.0))
            for _ in range(2):
                before = len(asked)
                with cal.ServoLoop(device, law, patient) as loop:
                    end = time.monotonic() + 60
                    while len(asked) < before + 20:
                        assert time.monotonic() < end, loop.status
                        time.sleep(1e-3)
                assert loop.statistics["ticks"] >= 20
        assert device.read().status == cal.DeviceStatus.disconnected


def test_a_device_that_the_runtime_has_not_is_named(runtime):
    with pytest.raises(cal.DeviceError, match="Nobody's"):
        cal.OpenHapticsDevice(cal.OpenHapticsOptions(library=LIBRARY, device="Nobody's"))
    assert cal.openhaptics_error_name(0x0200) == "warm motors"
