"""Haptic guidance for writing Chinese characters: Python bindings of the C++ library.

Names are those of the C++ library. SI units; character shapes are in em (unit square, y up).
Arrays are NumPy arrays, passed without a copy where possible. docs/python.md is an introduction.
"""

import importlib as _importlib
from typing import TYPE_CHECKING

for _name in ("_interpreters", "_xxsubinterpreters"):  # from Python 3.13 on, and before
    try:
        _interpreters = _importlib.import_module(_name)
    except ImportError:
        continue
    # The extension has one set of types per process; loading it in a second interpreter would deadlock.
    if _interpreters.get_current() != _interpreters.get_main():
        raise ImportError("calligraphy can only be imported in the main interpreter of a process")
    break

from calligraphy import _calligraphy, _struct
from calligraphy._calligraphy import *
from calligraphy._calligraphy import __version__ as __version__

for _kind in list(vars(_calligraphy).values()):
    if type(_kind).__name__ == "pybind11_type":
        _struct.finish(_kind)

from calligraphy import _display as _display  # adds methods

#: The names of each optional backend, and how to install it.
_BACKENDS = {
    "phantom": (
        "LinkKind PhantomDevice PhantomOptions PluggedDevice capture_packets dump_descriptors plugged_devices read_wire_profile",
        "install libusb-1.0 and hidapi with their headers (Debian: libusb-1.0-0-dev libhidapi-dev pkg-config), then "
        "calligraphy again with CALLIGRAPHY_PHANTOM=ON, which says what is missing",
    ),
    "openhaptics": (
        "CalibrationStyle OpenHapticsDevice OpenHapticsOptions openhaptics_error_name openhaptics_runtime",
        "install calligraphy again with CALLIGRAPHY_OPENHAPTICS=ON, on a system with dlopen, and the vendor's runtime",
    ),
}

if not TYPE_CHECKING:  # with __getattr__, a type checker would accept any name

    def __getattr__(name: str) -> object:
        for backend, (names, advice) in _BACKENDS.items():
            if name in names.split() and backend not in _calligraphy.backends:
                raise AttributeError(f"calligraphy.{name}: this module was built without {backend}: {advice}")
        raise AttributeError(f"module 'calligraphy' has no attribute {name!r}")

del TYPE_CHECKING
