import gzip
import json
import os
import subprocess
from pathlib import Path

from program import ProgramTest

DATA = Path(__file__).resolve().parent.parent / "data"


class Info(ProgramTest):
    def test_the_character_of_table_3_has_its_figures(self):
        row, = json.loads(self.run_program("info", "北", "--paper-example", "--json").stdout)["text"]
        self.assertEqual(row["number_of_typical_strokes"], 5)
        self.assertEqual(row["typical_stroke_ids"], [2, 1, 10, 31, 4])
        self.assertEqual(row["number_of_control_points"], 15)
        self.assertEqual(row["strokes"][3]["elements"], "LLLL")
        self.assertEqual(row["number_of_feature_points"], 13)
        self.assertEqual(row["sequence"], [2, 1, 10, 31, 4])
        text = self.run_program("info", "--paper-example").stdout
        self.assertRegex(text, r"ID array of typical strokes +2, 1, 10, 31, 4\n")
        self.assertRegex(text, r"Number of control points +15\n")
        self.assertRegex(text, r"Number of feature points +13\n")

    def test_the_built_in_character_has_the_standard_order(self):
        row, = json.loads(self.run_program("info", "北", "--json").stdout)["text"]
        self.assertEqual(row["sequence"], [2, 1, 10, 4, 31])
        self.assertEqual(len(row["feature_points"]), 13)
        self.assertEqual(sum(len(stroke["control_points_em"]) for stroke in row["strokes"]), 17)
        self.assertEqual(row["strokes"][4]["elements"], "LCLL")

    def test_each_character_of_a_text_is_printed_once_with_its_source(self):
        text = self.run_program("info", "北永 北").stdout
        self.assertEqual(text.count("Number of typical strokes"), 2)
        for word in ("北 (U+5317)", "永 (U+6C38)", "source:", "licence:", "attribution:"):
            self.assertIn(word, text)

    def test_the_contents_and_provenance_of_a_set_file_are_printed(self):
        for name in ("version_1.set", "version_1.txt"):
            told = json.loads(self.run_program("info", str(DATA / name), "--json", "--licence-text").stdout)
            self.assertEqual((told["characters"], told["strokes"], told["alternate_orders"]), (3, 7, 1))
            self.assertEqual((told["source"], told["licence"], told["attribution"]),
                             ("Drawn for calligraphy", "MIT", "The calligraphy authors"))
            self.assertEqual(told["licence_text"], "First line\n\n and the third")
            self.assertLess(told["coordinate_error_em"], 1e-12)
            self.assertNotIn("text", told)
        told = json.loads(self.run_program("info", str(DATA / "version_1.set"), "--json").stdout)
        self.assertEqual(told["bytes"], (DATA / "version_1.set").stat().st_size)
        text = self.run_program("info", str(DATA / "version_1.set")).stdout
        self.assertRegex(text, r"Characters +3\nStrokes +7\nAlternate stroke orders +1\nBytes +\d+\n")
        self.assertIn("licence: MIT\n", text)

    def test_the_bytes_are_those_of_the_files(self):
        for names in (["version_1.set"], ["version_1.txt"], ["version_1.txt", "version_1.set"]):
            files = [DATA / name for name in names]
            bytes = sum(file.stat().st_size for file in files)
            layers = [word for file in files for word in ("--characters", str(file))]
            told = json.loads(self.run_program("info", *layers, "--json").stdout)
            self.assertEqual(told["bytes"], bytes)
            self.assertAlmostEqual(told["bytes_per_character"], bytes / 3)
            self.assertRegex(self.run_program("info", *layers).stdout, rf"\nBytes +{bytes}\n")
        self.assertIsNone(json.loads(self.run_program("info", "永", "--json").stdout)["bytes"])

    def test_the_stroke_orders_of_a_character_are_listed(self):
        file = str(DATA / "version_1.set")
        for asked in ([], ["--order", "Table 3"]):
            text = self.run_program("info", file, "北", *asked).stdout
            self.assertRegex(text, r'\n  Stroke orders \(--order\) +the standard one, "Table 3"\n')
        self.assertNotIn("Stroke orders", self.run_program("info", file, "一").stdout)

    def test_the_characters_with_ink_are_counted(self):
        for name, count in (("version_4.set", 2), ("version_4.txt", 2), ("version_2.set", 0)):
            file = str(DATA / name)
            self.assertEqual(json.loads(self.run_program("info", file, "--json").stdout)["characters_with_ink"], count)
            text = self.run_program("info", file).stdout
            self.assertEqual("Characters with ink" in text, count > 0)
        self.assertRegex(self.run_program("info", str(DATA / "version_4.set")).stdout, r"\nCharacters with ink +2\n")

    def test_a_text_after_the_file_shows_its_characters(self):
        told = json.loads(self.run_program("info", str(DATA / "version_1.set"), "北一北", "--json").stdout)
        self.assertEqual([row["character"] for row in told["text"]], ["北", "一"])
        self.assertEqual(told["text"][0]["sequence"], [2, 1, 10, 4, 31])
        self.assertEqual(told["text"][0]["orders"], ["", "Table 3"])
        self.assertEqual(told["text"][0]["strokes"][0]["control_points_em"], [[0.35, 0.8], [0.35, 0.295]])
        self.assertEqual(told["characters"], 3)
        row, = json.loads(self.run_program("info", str(DATA / "version_1.set"), "北", "--order", "Table 3",
                                           "--json").stdout)["text"]
        self.assertEqual(row["sequence"], [2, 1, 10, 31, 4])

    def test_a_character_is_read_as_the_one_it_means_and_the_program_says_so(self):
        done = self.run_program("info", "\u2f00\u200b\u5317\ufe00\u4e00", "--json")
        self.assertEqual([row["character"] for row in json.loads(done.stdout)["text"]], ["一", "北"])
        self.assertIn("\u2f00 (U+2F00) is read as 一 (U+4E00)", done.stderr)
        self.assertIn("北 (U+5317) is read without its variation selector, U+FE00", done.stderr)

    def test_the_first_argument_is_a_file_if_one_exists(self):
        (self.directory / "北").write_bytes((DATA / "version_1.set").read_bytes())
        self.assertEqual(json.loads(self.run_program("info", "北", "--json").stdout)["characters"], 3)
        told = json.loads(self.run_program("info", "北", "北", "--json").stdout)
        self.assertEqual((told["characters"], len(told["text"])), (3, 1))

    def test_a_character_is_taken_from_the_first_set_that_has_it(self):
        (self.directory / "mine.txt").write_text("calligraphy characters 2\nsource mine\n\n"
                                                 "character 一\nstroke 1 0.1,0.5 0.9,0.5\n")
        arguments = ["info", "一北", "--characters", "mine.txt", "--characters", str(DATA / "version_1.set"), "--json"]
        told = json.loads(self.run_program(*arguments).stdout)
        self.assertEqual([row["source"] for row in told["text"]], ["mine", "Drawn for calligraphy"])
        self.assertEqual(told["characters"], 3)

    def test_characters_of_hanzi_writer_data_are_printed(self):
        row, = json.loads(self.run_program("info", "北", "--json", "--characters", self.data_directory()).stdout)["text"]
        self.assertEqual(row["number_of_typical_strokes"], 5)
        self.assertIn("Arphic", row["licence"])

    def test_version_and_help_succeed(self):
        self.assertRegex(self.run_program("--version").stdout, r"\Acalligraphy \d+\.\d+\.\d+\n\Z")
        for command in ([], ["write"], ["strokes"], ["info"], ["tradeoff"]):
            self.assertIn("--help", self.run_program(*command, "--help").stdout)

    def test_a_full_disk_is_an_error(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([os.environ["CALLIGRAPHY_PROGRAM"], "info", "北"], stdout=full,
                                  stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.decode(), r"\Acalligraphy: [^\n]+\n\Z")


class Refusals(ProgramTest):
    def test_errors_are_one_line_that_names_the_cause(self):
        self.assert_refused(2, ["info"], "TEXT")
        self.assert_refused(2, ["info", ""], "TEXT")
        self.assert_refused(2, ["info", b"\xff"], "byte 0")
        self.assert_refused(2, ["info", "永", "--paper-example"], "永")
        self.assert_refused(2, ["info", "--paper-example", "--characters", "x"], "--characters")
        self.assert_refused(1, ["info", "\u9f98"], "U+9F98")
        self.assert_refused(1, ["info", "北", "--characters", "none"], "none")
        self.assert_refused(1, ["info", "none.set", "北"], "calligraphy: none.set: no such file\n")
        self.assert_refused(1, ["info", "hanzi", "北"], "calligraphy: hanzi: no such file\n")
        self.assert_refused(2, ["info", "永", "北"], "unexpected argument 北; quote words that belong together\n")
        self.assert_refused(1, ["info", str(DATA / "version_1.set"), "永"], "version_1.set", "永")
        self.assert_refused(1, ["info", "none.set"], "none.set: no such file\n")
        self.assert_refused(1, ["info", "hanzi"], "hanzi: no such file, and as TEXT not in the built-in set", "h (U+0068)")
        self.assert_refused(1, ["info", str(DATA / "version_1.set"), "一", "--order", "Table 3"], "一", "Table 3")
        self.assert_refused(1, ["info", str(DATA / "version_1.set"), "北", "--order", "foo"],
                            'no stroke order "foo"', 'it has: the standard one, "Table 3"\n')
        self.assert_refused(1, ["info", "永", "--order", "foo"], 'calligraphy: 永 (U+6C38) has no stroke order "foo" in the'
                            ' built-in set (see --characters); it has: the standard one\n')
        self.assert_refused(2, ["info", str(DATA / "version_1.set"), ""], "TEXT")

    def test_options_that_do_not_apply_are_refused(self):
        file = str(DATA / "version_1.set")
        self.assert_refused(2, ["info", file, "--order", "Table 3"], "--order: applies only to TEXT")
        self.assert_refused(2, ["info", file, "北", "--characters", file], "--characters: cannot be combined with FILE")
        self.assert_refused(2, ["info", file, "--characters", file], "--characters: cannot be combined with FILE")
        self.assert_refused(2, ["info", "--paper-example", "--order", "x"], "--paper-example: ", "--order")

    def test_a_file_that_is_no_text_is_told_in_printable_words(self):
        tar = bytes(257) + b"ustar" + bytes(300)
        for name, content, kind in (("x.tgz", gzip.compress(b"text"), "a compressed archive (gzip)"),
                                    ("x.zip", b"PK\x03\x04\0\0", "a compressed archive (zip)"),
                                    ("x.tar", tar, "an archive (tar)")):
            (self.directory / name).write_bytes(content)
            self.assert_refused(1, ["info", name], f"{name}: is {kind}", "`calligraphy import` converts collections")
            self.assert_refused(1, ["info", "永", "--characters", name], f"{name}: ")  # a source, but damaged
        (self.directory / "binary").write_bytes(b"\0\x9b1m\xff" + "永\u009b".encode() + b"\x7f")
        self.assert_refused(1, ["info", "binary"],
                            "binary:1: expected 'calligraphy characters 2' (or 1, or 4 with ink), found '??1m?永??'\n")
        (self.directory / "long").write_text("ab" + 30 * "永")
        self.assert_refused(1, ["info", "long"], "found 'ab" + 19 * "永" + "...'\n")

    def test_a_file_without_characters_is_an_error_as_it_is_for_validate(self):
        (self.directory / "head.txt").write_text("calligraphy characters 2\nsource mine\n")
        for command in ("info", "validate"):
            self.assert_refused(1, [command, "head.txt"], "calligraphy: head.txt: contains no character\n")

    def test_a_damaged_set_file_is_named(self):
        whole = (DATA / "version_1.set").read_bytes()
        for name, content, words in (("cut.set", whole[:-1], ["truncated"]),
                                     ("index.set", whole[:70] + b"x" + whole[71:], ["checksum"]),
                                     ("group.set", whole[:-1] + bytes([whole[-1] ^ 1]), ["U+20000", "checksum"]),
                                     ("newer.set", whole[:8] + b"\5" + whole[9:], ["newer version"]),
                                     ("picture.set", b"\x89PNG\r\n\x1a\n", ["not a set file"])):
            with self.subTest(name=name):
                (self.directory / name).write_bytes(content)
                self.assert_refused(1, ["info", name], name, *words)
                self.assert_refused(1, ["write", "𠀀", "--characters", name, "--out", "out"], name, *words)
        self.assert_refused(1, ["info", "."], "regular file")
