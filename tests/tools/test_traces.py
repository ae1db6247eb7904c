import gzip
import json

from program import ProgramTest

SVC = "2\n1000 5000 70000 1 900 450 1023\n1400 5000 70010 1 0 900 511\n"
PAD = json.dumps([{"points": [{"x": 10, "y": 50, "time": 1700000000000, "pressure": 0.25},
                              {"x": 90, "y": 50, "time": 1700000000400, "pressure": 0.5}]},
                  {"points": [{"x": 50, "y": 10, "time": 1700000001000, "pressure": 0.75},
                              {"x": 50, "y": 90, "time": 1700000001400, "pressure": 0.5}]}])


class Traces(ProgramTest):
    def write(self, name, text):
        (self.directory / name).write_bytes(text if isinstance(text, bytes) else text.encode())

    def test_files_of_several_formats_become_one_that_can_be_replayed(self):
        self.write("十.json", PAD)
        self.write("一.svc.gz", gzip.compress(SVC.encode()))
        report = json.loads(self.run_program("traces", "十.json", "一.svc.gz", "--json", "--set", "lesson", "--notice",
                                             "CC0, by nobody", "-o", "pens.txt").stdout)
        self.assertEqual([(each["format"], each["characters"], each["strokes"], each["samples"])
                          for each in report["files"]], [("signature_pad", "十", 2, 4), ("SVC", "一", 1, 2)])
        self.assertAlmostEqual(report["files"][0]["duration_s"], 1.4)
        self.assertAlmostEqual(report["files"][1]["rate_Hz"], 100.0)
        self.assertTrue((self.directory / "pens.txt").read_text().startswith("# CC0, by nobody\nV 2\nC 十 5341 lesson "))
        traces = json.loads(self.run_program("replay", "pens.txt", "--only", "十", "--json").stdout)["traces"]
        self.assertEqual(traces[0]["remarks"], [])
        again = self.run_program("traces", "pens.txt", "-o", "-").stdout
        self.assertEqual(again, (self.directory / "pens.txt").read_text().partition("\n")[2])

    def test_the_text_names_the_characters_of_files_that_do_not(self):
        self.write("a.svc", SVC)
        self.write("b.svc", SVC)
        done = self.run_program("traces", "a.svc", "b.svc", "--text", "一二", "-o", "-")
        self.assertEqual([line.split()[1] for line in done.stdout.splitlines() if line.startswith("C")], ["一", "二"])
        self.assertIn("a.svc: y is taken to point up", done.stderr)
        self.assert_refused(2, ["traces", "a.svc", "--text", "一二", "-o", "pens.txt"], "--text", "1 character", "二")
        self.assert_refused(1, ["traces", "a.svc", "-o", "pens.txt"], "a.svc", "--text")

    def test_one_unreadable_file_writes_nothing_and_no_input_is_overwritten(self):
        self.write("一.svc", SVC)
        self.write("b.json", "[[]]")
        self.write("utf16.csv", "x,y,stroke\n1,2,1\n".encode("utf-16"))
        self.write("cut.svc.gz", gzip.compress(SVC.encode())[:-9])
        self.assert_refused(1, ["traces", "一.svc", "b.json", "-o", "pens.txt"], "b.json", "never down")
        self.assert_refused(1, ["traces", "utf16.csv", "-o", "pens.txt"], "utf16.csv", "is UTF-16, not UTF-8")
        self.assert_refused(1, ["traces", "cut.svc.gz", "-o", "pens.txt"], "cut.svc.gz")
        self.assert_refused(2, ["traces", "一.svc", "-o", "./一.svc"], "--out", "is one of the files to read")
        self.assert_refused(2, ["traces", "一.svc", "--json", "-o", "-"], "--json")
        self.assertEqual((self.directory / "一.svc").read_text(), SVC)
