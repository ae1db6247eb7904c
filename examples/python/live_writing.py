"""Writes a character in real time with a connected device, or else with a pointer moved by the program.

usage: live_writing.py [--wire-profile NAME|FILE] [--character 永] [--peak-force N] [--out DIRECTORY]
A Phantom needs a wire profile (docs/wire-profile.md). Otherwise the vendor's runtime is tried, then the pointer.
"""

from __future__ import annotations

import argparse
import datetime
import os
import pathlib
from typing import Callable, Optional

import matplotlib.pyplot as plt
import numpy as np
from plotting import draw_template, draw_trace, name_of, save, square

import calligraphy as cal

Watch = Callable[[cal.LiveView], object]


def open_device(wire_profile: str) -> cal.HapticDevice:
    """The connected device, or a simulated one that follows a pointer."""
    try:
        plugged = cal.plugged_devices() if "phantom" in cal.backends else []
    except cal.DeviceError:  # no bus
        plugged = []
    for device in plugged:
        print(device, device.advice)
    if plugged and wire_profile:
        return cal.PhantomDevice(cal.PhantomOptions(wire_profile=wire_profile))
    if "openhaptics" in cal.backends and cal.openhaptics_runtime()["found"]:
        return cal.OpenHapticsDevice()
    print("no device found: simulating one whose hand follows a pointer along the strokes")
    return cal.PointerDevice(cal.device_profile("desktop"))


class LedPointer:
    """Moves a pointer along the strokes of a page as the pen follows, in place of a mouse."""

    def __init__(self, device: cal.PointerDevice, page: cal.PracticePage) -> None:
        self.device, self.centre = device, np.array([page.width / 2, page.height / 2])
        self.places: list[tuple[np.ndarray, float]] = []
        for placed in page.characters:
            for stroke in placed.character.strokes():
                elements = cal.place_elements(stroke, placed.placement)
                way = np.concatenate([element.point(np.linspace(0, 1, 12)) for element in elements])
                self.places += [(way[0], 0.0), *((place, 0.5) for place in way), (way[-1], 0.0)]

    def __call__(self, view: cal.LiveView) -> None:
        place, pressure = self.places[0]
        x, y = place - self.centre
        self.device.move(x, y, pressure)
        pen = view.newest["device_point"]
        is_down = pen[2] < 0.0
        if np.hypot(*(pen[:2] - place)) < 3e-3 and is_down == (pressure > 0) and len(self.places) > 1:
            del self.places[0]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wire-profile", default=os.environ.get("CALLIGRAPHY_WIRE_PROFILE", ""))
    parser.add_argument("--character", default="永")
    parser.add_argument("--peak-force", type=float, default=1.0, help="maximum force [1 N]")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out"), help="output directory [out]")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    cal.install_emergency_stop()  # no force is left behind when this program ends, however it ends

    with open_device(arguments.wire_profile) as device:
        able = cal.with_peak_force(device.capabilities(), arguments.peak_force)
        page = cal.lay_out([cal.built_in_characters()[arguments.character]], cal.workspace_layout(able))[0]
        options = cal.LiveOptions(renderer=cal.RendererOptions.for_device(able), peak_force=arguments.peak_force)
        watch: Optional[Watch] = LedPointer(device, page) if isinstance(device, cal.PointerDevice) else None
        name = ("simulated " if isinstance(device, cal.PointerDevice) else "") + able.model
        store = arguments.out / f"{datetime.datetime.now():%Y-%m-%d-%H%M%S}.recording.gz"  # written as it comes
        print(f"{name}: write {name_of(page.characters[0].character)}; press Ctrl-C to stop")
        try:
            result = cal.write_with_device(page, device, options, watch, store)
        except KeyboardInterrupt as pressed:
            result = pressed.result  # type: ignore[attr-defined]

    for warning in result.warnings:
        print(warning)
    score, timing = cal.score_page(page, result.recording)[0], result.statistics
    print(f"{score.strokes_completed} of {score.stroke_count} strokes, RMS {1e3 * score.rms_error:.2f} mm, "
          f"period p99 {1e3 * timing['period']['p99']:.2f} ms, {timing['missed_deadlines']} deadlines missed")  # fmt: skip
    samples = result.recording.samples
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained")
    draw_template(left, page.characters[0])
    draw_trace(left, samples)
    square(left, page.characters[0])
    left.set(xlabel="x [mm]", ylabel="y [mm]", title="trace of the pen")
    right.plot(samples["time"], np.linalg.norm(samples["force"], axis=1), linewidth=0.8)
    right.set(xlabel="time [s]", ylabel="force [N]", title="force on the hand")
    figure.suptitle(name)
    save(figure, arguments.out / "live-writing.png")


if __name__ == "__main__":
    main()
