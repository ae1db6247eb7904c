import csv
import gzip
import json
import os
import resource
import shutil
import signal
import subprocess
import time
import unittest

from program import ProgramTest

PROGRAM = os.environ["CALLIGRAPHY_PROGRAM"]


class Recordings(ProgramTest):
    """What came in is kept as it comes, in little space, and the forces are made again from it."""

    def replayed(self, *arguments, code=0):
        return json.loads(self.run_program("replay", *arguments, "--json", code=code).stdout)

    def test_a_run_is_made_again_to_the_last_bit(self):
        for options in ([], ["--page", "desk", "--motion-scale", "2", "--renderer", "everything", "--device", "omni"],
                        ["--rules", "wang2006", "--rate", "500"]):
            with self.subTest(options=options):
                self.run_program("write", "十人", "--out", "first", "--ticks", "--force", *options)
                again = self.replayed("first", "--out", "again", "--ticks", "--force")
                self.assertEqual([(each["mode"], each["complete"], each["same_forces"]) for each in again["recordings"]],
                                 [("force", True, True), ("vision", True, True)])
                ours = ("tick_ns_p50", "tick_ns_p999", "seed")  # were measured or drawn then
                results = [[{key: value for key, value in row.items() if key not in ours} for row in rows]
                           for rows in (self.summary("first"), again["results"])]
                self.assertEqual(results[0], results[1])
                for name in ("page-1-force-1-ticks.csv", "page-1-vision-1-ticks.csv", "strokes.csv"):
                    tables = []
                    for run in ("first", "again"):
                        with open(self.directory / run / name, newline="") as file:
                            tables.append([{key: value for key, value in row.items() if key not in ("tick_ns", "seed")}
                                           for row in csv.DictReader(file)])
                    self.assertGreater(len(tables[0]), 3)
                    self.assertEqual(tables[0], tables[1])

    def test_pages_have_the_places_that_they_had_in_the_run(self):
        """Also the tenth page, whose name sorts before that of the second, and pages with the same characters."""
        self.run_program("write", "一" * 55, "--mode", "force", "--writer", "skilled", "--device", "omni", "--out", "out")
        places = [[(row["position"], row["repetition"], row["rms_error_mm"]) for row in rows]
                  for rows in (self.summary(), self.replayed("out")["results"])]
        self.assertEqual(places[0], places[1])

    def test_recordings_are_never_overwritten(self):
        run = ["write", "一", "--out", "out", "--mode", "force"]
        self.run_program(*run)
        before = self.contents()
        for arguments in (["out"], ["out/page-1-force-1.recording.gz"], ["./out/../out"]):
            self.assert_refused(2, ["replay", *arguments, "--out", "out", "--force"],
                                "--out: out has the recordings that are replayed")
        self.assertEqual(self.contents(), before)
        (self.directory / "out/summary.json").unlink()
        for force in ([], ["--force"]):
            self.assert_refused(1, [*run, *force],
                                "out/page-1-force-1.recording.gz: is there, a recording of no run: choose another")
        (self.directory / "out/page-1-force-1.recording.gz").write_bytes(b"")
        self.assert_refused(1, ["replay", "out", "--out", "other"], "out: there is no recording in this directory")
        self.assertFalse((self.directory / "other").exists())

    def test_forces_that_are_not_those_of_the_session_are_told(self):
        self.run_program("write", "一", "--out", "out", "--mode", "force")
        path = self.directory / "out/page-1-force-1.recording.gz"
        text = gzip.decompress(path.read_bytes())
        (self.directory / "plain").write_bytes(text)
        self.assertIn("; the same forces to the last bit\n", self.run_program("replay", "plain").stdout)
        stiffer = text.replace(b"\noption guidance.stiffness 600\n", b"\noption guidance.stiffness 599\n")
        self.assertNotEqual(stiffer, text)
        (self.directory / "changed").write_bytes(stiffer)
        done = self.run_program("replay", "changed", code=1)
        self.assertIn("; other forces than in the session\n", done.stdout)
        self.assertIn("the forces of 1 recording are not those of the session", done.stderr)

    def test_ten_characters_take_two_megabytes_at_most_and_their_tables_count_time_from_the_first_tick(self):
        self.run_program("write", "永和北京中国书法大学", "--out", "out")
        files = list((self.directory / "out").iterdir())
        self.assertLessEqual(sum(file.stat().st_size for file in files), 2_000_000)
        self.assertLess(sum(file.stat().st_size for file in files if file.name.endswith(".gz")), 300_000)
        with open(self.directory / "out/strokes.csv", newline="") as file:
            strokes = list(csv.DictReader(file))
        self.assertEqual(len(strokes), sum(row["strokes"] for row in self.summary()))
        first = [row for row in strokes if (row["position"], row["mode"]) == ("1", "force")]
        begins = [float(row["begin_s"]) for row in first]
        self.assertTrue(0.3 < begins[0] < 3.0 and begins == sorted(begins), begins)
        self.assertTrue(all(float(row["end_s"]) > float(row["begin_s"]) for row in first))

    def test_what_a_person_wrote_until_the_program_was_killed_is_there(self):
        done = self.run_on_emulated_phantom("write", "永", "--device", "phantom", "--out", "out", code=137,
                                            hand=["--write", "永", "--signal", str(int(signal.SIGKILL))])
        self.assertIn("page-1-force-1.recording.gz.part", {path.name for path in (self.directory / "out").iterdir()},
                      done.stderr)
        kept, = self.replayed("out")["recordings"]
        self.assertIs(kept["complete"], False)
        self.assertGreater(kept["ticks"], 0)
        self.assertIn("out/summary.json: already there, from an unfinished run", self.run_program(
            "write", "永", "--out", "out", code=1).stderr)

    def test_a_disk_that_fills_ends_the_run_with_everything_up_to_then(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

        text = "永北国书学" * 3
        done = subprocess.run([PROGRAM, "write", text, "--mode", "force", "--writer", "skilled", "--out", "out"],
                              cwd=self.directory, preexec_fn=limit, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("out/page-1-force-1.recording.gz.part: cannot be written: File too large\n", done.stderr)
        kept, = self.replayed("out")["recordings"]
        self.assertGreater(kept["ticks"], 10_000)
        self.assertIs(self.record()["finished"], False)

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is missing")
    def test_a_picture_that_fails_is_a_warning_and_takes_nothing_with_it(self):
        (self.directory / "gnuplot").write_text("#!/bin/sh\n[ \"$1\" = --version ] && exit 0\necho broken >&2\nexit 1\n")
        (self.directory / "gnuplot").chmod(0o755)
        done = self.run_program("write", "十", "--out", "out",
                                environment={"PATH": f"{self.directory}:{os.environ['PATH']}"})
        self.assertRegex(done.stderr, r"warning: 01-十-force-plot\.svg is missing: .*broken")
        self.assertRegex(self.record()["warnings"][0], r"01-十-force-plot\.svg is missing: .*broken")
        self.assertEqual({path.name for path in (self.directory / "out").iterdir()},
                         {"summary.json", "strokes.csv", "page-1-force-1.recording.gz", "page-1-vision-1.recording.gz",
                          "01-十-force-writing.svg", "01-十-vision-writing.svg"})
        self.assertTrue(self.record()["finished"])

    def test_options_of_traces_are_refused_for_recordings_and_the_other_way_round(self):
        self.run_program("write", "一", "--out", "out", "--mode", "force")
        (self.directory / "pens.txt").write_text("C 一 4E00 test 100 1\nS 2 10 50 0 90 50 500\n")
        (self.directory / "empty").mkdir()
        self.assert_refused(2, ["replay", "out", "--device", "omni"], "--device: applies only to pen traces")
        self.assert_refused(2, ["replay", "out", "--ticks"], "--ticks: needs --out DIR")
        self.assert_refused(2, ["replay", "pens.txt", "--ticks"], "--ticks: applies only to recordings")
        self.assert_refused(1, ["replay", "empty"], "empty: there is no recording in this directory")

    def test_compressed_traces_are_read(self):
        text = "C 一 4E00 test 100 1\nS 2 10 50 0 90 50 500\n"
        (self.directory / "pens.txt").write_text(text)
        (self.directory / "pens.gz").write_bytes(gzip.compress(text.encode()))
        self.assertEqual(self.replayed("pens.gz")["traces"], self.replayed("pens.txt")["traces"])
        (self.directory / "cut.gz").write_bytes(gzip.compress(text.encode())[:-4])
        self.assert_refused(1, ["replay", "cut.gz"], "cut.gz: the file is truncated")
        (self.directory / "two.gz").write_bytes(gzip.compress(text.encode()) + gzip.compress(text.encode()))
        self.assertEqual(len(self.replayed("two.gz")["traces"]), 2)
        (self.directory / "broken.gz").write_bytes(gzip.compress(text.encode())[:-9] + b"x" * 9)
        self.assert_refused(1, ["replay", "broken.gz"], "broken.gz: the compressed data is damaged")
