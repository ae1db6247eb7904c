#!/usr/bin/env python3
"""永 is written with the same forces, to the last bit, in C++, in C11 and through Python's ctypes; what Python gives
that is wrong is refused.

usage: test_languages.py PROGRAM_IN_CPP PROGRAM_IN_C LIBRARY
"""
import ctypes
import struct
import subprocess
import sys
import unittest
from ctypes import POINTER, byref, c_char, c_double, c_int32, c_size_t, c_uint32, c_void_p

IN_CPP, IN_C, LIBRARY = sys.argv[1:4]
library = ctypes.CDLL(LIBRARY)
library.calligraphy_last_error.restype = ctypes.c_char_p
Vector = c_double * 3


class Sized(ctypes.Structure):
    """A struct that begins with its size."""

    def __init__(self):
        super().__init__(size=ctypes.sizeof(type(self)))


class Capabilities(Sized):
    _fields_ = [("size", c_uint32), ("name", c_char * 44), ("numbers", c_int32 * 3), ("limits", c_double * 13)]


class Mapping(Sized):
    _fields_ = [("size", c_uint32), ("rotation", c_double * 9), ("offset", Vector), ("scale", c_double)]


class PlacedCharacter(Sized):
    _fields_ = [("size", c_uint32), ("code", c_uint32), ("stroke_count", c_int32), ("has_ink", c_int32),
                ("origin", c_double * 2), ("em", c_double)]


class DeviceState(Sized):
    _fields_ = [("size", c_uint32), ("flags", c_int32 * 4), ("time", c_double), ("position", Vector),
                ("velocity", Vector), ("force", Vector), ("force_settling", c_double)]


class Tick(Sized):
    _fields_ = [("size", c_uint32), ("flags", c_int32 * 7), ("time", c_double), ("force", Vector),
                ("rest", c_double * 37)]


def call(name, *arguments):
    """Calls a function of the library. Raises its error."""
    status = getattr(library, f"calligraphy_{name}")(*arguments)
    if status != 0:
        raise ValueError(status, library.calligraphy_last_error().decode())


def made(name, *arguments):
    """Calls a function that makes a handle."""
    handle = c_void_p()
    call(name, *arguments, byref(handle))
    return handle


class Writing:
    """What write.c does."""

    def __init__(self):
        self.lines, self.pen = [], [0.08, 0.06, 0.02]
        self.capabilities, self.mapping = Capabilities(), Mapping()
        self.set = made("set_built_in")
        self.page = made("page_lay_out", self.set, "永".encode(), None, None)
        call("page_mapping", self.page, 0, c_double(1.0), byref(self.mapping))
        call("device_profile", b"desktop", byref(self.capabilities))
        self.renderer = made("renderer_create", self.page, byref(self.mapping), byref(self.capabilities), None)
        self.device = made("simulated_device_create", byref(self.capabilities), None, Vector(0.0, 0.0, 0.02))

    def tick(self):
        state, result = DeviceState(), Tick()
        position = Vector(*(self.pen[i] - self.mapping.offset[i] for i in range(3)))
        call("device_intend", self.device, position, None)
        call("device_read", self.device, byref(state))
        call("renderer_update", self.renderer, byref(state), byref(result))
        call("device_write", self.device, result.force)
        call("device_advance", self.device, c_double(1e-3))
        self.lines.append(" ".join(struct.pack(">d", force).hex() for force in result.force))

    def go(self, to, ticks):
        start = list(self.pen)
        for i in range(1, ticks + 1):
            self.pen = [start[k] + (to[k] - start[k]) * i / ticks for k in range(3)]
            self.tick()

    def polyline(self, stroke):
        count, arguments = c_size_t(), (self.page, 0, stroke, 0, c_double(1e-5))
        call("page_polyline", *arguments, None, c_size_t(0), byref(count))
        points = (c_double * (2 * count.value))()
        call("page_polyline", *arguments, points, count, byref(count))
        return list(zip(points[::2], points[1::2]))

    def write(self):
        character = PlacedCharacter()
        call("page_character", self.page, 0, byref(character))
        for stroke in range(character.stroke_count):
            points = self.polyline(stroke)
            self.go((*points[0], 0.008), 200)
            for x, y in points:
                self.go((x + 0.001, y + 0.001, -0.003), 20)
            self.go((self.pen[0], self.pen[1], 0.008), 80)
        return self.lines


def output(program):
    return subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()


class Languages(unittest.TestCase):
    def test_the_forces_are_the_same_to_the_last_bit(self):
        expected = output(IN_CPP)
        pressed = [line for line in expected if not line.startswith("0" * 16)]
        self.assertGreater(len(pressed), 1000)
        self.assertEqual(expected, output(IN_C))
        self.assertEqual(expected, Writing().write())

    def test_what_is_wrong_is_refused(self):
        writing = Writing()
        tick, small = Tick(), Tick()
        small.size = 4
        for text, arguments in {
            "renderer is null": ("renderer_update", None, byref(DeviceState()), byref(tick)),
            "a handle of a page": ("renderer_update", writing.page, byref(DeviceState()), byref(tick)),
            "calligraphy_tick: size = 4": ("renderer_update", writing.renderer, byref(DeviceState()), byref(small)),
            "force = (nan, 0, 0) N": ("device_write", writing.device, Vector(float("nan"), 0.0, 0.0)),
            "龘": ("page_lay_out", writing.set, "龘".encode(), None, None, byref(c_void_p())),
        }.items():
            with self.assertRaisesRegex(ValueError, text.replace("(", r"\(").replace(")", r"\)")):
                call(*arguments)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
