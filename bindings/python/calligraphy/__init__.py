"""Haptic guidance for writing Chinese characters: the C++ library from Python.

Names are those of the C++ library. SI units; the shapes of characters are in em (unit square, y up).
Arrays are NumPy's, taken and given without a copy where the memory allows. docs/python.md leads from
the first line to the first plot.
"""

import importlib as _importlib


def _refuse_a_second_interpreter() -> None:
    """The extension has one set of types for the process; within a second interpreter it would wait for itself."""
    for name in ("_interpreters", "_xxsubinterpreters"):  # from Python 3.13 on, and before
        try:
            interpreters = _importlib.import_module(name)
        except ImportError:
            continue
        if interpreters.get_current() != interpreters.get_main():
            raise ImportError("calligraphy runs in the main interpreter of a process alone")
        return


_refuse_a_second_interpreter()

from calligraphy._calligraphy import *
from calligraphy._calligraphy import __version__ as __version__
