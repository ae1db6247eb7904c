import os
import re
import subprocess
import xml.etree.ElementTree as xml

from program import ProgramTest


class Strokes(ProgramTest):
    def texts(self, svg):
        root = xml.fromstring(svg)
        return [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")]

    def no_chinese_font(self):
        """An environment without any font."""
        (self.directory / "fonts.conf").write_text("<fontconfig/>")
        return {"FONTCONFIG_FILE": str(self.directory / "fonts.conf")}

    def test_all_39_typical_strokes_are_drawn_with_number_and_names(self):
        done = self.run_program("strokes", "--out", "strokes.svg")
        self.assertEqual(self.files(), ["strokes.svg"])
        texts = self.texts((self.directory / "strokes.svg").read_bytes())
        self.assertLessEqual({str(id) for id in range(1, 40)} | {"héng", "shù", "héngzhéwāngōu"}, set(texts))
        if "Chinese" not in done.stderr:
            self.assertEqual(done.stderr, "")
            self.assertLessEqual({"横", "竖", "横折弯钩"}, set(texts))

    def test_a_key_tells_what_the_marks_and_the_letters_mean(self):
        told = {"start", "direction", "end", "feature point", "control point", "line", "curve", "HZWG", "BXG", "LLCLL"}
        self.assertLessEqual(told, set(self.texts(self.run_program("strokes", "-o", "-").stdout)))
        self.assertLessEqual(
            told, set(self.texts(self.run_program("strokes", "-o", "-", environment=self.no_chinese_font()).stdout)))

    def test_without_a_chinese_font_names_are_latin_and_that_is_told_once(self):
        done = self.run_program("strokes", "-o", "-", environment=self.no_chinese_font())
        self.assertRegex(done.stderr, r"\Acalligraphy: [^\n]*Chinese[^\n]*font[^\n]*\n\Z")
        self.assertNotRegex(done.stdout, "[\u2e80-\uffff]")
        self.assertIn("héngzhéwāngōu", self.texts(done.stdout))

    def test_strokes_are_filled_as_ink_or_drawn_as_lines(self):
        ink = self.run_program("strokes", "-o", "-").stdout
        lines = self.run_program("strokes", "-o", "-", "--lines").stdout
        self.assertNotIn('stroke-width="2.5"', ink)
        self.assertEqual(lines.count('stroke-width="2.5"'), 39)

    def test_the_ending_pdf_makes_a_pdf_the_same_each_time(self):
        program = os.environ["CALLIGRAPHY_PROGRAM"]
        done = subprocess.run([program, "strokes", "-o", "strokes.PDF"], cwd=self.directory, capture_output=True)
        if b"librsvg" in done.stderr:
            self.assertEqual((done.returncode, self.files()), (1, []))
            self.skipTest("built without librsvg")
        first = (self.directory / "strokes.PDF").read_bytes()
        self.assertRegex(first, rb"\A%PDF-")
        self.assertRegex(first, rb"/MediaBox \[ 0 0 1190\.55\d* 841\.8[89]\d* \]")  # A3 in points
        self.assertEqual(len(re.findall(rb"/Type /Page\b", first)), 1)
        self.run_program("strokes", "-o", "strokes.pdf")
        self.assertEqual((self.directory / "strokes.pdf").read_bytes(), first)

    def test_standard_output_takes_the_place_of_a_file(self):
        self.run_program("strokes", "-o", "strokes.svg")
        self.assertEqual(self.run_program("strokes", "-o", "-").stdout, (self.directory / "strokes.svg").read_text())
        self.assertEqual(self.files(), ["strokes.svg"])

    def test_a_device_or_a_pipe_is_written_to(self):
        picture = self.run_program("strokes", "-o", "-").stdout
        self.run_program("strokes", "-o", "/dev/null")
        self.assertTrue(os.stat("/dev/null").st_rdev)
        self.assertEqual(self.run_program("strokes", "-o", "/dev/stdout").stdout, picture)
        self.assertEqual(self.files(), [])
        os.mkfifo(self.directory / "pipe")
        self.assert_refused(1, ["strokes", "-o", "pipe"], "pipe", "no program reads")
        (self.directory / "directory").mkdir()
        self.assert_refused(1, ["strokes", "-o", "directory"], "directory", "not a regular file")

    def test_an_unwritable_output_file_is_named(self):
        self.assert_refused(1, ["strokes", "--out", "none/strokes.svg"], "none/strokes.svg")
        self.assert_refused(2, ["strokes"], "--out")
        self.assert_refused(2, ["strokes", "--out", ""], "--out")
