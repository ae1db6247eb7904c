import json
import math
import os
import re
import signal
import termios

from program import ProgramTest


class Devices(ProgramTest):
    """List, probe and watch. Device faults are tested in tests/devices/phantom/emulator."""

    def test_every_kind_of_device_is_listed(self):
        text = self.run_program("devices").stdout
        for word in ("phantom", "openhaptics", "simulated", "desktop", "omni"):
            self.assertIn(word, text)

    def test_the_list_keeps_to_the_width_of_the_terminal(self):
        done = self.run_program("devices", environment={"COLUMNS": "60", "CALLIGRAPHY_LIBHD": "/nowhere/libHD.so"})
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 60)
        self.assertEqual(done.stdout.count("/nowhere/libHD.so"), 1)

    def test_the_list_is_available_as_json(self):
        devices = json.loads(self.run_program("devices", "--json").stdout)
        self.assertEqual(set(devices), {"phantom", "openhaptics", "simulated"})
        self.assertIn("simulated:desktop", devices["simulated"])
        for name in devices["simulated"]:
            self.run_program("write", "一", "--out", name, "--mode", "force", "--device", name)

    def test_a_missing_device_is_named(self):
        self.assert_refused(1, ["devices", "probe", "none-such", "--out", "probe.txt"], "none-such")
        phantom = ["phantom:none-such", "--wire-profile", "simulated"]
        self.assert_refused(1, ["devices", "watch", *phantom], "none-such")
        self.assert_refused(1, ["write", "一", "--out", "out", "--device", *phantom], "none-such")
        self.assert_refused(2, ["write", "一", "--out", "out", "--device", "haply"], "haply", "docs/own-backend.md")
        self.assert_refused(1, ["devices", "watch", "openhaptics"], "libHD")
        self.assert_refused(1, ["write", "一", "--out", "out", "--device", "openhaptics"], "libHD")

    def test_a_wire_profile_is_read_before_the_device_is_opened(self):
        write = ["write", "一", "--out", "out", "--device", "phantom"]
        self.assert_refused(1, write, "calligraphy: no Phantom is connected; with one, --wire-profile is required, ",
                            "docs/wire-profile.md")
        self.assert_refused(1, [*write, "--wire-profile", "omni"], "omni", "lacks")
        (self.directory / "mine.profile").write_text("calligraphy wire profile 1\nname mine\nfrobnicate 3\n")
        self.assert_refused(1, [*write, "--wire-profile", "mine.profile"], "mine.profile:3", "frobnicate")

    def test_a_wire_profile_is_required_for_a_connected_device(self):
        without = ["--", "env", "-u", "CALLIGRAPHY_WIRE_PROFILE"]
        done = self.run_on_emulated_phantom("devices", "watch", "phantom", hand=without, code=2)
        self.assertIn("calligraphy: --wire-profile is required, ", done.stderr)

    def test_usage_errors_are_one_line_and_exit_with_two(self):
        for arguments, words in (
                (["devices", "probe"], ["--out"]),
                (["devices", "probe", "--out", ""], ["--out"]),
                (["devices", "probe", "--out", "x", "--seconds", "0"], ["--seconds"]),
                (["devices", "watch"], ["DEVICE"]),
                (["devices", "watch", "omni"], ["omni", "phantom"]),
                (["devices", "watch", "phantasm"], ["phantasm"]),
                (["devices", "frobnicate"], ["frobnicate"])):
            with self.subTest(arguments=arguments):
                self.assert_refused(2, arguments, *words)

    def test_a_connected_device_is_listed_with_its_identifiers(self):
        for kind, ids in (("usb", "2988:0302"), ("hid", "2988:0304")):
            with self.subTest(kind=kind):
                done = self.run_on_emulated_phantom("devices", "--json", hand=["--kind", kind, "--serial", "540-77"])
                device, = json.loads(done.stdout)["phantom"]
                self.assertEqual((device["device"], device["ids"], device["link"]), ("phantom:540-77", ids, kind))
                self.assertTrue(device["may_open"])
                self.assertTrue(device["nodes"])

    def test_a_probe_contains_descriptors_and_packets(self):
        done = self.run_on_emulated_phantom("devices", "probe", "--out", "probe.txt", "--seconds", "1")
        self.assertIn("probe.txt", done.stdout)
        lines = (self.directory / "probe.txt").read_text().splitlines()
        self.assertTrue(any("2988:0302" in line for line in lines))
        transfers = [line for line in lines if re.fullmatch(r"\d+\.\d{6}( [0-9a-f]{2}){44}", line)]
        self.assertGreater(len(transfers), 10)

    def test_a_device_is_watched_without_force(self):
        done = self.run_on_emulated_phantom("devices", "watch", "phantom", "--seconds", "2")
        self.assertIn("ticks", done.stdout)
        number = r" +(-?\d+\.\d\d)"
        lines = re.findall(rf"^x{number} +y{number} +z{number} mm +joints{number}{number}{number} deg +buttons",
                           done.stdout, re.MULTILINE)
        told = [line for line in ([float(value) for value in line] for line in lines) if any(line)]
        self.assertGreater(len(set(map(tuple, told))), 1)  # the hand moves
        for x, y, z, *angles in told:  # docs/phantom.md: the arm of a Touch, its zero at (0, 160, 50) mm
            q1, q2, q3 = map(math.radians, angles)
            reach = 133.35 * (math.cos(q2) + math.sin(q3))
            self.assertAlmostEqual(x, -reach * math.sin(q1), delta=0.1)
            self.assertAlmostEqual(y, 133.35 * (math.sin(q2) - math.cos(q3) + 1) - 160, delta=0.1)
            self.assertAlmostEqual(z, reach * math.cos(q1) - 133.35 - 50, delta=0.1)

    def test_a_character_is_written_through_a_real_usb_stack(self):
        """In real time: a busy machine may lose force and strokes, but the program always ends and writes its files."""
        done = self.run_on_emulated_phantom("write", "十", "--device", "phantom", "--out", "out", "--timeout", "30",
                                            hand=["--write", "十", "--skill", "skilled"])
        row, = self.summary()
        self.assertEqual(row["mode"], "force")
        if "force ramped down to zero" not in done.stderr:
            self.assertEqual(row["strokes_completed"], 2, done.stderr)
        self.assertGreater(row["peak_force_N"], 0.0)
        loop, = json.loads((self.directory / "out" / "servo.json").read_text())
        self.assertGreater(loop["ticks"], 1000)
        self.assertIn("missed deadlines", done.stdout)
        replayed = json.loads(self.run_program("replay", "out", "--json").stdout)
        self.assertEqual([(each["complete"], each["same_forces"]) for each in replayed["recordings"]], [(True, True)])
        self.assertEqual(replayed["results"][0]["rms_error_mm"], row["rms_error_mm"])

    def test_no_force_is_left_behind_by_a_signal_to_the_program(self):
        """Sent while a force is on; 128 is added to a signal that ended the program."""
        for number, code in ((signal.SIGINT, 130), (signal.SIGQUIT, 131), (signal.SIGSEGV, 139)):
            with self.subTest(signal=number.name):
                done = self.run_on_emulated_phantom("write", "永", "--device", "phantom", "--out", number.name, code=code,
                                                    hand=["--write", "永", "--signal", str(int(number))])
                self.assertRegex(done.stderr, r"the last for 0 N\n")
                if number == signal.SIGINT:  # at once, without a ramp
                    self.assertIn("emergency stop: 1", done.stdout)

    def test_space_and_esc_take_the_force_away_and_stop(self):
        for key in (b" ", b"\x1b"):
            with self.subTest(key=key):
                code, told, (before, during, after) = self.on_emulated_phantom_in_terminal(
                    "write", "永", "--device", "phantom", "--out", "out", "--force", hand=["--write", "永"],
                    once="space, Esc or Ctrl-C takes the force away and stops", key=b"x" + key)
                self.assertEqual(code, 0, told)
                self.assertIn("stopped; results so far are in out", told)
                self.assertIn("the last for 0 N", told)
                self.assertEqual(before[3] & termios.ICANON, termios.ICANON)
                self.assertEqual(during[3] & (termios.ICANON | termios.ECHO), 0)
                self.assertEqual(after, before)

    def test_a_key_skips_a_stroke_and_the_run_says_so(self):
        code, told, _ = self.on_emulated_phantom_in_terminal(
            "write", "一", "--device", "phantom", "--out", "out", "--timeout", "30", hand=["--write", "一"],
            once="; s skips a stroke", key=b"us")
        self.assertEqual(code, 0, told)
        self.assertIn("there is no stroke for that\n", told)
        self.assertIn("Stroke 1 was skipped.\n", told)
        self.assertIn("skipped or taken back", "".join(self.record()["warnings"]))

    def test_a_terminal_is_restored_when_the_program_crashes(self):
        code, told, (before, during, after) = self.on_emulated_phantom_in_terminal(
            "write", "永", "--device", "phantom", "--out", "out", once="space, Esc or Ctrl-C",
            hand=["--write", "永", "--signal", str(int(signal.SIGSEGV))])
        self.assertEqual(code, 139, told)
        self.assertNotEqual(during, before)
        self.assertEqual(after, before)

    def test_without_a_terminal_no_key_is_offered(self):
        done = self.run_on_emulated_phantom("write", "永", "--device", "phantom", "--out", "out", code=130,
                                            hand=["--write", "永", "--signal", str(int(signal.SIGINT))])
        self.assertIn("; Ctrl-C takes the force away and stops", done.stderr)

    def test_a_shipped_profile_is_printed_in_the_file_format(self):
        for name in ("omni", "simulated"):
            text = self.run_program("devices", "profile", name).stdout
            self.assertTrue(text.startswith("calligraphy wire profile 1\n"))
            self.assertIn(f"\nname {name}\n", text)
        self.assert_refused(2, ["devices", "profile", "touch"], "NAME", "omni")

    def test_a_person_is_told_why_the_pen_is_not_guided(self):
        """The hand writes the two strokes of 二 above and below the one of 一 that is due; in real time."""
        library = os.environ.get("CALLIGRAPHY_HELD_LIBHD")
        if not library:
            self.skipTest("built without the backend for openhaptics")
        done = self.run_program("write", "一", "--device", "openhaptics", "--out", "out", "--timeout", "6",
                                environment={"CALLIGRAPHY_LIBHD": library, "STAND_IN_TEXT": "二"})
        told = re.findall(r"too far from the start: \d+ mm (.+)\n", done.stderr)
        if told:
            self.assertIn("一, stroke 1 (héng): too far from the start\n", done.stderr)
        if "force ramped down to zero" not in done.stderr.partition("straight up")[0]:
            self.assertEqual(len(told), 2, done.stderr)  # once per pen-down
        self.assertIn(told[0], ("to the lower left", "to the left"))
        self.assertTrue(all(way in ("straight up", "to the upper left", "to the left") for way in told[1:]), told)

    def test_the_vendors_runtime_is_listed_watched_and_written_through(self):
        """On a stand-in for the library, whose device is held by a simulated writer; in real time, as above."""
        library = os.environ.get("CALLIGRAPHY_HELD_LIBHD")
        if not library:
            self.skipTest("built without the backend for openhaptics")
        with_runtime = {"CALLIGRAPHY_LIBHD": library, "STAND_IN_TEXT": "十"}
        listed = json.loads(self.run_program("devices", "--json", environment=with_runtime).stdout)["openhaptics"]
        self.assertEqual(listed, {"found": True, "library": library})
        watched = self.run_program("devices", "watch", "openhaptics", "--seconds", "1", environment=with_runtime)
        self.assertIn("ticks", watched.stdout)
        self.assert_refused(1, ["write", "十", "--out", "out", "--device", "openhaptics:Nobody's"], "Nobody's",
                            environment=with_runtime)
        done = self.run_program("write", "十", "--device", "openhaptics", "--out", "out", "--timeout", "30",
                                environment=with_runtime)
        row, = self.summary()
        if "force ramped down to zero" not in done.stderr:
            self.assertEqual(row["strokes_completed"], 2, done.stderr)
        self.assertGreater(row["peak_force_N"], 0.0)

    def test_warm_motors_are_told_once_and_are_in_the_summary(self):
        library = os.environ.get("CALLIGRAPHY_HELD_LIBHD")
        if not library:
            self.skipTest("built without the backend for openhaptics")
        hot = {"CALLIGRAPHY_LIBHD": library, "STAND_IN_TEXT": "十", "STAND_IN_TEMPERATURE": "0.9"}
        done = self.run_program("write", "十", "--device", "openhaptics", "--out", "out", "--timeout", "30", "--json",
                                environment=hot)
        self.assertEqual(done.stderr.count("warm motors: the force is lowered"), 1, done.stderr)
        self.assertEqual(sum("warm motors" in told for told in json.loads(done.stdout)["warnings"]), 1)

    def test_a_person_is_told_to_calibrate_the_device(self):
        library = os.environ.get("CALLIGRAPHY_HELD_LIBHD")
        if not library:
            self.skipTest("built without the backend for openhaptics")
        new = {"CALLIGRAPHY_LIBHD": library, "STAND_IN_IS_UNCALIBRATED": "1"}
        for command in (["devices", "watch", "openhaptics", "--seconds", "1"],
                        ["write", "一", "--device", "openhaptics", "--out", "out", "--timeout", "1"]):
            done = self.run_program(*command, environment=new)
            self.assertEqual(done.stderr.count("needs calibration: put the pen into the inkwell\n"), 1, done.stderr)

    def test_what_the_vendors_library_prints_does_not_mix_with_the_results(self):
        library = os.environ.get("CALLIGRAPHY_HELD_LIBHD")
        if not library:
            self.skipTest("built without the backend for openhaptics")
        loud = {"CALLIGRAPHY_LIBHD": library, "STAND_IN_BANNER": "welcome"}
        for command in (["devices", "--json"],
                        ["write", "一", "--device", "openhaptics", "--out", "out", "--timeout", "1", "--json"]):
            done = self.run_program(*command, environment=loud)
            json.loads(done.stdout)
            self.assertEqual(done.stderr.count("welcome\n"), 2)

    def test_warnings_are_told_before_the_force(self):
        library = os.environ.get("CALLIGRAPHY_HELD_LIBHD")
        if not library:
            self.skipTest("built without the backend for openhaptics")
        done = self.run_program("write", "十", "--device", "openhaptics", "--out", "out", "--timeout", "6",
                                environment={"CALLIGRAPHY_LIBHD": library, "STAND_IN_TEXT": "二"})
        before, hint, _ = done.stderr.partition("too far from the start")
        self.assertTrue(hint, done.stderr)
        self.assertIn("Keep a hand at the device's switch", before)
