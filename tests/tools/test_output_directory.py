import datetime
import json
import os
import re
import unittest

from program import ProgramTest


class Refusals(ProgramTest):
    def test_a_file_in_place_of_the_directory_is_told(self):
        (self.directory / "afile").write_text("")
        for out in ("afile", "afile/new", "afile/new/er"):
            self.assert_refused(1, ["write", "一", "--out", out], f"calligraphy: {out}: ",
                                "/afile is a file and not a directory\n")

    def test_a_directory_in_which_nothing_can_be_created_is_named_itself(self):
        self.assert_refused(1, ["write", "一", "--out", "/proc"], "calligraphy: /proc: the directory is not writable: ")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_a_directory_without_permission_is_named_itself(self):
        (self.directory / "out").mkdir(mode=0o500)
        self.assert_refused(1, ["write", "一", "--out", "out"],
                            "calligraphy: out: the directory is not writable: Permission denied\n")


class Runs(ProgramTest):
    """A run that is there explains itself and is never overwritten."""

    #: For each command that writes into a directory: a run, and its record.
    RUNS = {"summary.json": ["write", "一", "--mode", "force"], "replay.json": ["replay", "pens.txt"],
            "stability.json": ["stability", "--quick"], "tradeoff.json": ["tradeoff", "永", "--quick", "--queries", "10"]}

    def setUp(self):
        super().setUp()
        (self.directory / "pens.txt").write_text("C 一 4E00 test 100 1\nS 2 10 50 0 90 50 500\n")

    def test_a_second_run_is_refused_and_changes_no_byte(self):
        for record, run in self.RUNS.items():
            with self.subTest(command=run[0]):
                self.run_program(*run, "--out", run[0])
                before = self.contents()
                command = re.escape(" ".join(["calligraphy", *run, "--out", run[0]]))
                done = self.run_program(*run, "--out", run[0], code=1)
                self.assertEqual(done.stdout, "")
                self.assertRegex(done.stderr, rf"\Acalligraphy: {run[0]}/{record}: already there, from a run of "
                                 rf"[-0-9T:+]+: {command}; choose another directory, or replace it with --force\n\Z")
                self.assertEqual(self.contents(), before)

    def test_a_run_is_refused_before_any_work(self):
        (self.directory / "out").mkdir()
        (self.directory / "out/summary.json").write_text("{}")
        self.assert_refused(1, ["write", "一", "--repeat", "100000", "--out", "out"], "out/summary.json", "--force")

    def test_every_record_says_how_the_run_came_about_and_lists_its_files(self):
        for name, run in self.RUNS.items():
            with self.subTest(command=run[0]):
                arguments = [*run, "--out", f"{run[0]}'s"]
                self.run_program(*arguments)
                record = self.record(f"{run[0]}'s", name)
                self.assertEqual(record["command"], arguments)
                self.assertIs(record["finished"], True)
                version = self.run_program("--version").stdout.split()[1]
                self.assertEqual(record["version"], version)
                self.assertRegex(record["commit"], r"\A([0-9a-f]{40}(-dirty)?|unknown)\Z")
                age = datetime.datetime.now(datetime.timezone.utc) - datetime.datetime.fromisoformat(record["date"])
                self.assertLess(abs(age), datetime.timedelta(minutes=15))
                files = {path.name for path in (self.directory / f"{run[0]}'s").iterdir()}
                self.assertEqual(set(record["files"]), files - {name})
                self.assertIn(f"--out '{run[0]}'\\''s'", self.run_program(*arguments, code=1).stderr)

    def test_force_removes_the_files_of_the_run_that_is_there_and_no_others(self):
        self.run_program("write", "十一", "--mode", "force", "--out", "out")
        self.assertIn("out/02-一-force-writing.svg", self.files())
        (self.directory / "out/notes.txt").write_text("mine")
        self.run_program("write", "十", "--mode", "force", "--out", "out", "--force")
        left = {path.name for path in (self.directory / "out").iterdir()}
        self.assertEqual(left, {"summary.json", "notes.txt", *self.record()["files"]})
        self.assertEqual({name[:2] for name in self.record()["files"] if name.endswith(".svg")}, {"01"})
        self.assertEqual((self.directory / "out/notes.txt").read_text(), "mine")

    def test_force_removes_only_regular_files_in_the_directory_itself(self):
        out = self.directory / "out"
        (out / "below").mkdir(parents=True)
        for name in ("outside", "out/below/file", "out/target", "out/listed"):
            (self.directory / name).write_text("keep")
        (out / "link").symlink_to("target")
        listed = ["../outside", str(self.directory / "outside"), "below/file", "below", "link", "..", ".", "", 7, None,
                  "missing", "listed"]
        (out / "replay.json").write_text(json.dumps({"files": listed}))
        done = self.run_program("replay", "pens.txt", "--out", "out", "--force")
        self.assertEqual(done.stderr, "")
        self.assertEqual(self.files(), ["out", "out/01-一.svg", "out/below", "out/below/file", "out/link", "out/replay.json",
                                        "out/target", "outside", "pens.txt"])

    def test_a_record_that_lists_no_files_is_replaced_alone_and_that_is_told(self):
        for old in ("old", "{}", '{"results": []}', '{"files": 3}', "[]", ""):
            with self.subTest(record=old):
                out = self.directory / "out"
                out.mkdir(exist_ok=True)
                (out / "01-二.svg").write_text("of an earlier version")
                (out / "replay.json").write_text(old)
                self.assert_refused(1, ["replay", "pens.txt", "--out", "out"], "out/replay.json: already there, from a run;")
                done = self.run_program("replay", "pens.txt", "--out", "out", "--force")
                self.assertIn("out/replay.json: lists no files", done.stderr)
                self.assertTrue((out / "01-二.svg").exists())
                self.assertTrue(self.record("out", "replay.json")["finished"])

    def test_a_directory_without_a_record_is_used_and_other_files_stay(self):
        (self.directory / "out").mkdir()
        (self.directory / "out/notes.txt").write_text("mine")
        self.run_program(*self.RUNS["summary.json"], "--out", "out")
        for run in self.RUNS.values():  # whichever command it is
            self.assertIn("out/summary.json: already there", self.run_program(*run, "--out", "out", code=1).stderr)
        self.run_program(*self.RUNS["replay.json"], "--out", "out", "--force")
        self.assertEqual(self.files(), ["out", "out/01-一.svg", "out/notes.txt", "out/replay.json", "pens.txt"])

    def test_a_killed_run_explains_itself_and_is_replaced_whole(self):
        run = ["write", "一", "--repeat", "100000", "--out", "out"]
        self.killed(*run, once="out/page-1-vision-1.recording.gz")
        record = self.record()
        self.assertIs(record["finished"], False)
        self.assertEqual((record["command"], record["text"], record["repetitions_requested"]), (run, "一", 100000))
        self.assertNotIn("results", record)
        files = {path.name for path in (self.directory / "out").iterdir()} - {"summary.json"}
        self.assertLessEqual({name for name in files if not name.endswith(".tmp")}, set(record["files"]))
        before = self.contents()
        refused = self.run_program(*run, code=1)
        self.assertIn("already there, from an unfinished run of ", refused.stderr)
        self.assertEqual(self.contents(), before)
        self.run_program("write", "十", "--mode", "force", "--out", "out", "--force")
        self.assertFalse(list((self.directory / "out").glob("*一*.svg")))
        self.assertTrue(self.record()["finished"])

    def test_force_is_for_a_directory(self):
        self.assert_refused(2, ["replay", "pens.txt", "--force"], "--force", "--out")


class Summary(ProgramTest):
    def test_it_names_page_device_options_law_and_writer(self):
        self.run_program("write", "一十", "--out", "out", "--seed", "4", "--repeat", "2", "--page", "desk",
                         "--motion-scale", "2", "--device", "omni", "--writer", "skilled", "--renderer", "everything")
        record = self.record()
        self.assertEqual(record["text"], "一十")
        self.assertEqual(set(record["page"]), {"pose", "width_m", "height_m", "em_m", "gap_m", "motion_scale", "pages"})
        self.assertEqual((record["page"]["pose"], record["page"]["motion_scale"], record["page"]["pages"]), ("desk", 2, 1))
        self.assertEqual(record["mapping"]["rotation"], [[1, 0, 0], [0, 0, -1], [0, 1, 0]])
        self.assertEqual(record["mapping"]["offset_m"][:2], [record["page"]["width_m"] / 2, record["page"]["height_m"] / 2])
        self.assertEqual(record["mapping"]["scale"], 2)
        device = record["device"]
        self.assertEqual((device["model"], device["simulated"], device["workspace_m"]),
                         ("Phantom Omni", True, [0.16, 0.12, 0.07]))
        self.assertEqual(len(device), 18)
        self.assertEqual((device["peak_force_N"], device["apparent_mass_kg"]), (3.3, 0.045))
        options = record["options"]
        self.assertEqual((options["guidance.to_start"], options["guidance.force"], options["limits.in_plane_rate"]),
                         ("true", "saturating", "100"))
        self.assertEqual(options["servo_rate"], "1000", "the device's, which is in effect")
        self.assertEqual(record["law"]["vision"], "none")
        self.assertRegex(record["law"]["force"], rf"^saturating: {options['guidance.stiffness']} N/m, at most ")
        self.assertEqual((record["writer"]["name"], record["writer"]["wrong_order"]), ("skilled", 0))
        self.assertEqual(record["seeds"], {"first": 4, "count": 2})
        self.assertEqual({row["seed"] for row in record["results"]}, {4, 5})
        self.assertNotIn(os.environ["CALLIGRAPHY_PROGRAM"], (self.directory / "out/summary.json").read_text())

    def test_the_law_is_that_of_the_recordings(self):
        self.run_program("write", "一十", "--out", "out", "--renderer", "everything")
        recordings = json.loads(self.run_program("replay", "out", "--json").stdout)["recordings"]
        self.assertEqual({each["mode"]: each["law"] for each in recordings}, self.record()["law"])
