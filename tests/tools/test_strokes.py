import os
import xml.etree.ElementTree as xml

from program import ProgramTest


class Strokes(ProgramTest):
    def test_all_39_typical_strokes_are_drawn_with_id_and_name(self):
        self.run_program("strokes", "--out", "strokes.svg")
        self.assertEqual(self.files(), ["strokes.svg"])
        root = xml.parse(self.directory / "strokes.svg").getroot()
        texts = " ".join("".join(element.itertext()) for element in root.iter("{http://www.w3.org/2000/svg}text"))
        for id in range(1, 40):
            self.assertRegex(texts, rf"\b{id}\b")
        for name in ("横", "竖", "横折弯钩"):
            self.assertIn(name, texts)

    def test_strokes_are_filled_as_ink_or_drawn_as_lines(self):
        ink = self.run_program("strokes", "-o", "-").stdout
        lines = self.run_program("strokes", "-o", "-", "--lines").stdout
        self.assertNotIn('stroke-width="9"', ink)
        self.assertEqual(lines.count('stroke-width="9"'), 39)

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
