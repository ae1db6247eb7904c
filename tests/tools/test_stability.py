import json
import shutil
import xml.etree.ElementTree as xml

from program import ProgramTest

# Period [s], damping [N s/m], delay [ticks], wall damping [N s/m], grip, critical stiffness [N/m]: the project's
# reference table, 45 g with an exact zero-order hold.
CRITICAL = [
    (10e-3, 0.5, 0, 0, None, 101.9),
    (1e-3, 0.05, 0, 0, None, 100.0),
    (1e-3, 0.1, 0, 0, None, 200.1),
    (1e-3, 0.5, 0, 0, None, 1001.9),
    (1e-3, 1, 0, 0, None, 2007),
    (1e-3, 2, 0, 0, None, 4030),
    (50e-6, 0.5, 0, 0, None, 20001.9),
    (1e-3, 0.5, 1, 0, None, 334.4),
    (1e-3, 0.5, 2, 0, None, 201.0),
    (1e-3, 0.5, 5, 0, None, 91.8),
    (1e-3, 0.1, 0, 0.2, None, 598),
    (1e-3, 0.1, 0, 0.5, None, 1187),
    (1e-3, 0.1, 0, 1, None, 2153),
    (1e-3, 0.1, 0, 2, None, 4019),
    (1e-3, 0.1, 0, 5, None, 9131),
    (1e-3, 0.1, 0, 10, None, 16170),
    (1e-3, 0.1, 0, 20, None, 25606),
    (1e-3, 0.1, 0, 30, None, 30139),
    (1e-3, 0.05, 0, 0, "0.05,1,100", 2104),
    (1e-3, 0.05, 0, 0, "0.1,3,300", 6123),
    (1e-3, 0.05, 0, 0, "0.15,5,500", 10146),
]
POINT = ["--mass", "0.045", "--damping", "0.5"]
LINE = {"loop", "critical_stiffness_N_per_m", "passive_stiffness_N_per_m", "quantised_stiffness_N_per_m",
        "approximate_stiffness_N_per_m", "max_stable_N_per_m", "controlled_max_stable_N_per_m",
        "controlled_max_stable_below_peak_force_N_per_m", "stable_at", "controlled_stable_at"}


class Point(ProgramTest):
    def point(self, *arguments):
        return json.loads(self.run_program("stability", "--json", *arguments).stdout)

    def test_every_figure_of_the_reference_is_printed_within_one_percent(self):
        for period, damping, delay, wall_damping, grip, critical in CRITICAL:
            arguments = ["--mass", "0.045", "--damping", str(damping), "--rate", str(round(1 / period)), "--delay",
                         str(delay), "--wall-damping", str(wall_damping)] + (["--grip", grip] if grip else [])
            with self.subTest(arguments=arguments):
                own = self.point(*arguments)
                self.assertAlmostEqual(own["critical_stiffness_N_per_m"] / critical, 1.0, delta=0.01)
                passive = max(0.0, 2 * (damping - wall_damping) / (period * (2 * delay + 1)))
                self.assertAlmostEqual(own["passive_stiffness_N_per_m"], passive, delta=1e-6 * passive)

    def test_every_bound_comes_with_its_formula_and_validity(self):
        own = self.point(*POINT, "--delay", "1")
        self.assertEqual(set(own["bounds"]), {"stable", "passive", "quantised", "approximate"})
        for bound in own["bounds"].values():
            self.assertIn("K", bound["formula"])
            self.assertTrue(bound["validity"])
        self.assertEqual(own["bounds"]["stable"]["stiffness_N_per_m"], own["critical_stiffness_N_per_m"])
        self.assertEqual(own["loop"]["delay_ticks"], 1)

    def test_a_grip_is_given_by_name_or_by_three_numbers(self):
        named = self.point(*POINT, "--grip", "normal")
        self.assertEqual(named, self.point(*POINT, "--grip", "0.1,3,300"))
        self.assertNotEqual(named, self.point(*POINT, "--grip", "firm"))

    def test_a_device_supplies_defaults_that_options_override(self):
        own = self.point("--device", "omni")
        self.assertEqual(own, self.point("--device", "simulated:omni"))
        self.assertEqual(own["loop"]["mass_kg"], 0.045)
        self.assertEqual(own["loop"]["coulomb_friction_N"], 0.26)
        self.assertEqual(own["passive_stiffness_N_per_m"], 200.0)
        stiffer = self.point("--device", "omni", "--damping", "10")
        self.assertAlmostEqual(stiffer["quantised_stiffness_N_per_m"], 9454.5, places=0)
        desktop = self.point("--device", "desktop", "--damping", "10")
        self.assertAlmostEqual(desktop["quantised_stiffness_N_per_m"], 5217.4, places=0)

    def test_the_table_names_units_bounds_and_formulas(self):
        text = self.run_program("stability", *POINT).stdout
        for word in ("[N/m]", "passive", "quantised", "stable", "approximate", "b > K T (2 d + 1) / 2 + |B|", "1001.9",
                     "no grip"):
            self.assertIn(word, text)


class Map(ProgramTest):
    def test_the_map_is_printed_and_plotted(self):
        done = self.run_program("stability", "--quick", "--out", "deep/out")
        self.assertEqual(done.stderr, "", "no progress bar in a pipe")
        for word in ("[N/m]", "passive", "controlled", "servo rate [kHz]", "delay [ticks]", "grip"):
            self.assertIn(word, done.stdout)
        out = self.directory / "deep" / "out"
        expected = {"stability.json"} | ({"stability.svg"} if shutil.which("gnuplot") else set())
        self.assertEqual({path.name for path in out.iterdir()}, expected)
        for picture in out.glob("*.svg"):
            self.assertEqual(xml.parse(picture).getroot().tag, "{http://www.w3.org/2000/svg}svg")
            self.assertLess(picture.stat().st_size, 150000)
        stability = json.loads((out / "stability.json").read_text())
        self.assertEqual([sweep["name"] for sweep in stability["sweeps"]],
                         ["damping", "rate", "delay", "wall_damping", "encoder_step", "grip"])
        for sweep in stability["sweeps"]:
            for line in sweep["lines"]:
                self.assertEqual(set(line), LINE | {"value"})
                self.assertEqual(len(line["stable_at"]), len(stability["stiffnesses_N_per_m"]))
        damping = {line["value"]: line for line in stability["sweeps"][0]["lines"]}
        line = damping["0.1"]
        self.assertAlmostEqual(line["max_stable_N_per_m"] / 200.1, 1.0, delta=0.05)
        self.assertGreater(line["controlled_max_stable_below_peak_force_N_per_m"],
                           10 * line["max_stable_N_per_m"])


class Refusals(ProgramTest):
    def test_usage_errors_are_one_line_and_exit_with_two(self):
        for arguments, words in (
                (["--mass", "0.045"], ["--damping"]),
                (["--damping", "0.5"], ["--mass"]),
                (["--rate", "1000"], ["--mass"]),
                ([*POINT, "--rate", "0"], ["--rate: 0: expected a number from 1 to 1000000"]),
                (["--mass", "0", "--damping", "1"], ["--mass: 0: expected a number from 1e-09 to"]),
                (["--mass", "-1", "--damping", "1"], ["--mass", "-1"]),
                (["--mass", "nan", "--damping", "1"], ["--mass", "nan"]),
                ([*POINT, "--delay", "1.5"], ["--delay", "1.5"]),
                ([*POINT, "--delay", "1001"], ["--delay", "1001"]),
                ([*POINT, "--grip", "tight"], ["--grip: tight: expected soft, normal"]),
                ([*POINT, "--grip", "1,2"], ["--grip", "1,2"]),
                ([*POINT, "--grip", "1,2,3,4"], ["--grip", "1,2,3,4"]),
                ([*POINT, "--grip", "0.1,-3,300"], ["grip.damping = -3"]),
                ([*POINT, "--grip", "0.1,nan,300"], ["grip.damping = nan"]),
                (["--device", "none"], ["none", "omni"]),
                ([*POINT, "--out", "out"], ["--out"]),
                ([*POINT, "--quick"], ["--quick"]),
                (["--out", ""], ["--out"]),
                (["--unknown"], ["--unknown"])):
            with self.subTest(arguments=arguments):
                self.assert_refused(2, ["stability", *arguments], *words)

    def test_an_unwritable_directory_is_named_before_the_run(self):
        (self.directory / "file").write_text("keep")
        self.assert_refused(1, ["stability", "--out", "file"], "file")
        self.assertEqual((self.directory / "file").read_text(), "keep")

    def test_an_interrupted_map_leaves_no_directory(self):
        self.assert_interrupted_leaves_nothing("stability")
