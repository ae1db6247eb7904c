import json
import os
import subprocess

from program import ProgramTest


class Info(ProgramTest):
    def test_the_character_of_table_3_has_its_figures(self):
        row, = json.loads(self.run_program("info", "北", "--paper-example", "--json").stdout)
        self.assertEqual(row["number_of_typical_strokes"], 5)
        self.assertEqual(row["typical_stroke_ids"], [2, 1, 10, 31, 4])
        self.assertEqual(row["number_of_control_points"], 15)
        self.assertEqual(row["number_of_feature_points"], 13)
        self.assertEqual(row["sequence"], [2, 1, 10, 31, 4])
        text = self.run_program("info", "--paper-example").stdout
        self.assertRegex(text, r"ID array of typical strokes +2, 1, 10, 31, 4\n")
        self.assertRegex(text, r"Number of control points +15\n")
        self.assertRegex(text, r"Number of feature points +13\n")

    def test_the_built_in_character_has_the_standard_order(self):
        row, = json.loads(self.run_program("info", "北", "--json").stdout)
        self.assertEqual(row["sequence"], [2, 1, 10, 4, 31])
        self.assertEqual(len(row["feature_points"]), 13)
        self.assertEqual(sum(len(stroke["control_points_em"]) for stroke in row["strokes"]), 15)

    def test_each_character_of_a_text_is_printed_once_with_its_source(self):
        text = self.run_program("info", "北永 北").stdout
        self.assertEqual(text.count("Number of typical strokes"), 2)
        for word in ("北 (U+5317)", "永 (U+6C38)", "source:", "licence:", "attribution:"):
            self.assertIn(word, text)

    def test_a_character_that_no_one_here_drew(self):
        row, = json.loads(self.run_program("info", "北", "--json", "--characters", self.data_directory()).stdout)
        self.assertEqual(row["number_of_typical_strokes"], 5)
        self.assertIn("Arphic", row["licence"])

    def test_version_and_help_succeed(self):
        self.assertRegex(self.run_program("--version").stdout, r"\Acalligraphy \d+\.\d+\.\d+\n\Z")
        for command in ([], ["write"], ["strokes"], ["info"], ["trade"]):
            self.assertIn("--help", self.run_program(*command, "--help").stdout)

    def test_a_full_disk_is_no_success(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([os.environ["CALLIGRAPHY_PROGRAM"], "info", "北"], stdout=full,
                                  stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.decode(), r"\Acalligraphy: [^\n]+\n\Z")


class Refusals(ProgramTest):
    def test_what_cannot_be_shown_is_refused_in_one_line(self):
        self.assert_refused(2, ["info"], "TEXT")
        self.assert_refused(2, ["info", ""], "TEXT")
        self.assert_refused(2, ["info", b"\xff"], "byte 0")
        self.assert_refused(2, ["info", "永", "--paper-example"], "永")
        self.assert_refused(2, ["info", "--paper-example", "--characters", "x"], "--characters")
        self.assert_refused(1, ["info", "\u9f98"], "U+9F98")
        self.assert_refused(1, ["info", "北", "--characters", "none"], "none")
