import json
import math
import os
import signal
import shutil
import subprocess
import xml.etree.ElementTree as xml

from program import ProgramTest

METHODS = {"exact", "tracked", "sampled", "wang2006"}
COST = {"queries", "ns_p50", "ns_p90", "batch_ns_p50", "error_p50", "error_p99", "error_max", "wrong_branches"}
RATE = {"rate_Hz", "paper_stiffness_N_m", "stable", "max_penetration_mm", "path_error_rms_mm", "max_force_step_N",
        "strokes_written", "max_stable_stiffness_N_m", "max_stable_stiffness_without_force_rate_limit_N_m",
        "critical_stiffness_held_N_m", "critical_stiffness_free_N_m", "hard_paper"}
WIDTH = {"bits", "step_em", "max_error_em", "rms_error_em", "bytes_per_character"}


def without_times(value):
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items() if "ns_p" not in k}
    return [without_times(each) for each in value] if isinstance(value, list) else value


class Trade(ProgramTest):
    def test_ink_is_measured_against_the_outlines_of_a_source(self):
        (self.directory / "data").mkdir()
        outline = "M 100 250 L 500 258 L 900 240 L 900 350 L 100 300 Z"
        drawing = {"strokes": [outline], "medians": [[[110, 275], [890, 295]]]}
        (self.directory / "data/大.json").write_text(json.dumps(drawing))
        ink = self.tradeoff("大", "--ink", "data")["ink"]
        self.assertEqual(set(ink), {"typical", "half_widths", "full"})
        self.assertEqual(ink["typical"]["bytes_per_character"], 0)
        self.assertGreater(ink["full"]["iou_mean"], 0.9)
        (self.directory / "data/大.json").write_text(json.dumps({"medians": drawing["medians"]}))
        self.assert_refused(1, ["tradeoff", "--quick", "大", "--ink", "data"], "--ink", "no outlines")
        self.run_program("import", "data", "-o", "own.set")
        self.assert_refused(1, ["tradeoff", "--quick", "大", "--ink", "own.set"], "--ink", "own.set is no source")

    def tradeoff(self, *arguments):
        return json.loads(self.run_program("tradeoff", "--quick", "--json", *arguments).stdout)

    def test_the_json_has_every_method_rate_and_width(self):
        tradeoff = self.tradeoff()
        self.assertEqual({row["method"] for row in tradeoff["nearest_point"]}, METHODS)
        for row in tradeoff["nearest_point"]:
            for queries in ("real_strokes", "hard", "ticks"):
                self.assertEqual(set(row[queries]), COST)
                self.assertGreater(row[queries]["ns_p50"], 0.0)
                self.assertGreaterEqual(row[queries]["ns_p90"], row[queries]["ns_p50"])
                self.assertTrue(0.0 <= row[queries]["wrong_branches"] <= 1.0)
            self.assertEqual(len(row["workloads"]), 19)
            for feel in ("along_strokes", "along_arcs"):
                self.assertGreater(row[feel]["max_force_step_N"], 0.0)
            self.assertEqual("samples" in row, row["method"] == "sampled")
        self.assertEqual([row["rate_Hz"] for row in tradeoff["servo_rate"]], [250, 1000, 4000])
        for row in tradeoff["servo_rate"]:
            self.assertEqual(set(row), RATE)
            self.assertTrue(row["stable"])
        self.assertEqual([row["bits"] for row in tradeoff["coordinate_width"]], list(range(4, 17)))
        for row in tradeoff["coordinate_width"]:
            self.assertEqual(set(row), WIDTH)
            self.assertLessEqual(row["max_error_em"], row["step_em"] / math.sqrt(2.0) * (1 + 1e-9))

    def test_everything_but_the_times_is_reproducible(self):
        first, second = self.tradeoff("永", "--seed", "3"), self.tradeoff("永", "--seed", "3")
        self.assertEqual(without_times(first), without_times(second))
        self.assertNotEqual(without_times(first), without_times(self.tradeoff("永", "--seed", "4")))

    def test_the_tables_have_units_and_a_row_for_each_entry(self):
        done = self.run_program("tradeoff", "--quick", "--out", "out")
        for word in ("[ns]", "[%]", "[N/tick]", "[Hz]", "[mm]", "[N/m]", "[% em]"):
            self.assertIn(word, done.stdout)
        tradeoff = json.loads((self.directory / "out" / "tradeoff.json").read_text())
        lines = done.stdout.splitlines()
        for row in tradeoff["nearest_point"]:
            own = [line for line in lines if line.startswith(row["setting"] + " ")]
            self.assertEqual(len(own), 3, row["setting"])
            self.assertEqual(float(own[0].split()[-1]), round(100 * row["real_strokes"]["wrong_branches"], 3))
            self.assertEqual(float(own[1].split()[-1]), round(100 * row["hard"]["wrong_branches"], 3))
            self.assertAlmostEqual(float(own[2].split()[-2]), row["along_arcs"]["max_force_step_N"], places=3)

    def test_all_pictures_are_written_and_well_formed(self):
        done = self.run_program("tradeoff", "--quick", "--out", "deep/out")
        self.assertNotIn("%\n", done.stderr)
        expected = {"tradeoff.json"} | {f"field-{name}.svg" for name in ("bend", "corner", "parallel", "crossed")}
        if shutil.which("gnuplot"):
            expected |= {"tradeoff.svg", "servo_rate.svg", "coordinate_width.svg"}
            self.assertEqual(done.stderr, "", "no progress bar in a pipe")
        out = self.directory / "deep" / "out"
        self.assertEqual({path.name for path in out.iterdir()}, expected)
        for picture in out.glob("*.svg"):
            self.assertEqual(xml.parse(picture).getroot().tag, "{http://www.w3.org/2000/svg}svg")
            self.assertLess(picture.stat().st_size, 150000)

    def test_the_number_of_queries_is_an_option(self):
        done = self.run_program("tradeoff", "永", "--quick", "--queries", "50")
        self.assertIn("real strokes, 100 queries", done.stdout)
        self.assertIn("hard workloads, 850 queries", done.stdout)

    def test_characters_of_hanzi_writer_data_are_measured(self):
        tradeoff = self.tradeoff("永和九年", "--characters", self.data_directory())
        self.assertEqual(tradeoff["characters"], "永和九年")
        for row in tradeoff["nearest_point"]:
            if row["method"] in ("exact", "tracked"):
                self.assertEqual(row["real_strokes"]["wrong_branches"], 0.0)


class Refusals(ProgramTest):
    def test_usage_errors_are_one_line_and_exit_with_two(self):
        for arguments, words in (
                ([""], ["TEXT"]),
                ([b"\xff"], ["byte 0"]),
                (["--out", ""], ["--out"]),
                (["--queries", "0"], ["--queries", "0"]),
                (["--queries", "x"], ["--queries", "x"]),
                (["--queries", "1e3"], ["--queries"]),
                (["--seed", "-1"], ["--seed", "-1"]),
                (["永", "北"], ["北"]),
                (["--unknown"], ["--unknown"])):
            with self.subTest(arguments=arguments):
                self.assert_refused(2, ["tradeoff", *arguments], *words)

    def test_unusable_input_is_named(self):
        self.assert_refused(1, ["tradeoff", "\u9f98", "--out", "out"], "U+9F98")
        self.assert_refused(1, ["tradeoff", "永", "--characters", "none"], "none")
        self.assert_refused(1, ["tradeoff", "一", "--out", "out"], "curve")

    def test_an_unwritable_directory_is_named_before_the_run(self):
        (self.directory / "file").write_text("keep")
        self.assert_refused(1, ["tradeoff", "--out", "file"], "file")
        self.assert_refused(1, ["tradeoff", "--out", "/proc/calligraphy/out"], "/proc/calligraphy/out")
        self.assertEqual((self.directory / "file").read_text(), "keep")

    def test_an_interrupted_tradeoff_leaves_no_directory(self):
        self.assert_interrupted_leaves_nothing("tradeoff")

    def test_an_interrupt_during_gnuplot_interrupts_the_program(self):
        """A terminal sends it to both: this gnuplot sends it to its parent and to itself."""
        (self.directory / "bin").mkdir()
        gnuplot = self.directory / "bin/gnuplot"
        gnuplot.write_text('#!/bin/sh\nkill -INT $PPID\nkill -INT $$\n')
        gnuplot.chmod(0o755)
        environment = {**os.environ, "PATH": f"{gnuplot.parent}:{os.environ['PATH']}"}
        done = subprocess.run([os.environ["CALLIGRAPHY_PROGRAM"], "tradeoff", "--quick", "--out", "out"],
                              cwd=self.directory, env=environment, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGINT, "calligraphy: interrupted\n"))
