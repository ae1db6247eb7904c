import csv
import json
import math
import os
import resource
import shutil
import signal
import statistics
import subprocess
import time
import xml.etree.ElementTree as xml
from pathlib import Path

from program import ProgramTest

FIELDS = ["character", "mode", "writing_time_s", "rms_error_mm", "max_error_mm", "overall_error_mm", "coverage",
          "order_mistakes", "direction_mistakes", "extra_pen_downs", "missing_strokes", "strokes_written", "remarks",
          "strokes_completed", "peak_force_N", "max_force_step_N", "tick_ns_p50", "tick_ns_p999"]


class Write(ProgramTest):
    def test_an_ignored_hangup_signal_stays_ignored(self):
        """As when nohup starts the program."""
        before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
        try:
            running = subprocess.Popen([os.environ["CALLIGRAPHY_PROGRAM"], "write", "一", "--mode", "force", "--repeat",
                                        "20", "--out", "out"], cwd=self.directory, stdout=subprocess.DEVNULL)
        finally:
            signal.signal(signal.SIGHUP, before)
        while running.poll() is None and not (self.directory / "out/page-1-force-1.recording.gz").exists():
            time.sleep(0.001)
        running.send_signal(signal.SIGHUP)
        self.assertEqual(running.wait(600), 0)
        self.assertEqual(len(self.summary()), 20)

    def test_exceeding_the_file_size_limit_is_a_write_error(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        done = subprocess.run([os.environ["CALLIGRAPHY_PROGRAM"], "strokes", "--out", "strokes.svg"],
                              cwd=self.directory, preexec_fn=limit, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "calligraphy: strokes.svg: cannot be written: File too large\n"))
        self.assertEqual(self.files(), [])

    def test_remarks_are_printed_in_either_language_unless_there_are_many(self):
        def said(printed, language, modes):
            remarks = [(row, remark[language]) for row in self.summary() for remark in row["remarks"]]
            self.assertGreater(len(remarks), 1)
            lines = [f"  1 永  {modes[row['mode']]}  {text}" for row, text in remarks]
            self.assertEqual(printed.splitlines()[-len(lines) - 1:], ["", *lines])
            return [text for _, text in remarks]

        arguments = ["write", "永", "--seed", "2", "--out", "out"]
        english = said(self.run_program(*arguments).stdout, "reason", {"vision": "vision", "force": "force"})
        self.assertIn("Your 1st line is stroke 1 (diǎn) backwards: start at the top left.", english)
        printed = self.run_program(*arguments, "--language", "zh", "--force").stdout
        chinese = said(printed, "reason_zh", {"vision": "视觉", "force": "力觉"})
        self.assertIn("你写的第1笔是第1笔（点），但方向反了，从左上方起笔。", chinese)
        self.assertEqual(printed.splitlines()[1].split()[:3], ["汉字", "方式", "[s]"])
        self.assertIn("n = 1 对书写：太少", printed)
        self.assertIn(">永, 仅视觉, Phantom Desktop<", (self.directory / "out/01-永-vision-writing.svg").read_text())
        self.assert_refused(2, [*arguments, "--language", "tlh"], "--language", "tlh")

        printed = self.run_program("write", "永", "--mode", "vision", "--repeat", "100", "--out", "many").stdout
        rows = json.loads((self.directory / "many/summary.json").read_text())["results"]
        count = sum(len(row["remarks"]) for row in rows)
        self.assertGreater(count, 20)
        self.assertTrue(printed.endswith(f"\n\n{count} remarks: see summary.json\n"), printed)

    def test_results_up_to_ctrl_c_are_saved(self):
        printed, told = self.interrupted("write", "一", "--mode", "force", "--repeat", "100000", "--out", "out",
                                         once="out/page-1-force-1.recording.gz")
        self.assertIn("calligraphy: interrupted; results so far are in out\n", told)
        row = next(line for line in printed.splitlines() if line.startswith("一"))
        written = len(self.summary())
        self.assertTrue(printed.startswith(f"interrupted: means over {written} of 100000 repetitions\n"), printed)
        self.assertEqual(row.split()[1], "force")
        whole = self.record()
        self.assertEqual((whole["repetitions_requested"], whole["interrupted"], whole["finished"]),
                         (100000, True, False))
        self.assertGreater(written, 0)
        self.assertLess(written, 100000)

    def test_a_directory_in_use_by_another_run_is_refused_until_that_run_ends_or_is_killed(self):
        run = ["write", "一", "--mode", "force", "--out", "out"]
        for ending in (signal.SIGINT, signal.SIGKILL):
            with self.subTest(ending=ending.name):
                running = subprocess.Popen([os.environ["CALLIGRAPHY_PROGRAM"], *run, "--repeat", "100000"],
                                           cwd=self.directory, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                while running.poll() is None and not (self.directory / "out/page-1-force-1.recording.gz").exists():
                    time.sleep(0.001)
                running.send_signal(signal.SIGSTOP)  # it changes nothing while we look
                os.waitpid(running.pid, os.WUNTRACED)
                traces = self.directory / "trace.txt"
                traces.write_text("C 一 4E00 test 100 1\nS 2 10 50 0 90 50 500\n")
                for other in (run, ["stability", "--quick", "--out", "./out/"], ["tradeoff", "--quick", "--out", "out"],
                              ["replay", "trace.txt", "--out", str(self.directory / "out")]):
                    self.assert_refused(1, other, "out", "another run is writing there")
                running.send_signal(signal.SIGCONT)
                running.send_signal(ending)
                running.wait(600)
                self.run_program(*run, "--force")
                self.assertEqual(len(self.summary()), 1)
                shutil.rmtree(self.directory / "out")

    def without_ticks(self, out):
        return [{k: v for k, v in row.items() if not k.startswith("tick_ns")} for row in self.summary(out)]

    def test_all_files_of_a_run_are_written_and_well_formed(self):
        done = self.run_program("write", "十 人", "--out", "deep/out")
        self.assertNotIn("%", done.stderr, "no progress bar in a pipe")
        out = self.directory / "deep" / "out"
        stems = [f"{n:02}-{c}-{mode}" for n, c in ((1, "十"), (2, "人")) for mode in ("vision", "force")]
        expected = {"summary.json", "strokes.csv"} | {stem + "-writing.svg" for stem in stems}
        for mode in ("vision", "force"):
            expected |= {f"page-1-{mode}-1.recording.gz", f"page-1-{mode}-writing.svg"}
        if shutil.which("gnuplot"):
            expected |= {stem + "-plot.svg" for stem in stems if stem.endswith("force")}
            self.assertEqual(done.stderr, "")
        self.assertEqual({path.name for path in out.iterdir()}, expected)
        for picture in out.glob("*.svg"):
            self.assertEqual(xml.parse(picture).getroot().tag, "{http://www.w3.org/2000/svg}svg")
        for row in self.summary("deep/out"):
            self.assertLessEqual(set(FIELDS), set(row))
            self.assertEqual(row["strokes_completed"], row["strokes"])
            self.assertGreater(row["writing_time_s"], 0.0)
            self.assertGreater(row["rms_error_mm"], 0.0)
            self.assertGreaterEqual(row["max_error_mm"], row["rms_error_mm"])
            self.assertGreater(row["tick_ns_p50"], 0.0)
            motion = row["motion"]
            self.assertAlmostEqual(motion["duration_s"], motion["time_on_paper_s"] + motion["time_in_air_s"], places=9)
            self.assertAlmostEqual(motion["mean_speed_m_per_s"], motion["path_length_m"] / motion["time_on_paper_s"])
            self.assertGreater(motion["peak_speed_m_per_s"], motion["mean_speed_m_per_s"])
            self.assertLess(motion["smoothness_sparc"], -1.0)
            self.assertGreater(row["dtw_distance_mm"], 0.0)
            self.assertEqual(row["mean_pressure_N"] is None, row["mode"] == "vision")
            self.assertGreaterEqual(row["tick_ns_p999"], row["tick_ns_p50"])
            self.assertEqual(row["peak_force_N"] > 0.0, row["mode"] == "force")
            self.assertEqual(row["max_force_step_N"] > 0.0, row["mode"] == "force")
        self.assertEqual([(row["character"], row["mode"]) for row in self.summary("deep/out")],
                         [("十", "vision"), ("十", "force"), ("人", "vision"), ("人", "force")])

    def test_the_table_has_units_and_compares_the_modes(self):
        text = self.run_program("write", "十人", "--out", "out", "--repeat", "10").stdout
        lines = text.splitlines()
        for word in ("[s]", "[mm]", "[N]", "[ns]", "95 % interval", "20 characters in n = 10 pairs of runs"):
            self.assertIn(word, text)
        rows = [line for line in lines if line.startswith(("十", "人"))]
        self.assertEqual([row.split()[1] for row in rows], 2 * ["vision", "force", "vision", "force"])
        by_run = {}  # one page and seed: its two characters are one draw
        for row in self.summary():
            sign = 1.0 if row["mode"] == "vision" else -1.0
            by_run[row["seed"]] = by_run.get(row["seed"], 0.0) + sign * row["rms_error_mm"] / 2
        reduced = list(by_run.values())
        half_width = 2.262157 * statistics.stdev(reduced) / math.sqrt(10)  # Student's t, 9 degrees of freedom
        words = next(line for line in lines if line.startswith("RMS error")).split()
        mean = statistics.mean(reduced)
        for word, value in ((words[2], mean), (words[-4], mean - half_width), (words[-2], mean + half_width)):
            self.assertAlmostEqual(float(word), value, delta=0.00051)

    def test_errors_by_character_are_means_over_pairs_clustered_by_run(self):
        if not shutil.which("gnuplot"):
            self.skipTest("gnuplot is missing")
        self.run_program("write", "十人十", "--out", "out", "--repeat", "10")
        rows = {(row["position"], row["seed"], row["mode"]): row["rms_error_mm"] for row in self.summary()}
        seeds = sorted({seed for _, seed, _ in rows})
        found = self.record()["error_by_character"]
        self.assertEqual([(each["character"], each["pairs"], each["runs"]) for each in found],
                         [("十", 20, 10), ("人", 10, 10), (None, 30, 10)])
        for each, positions in zip(found, ((1, 3), (2,), (1, 2, 3))):
            for name, of_pair in (("vision", lambda vision, force: vision), ("force", lambda vision, force: force),
                                  ("reduction", lambda vision, force: vision - force)):
                runs = [statistics.mean(of_pair(rows[p, seed, "vision"], rows[p, seed, "force"]) for p in positions)
                        for seed in seeds]
                half_width = 2.262157 * statistics.stdev(runs) / math.sqrt(10)  # Student's t, 9 degrees of freedom
                self.assertAlmostEqual(each[name]["mean_mm"], statistics.mean(runs), places=9)
                self.assertAlmostEqual(each[name]["half_width_mm"], half_width, places=6)
        words = [text.text for text in xml.parse(self.directory / "out/error-by-character.svg").getroot().findall(
            "{http://www.w3.org/2000/svg}text")]
        self.assertEqual([word for word in words if word in ("十", "人", "all", "10")],
                         ["十", "10", "人", "10", "all", "10"])

    def test_what_was_not_written_has_no_error_and_the_means_say_over_how_much_they_are(self):
        done = self.run_program("write", "永北", "--out", "out", "--rules", "wang2006", "--mode", "force")
        written, none = self.summary()
        self.assertIsNone(none["rms_error_mm"])
        self.assertEqual((none["strokes_written"], none["missing_strokes"], none["coverage"]), (0, none["strokes"], 0.0))
        row = next(line for line in done.stdout.splitlines() if line.startswith("北")).split()
        self.assertEqual(row[2:6], ["-"] * 4)
        mean = next(line for line in done.stdout.splitlines() if line.startswith("force "))
        self.assertIn(f"RMS error {written['rms_error_mm']:.3f} mm over {written['strokes_written']} of "
                      f"{written['strokes'] + none['strokes']} strokes", mean)

    def test_too_few_runs_to_show_an_effect_are_said_to_be_too_few(self):
        for repeat, words in (("1", "n = 1 pair of runs: too few to show an effect of force; try --repeat 20"),
                              ("9", "n = 9 pairs of runs: too few")):
            text = self.run_program("write", "一", "--out", repeat, "--repeat", repeat).stdout
            self.assertIn(words, text)
            self.assertNotIn("less with force", text)
            self.assertFalse((self.directory / repeat / "error-by-character.svg").exists())
        text = self.run_program("write", "一", "--out", "out", "--mode", "force").stdout
        self.assertNotIn("too few", text, "there is nothing to compare")

    def test_a_page_on_a_desk_is_written_as_one_upright(self):
        for page in ("upright", "desk"):
            self.run_program("write", "永", "--out", page, "--page", page)
        self.assertEqual(self.without_ticks("upright"), self.without_ticks("desk"))

    def test_a_page_holds_what_the_workspace_times_the_motion_scale_can_hold(self):
        for options, pages in (([], 2), (["--page", "desk"], 3), (["--motion-scale", "2"], 1)):
            with self.subTest(options=options):
                self.run_program("write", "一一一一一一一", "--device", "omni", "--mode", "force", "--out", "out",
                                 "--force", *options)
                rows = self.summary()
                self.assertEqual(len({row["seed"] for row in rows}), pages, "one seed per page")

    def test_characters_are_written_at_other_motion_scales(self):
        for scale in ("0.5", "2"):
            self.run_program("write", "永", "--out", scale, "--page", "desk", "--motion-scale", scale)
            for row in self.summary(scale):
                self.assertEqual(row["strokes_completed"], 5)
        self.run_program("write", "永", "--out", "weak", "--motion-scale", "2", "--peak-force", "0.3")
        self.assertLessEqual(max(row["peak_force_N"] for row in self.summary("weak")), 0.3 + 1e-9)

    def test_repetitions_are_paired_by_their_seeds(self):
        done = self.run_program("write", "一十", "--out", "out", "--repeat", "3", "--seed", "5", "--json")
        rows = self.summary()
        whole = json.loads(done.stdout)
        self.assertEqual((whole["repetitions_requested"], whole["interrupted"], whole["results"]), (3, False, rows))
        self.assertEqual(whole, self.record())
        self.assertEqual(whole["seeds"], {"first": 5, "count": 3})
        self.assertEqual(len(rows), 2 * 2 * 3)
        for mode in ("vision", "force"):
            seeds = [(r["repetition"], r["seed"]) for r in rows if r["mode"] == mode and r["character"] == "十"]
            self.assertEqual(seeds, [(1, 5), (2, 6), (3, 7)])
        kept = sorted(path.name for path in (self.directory / "out").glob("page-*.gz"))
        self.assertEqual(kept, [f"page-1-{mode}-1.recording.gz" for mode in ("force", "vision")],
                         "of the first repetition only")

    def test_pictures_show_ink_or_lines(self):
        for options, style in ([], "fill"), (["--lines"], "stroke"):
            out = self.directory / style
            self.run_program("write", "人", "--mode", "force", "--out", style, *options)
            groups = list(xml.parse(out / "01-人-force-writing.svg").getroot().iter("{http://www.w3.org/2000/svg}g"))
            self.assertEqual([g.get(style) for g in groups if g.get("class") == "template"], ["#c5d6f7"])

    def test_titles_name_characters_and_typical_strokes(self):
        self.run_program("write", "人㇏⑰", "--mode", "vision", "--out", "out")
        titles = [xml.parse(self.directory / "out" / f"{name}-vision-writing.svg").getroot()[0].text
                  for name in ("01-人", "02-㇏", "03-⑰", "page-1")]
        what = ["人", "6 捺 nà", "17 横撇 héngpiě", "人, 6 捺 nà, 17 横撇 héngpiě"]
        self.assertEqual(titles, [f"{each}, vision only, Phantom Desktop" for each in what])

    def test_without_a_font_for_the_pictures_that_is_told_once_and_they_keep_their_chinese(self):
        (self.directory / "fonts.conf").write_text("<fontconfig/>")
        fonts = {"FONTCONFIG_FILE": str(self.directory / "fonts.conf")}
        poster = self.run_program("strokes", "-o", "-", environment=fonts).stderr
        done = self.run_program("write", "人㇏", "--out", "out", environment=fonts)
        self.assertIn(">人, vision only", (self.directory / "out/01-人-vision-writing.svg").read_text())
        told = [line for line in done.stderr.splitlines() if "font" in line]
        if "fontconfig was missing" in poster:  # fonts cannot be found
            return self.assertEqual(told, [])
        self.assertEqual(len(told), 1, done.stderr)
        self.assertRegex(told[0], r"\Acalligraphy: warning: no installed font has [^\n]*Chinese in the pictures")
        self.assertEqual(told[0].partition(": install ")[2], poster.strip().partition(": install ")[2])

    def test_a_run_is_reproducible_to_the_last_digit(self):
        for out in ("a", "b"):
            self.run_program("write", "人", "--out", out, "--seed", "7")
        self.assertEqual(self.without_ticks("a"), self.without_ticks("b"))
        self.assertEqual((self.directory / "a/01-人-force-writing.svg").read_bytes(),
                         (self.directory / "b/01-人-force-writing.svg").read_bytes())
        self.run_program("write", "人", "--out", "c", "--seed", "8")
        self.assertNotEqual(self.without_ticks("a"), self.without_ticks("c"))

    def test_an_aborted_character_does_not_affect_other_results(self):
        done = self.run_program("write", "永北", "--out", "out", "--rules", "wang2006", "--mode", "force")
        self.assertIn("not completed", done.stderr)
        rows = self.summary()
        self.assertEqual([row["character"] for row in rows], ["永", "北"])
        self.assertEqual(rows[1]["strokes_completed"], 0)
        self.assertIsNone(rows[1]["rms_error_mm"])

    def test_a_run_at_a_rate_too_low_for_writing_ends_cleanly(self):
        for rate in ("10", "12", "20", "50"):
            self.run_program("write", "一北", "--out", rate, "--rate", rate)
            self.assertEqual(len(self.summary(rate)), 4)

    def test_a_skilled_writer_has_smaller_errors(self):
        for writer in ("novice", "skilled"):
            self.run_program("write", "十人", "--out", writer, "--writer", writer, "--mode", "vision", "--repeat", "3")
        error = {w: sum(row["rms_error_mm"] for row in self.summary(w)) for w in ("novice", "skilled")}
        self.assertLess(error["skilled"], error["novice"])

    def test_the_printed_rules_have_larger_force_steps_than_the_default(self):
        self.run_program("write", "十人", "--out", "ours", "--mode", "force")
        self.run_program("write", "十人", "--out", "printed", "--mode", "force", "--rules", "wang2006")
        ours = max(row["max_force_step_N"] for row in self.summary("ours"))
        printed = max(row["max_force_step_N"] for row in self.summary("printed"))
        self.assertLess(ours, printed)

    def test_where_no_character_is_completed_more_repetitions_are_not_advised(self):
        for repeat, pairs in (("1", "1 pair"), ("2", "2 pairs")):
            done = self.run_program("write", "永", "--out", repeat, "--rules", "wang2006", "--repeat", repeat)
            self.assertIn("\nno character was completed in both modes: no effect of force to show\n"
                          f"{pairs} omitted: not every stroke was completed\n", done.stdout)

    def test_the_requested_peak_force_is_never_exceeded(self):
        self.run_program("write", "十", "--out", "out", "--mode", "force", "--peak-force", "0.3")
        self.assertLessEqual(self.summary()[0]["peak_force_N"], 0.3 + 1e-9)
        self.run_program("write", "十", "--out", "free", "--mode", "force")
        self.assertGreater(self.summary("free")[0]["peak_force_N"], 0.3)

    def test_all_optional_stages_can_be_enabled(self):
        for renderer in ("default", "everything"):
            self.run_program("write", "十", "--out", renderer, "--mode", "force", "--renderer", renderer)
        plain, everything = self.summary("default")[0], self.summary("everything")[0]
        self.assertEqual(everything["strokes_completed"], 2)
        self.assertNotEqual(everything["rms_error_mm"], plain["rms_error_mm"])

    def test_every_device_runs_with_the_printed_method(self):
        for device in ("omni", "touch", "desktop", "premium-1.5", "ideal"):
            self.run_program("write", "一", "--out", device, "--device", "simulated:" + device, "--method", "wang2006",
                             "--tolerance", "1e-3")
            self.assertEqual(len(self.summary(device)), 2)

    def test_punctuation_that_the_set_lacks_is_skipped_and_told(self):
        done = self.run_program("write", "一，「十」。，", "-o", "out", "--mode", "force")
        self.assertIn("skipped: ， (U+FF0C), 「 (U+300C), 」 (U+300D), 。 (U+3002)\n", done.stderr)
        self.assertEqual([(row["character"], row["position"]) for row in self.summary()], [("一", 1), ("十", 2)])
        (self.directory / "dot.txt").write_text("calligraphy characters 2\ncharacter 。\nstroke 1 0.1,0.5 0.9,0.5\n")
        done = self.run_program("write", "。", "-o", "dot", "--mode", "force", "--characters", "dot.txt")
        self.assertNotIn("skipped", done.stderr)

    def test_a_repeated_character_fills_as_many_pages_as_needed(self):
        self.run_program("write", "一一一一一一一一", "--out", "out", "--mode", "force")
        self.assertEqual([row["position"] for row in self.summary()], list(range(1, 9)))
        self.assertTrue((self.directory / "out/08-一-force-writing.svg").exists())

    def test_characters_of_a_text_file_are_written(self):
        (self.directory / "own.txt").write_text("calligraphy characters 2\nsource s\nlicence l\nattribution a\n\n"
                                                "character /\nstroke 1 0.1,0.5 0.9,0.5\n")
        self.run_program("write", "/", "--out", "out", "--characters", "own.txt", "--mode", "force")
        self.assertTrue((self.directory / "out/01-U+002F-force-writing.svg").exists(), self.files())

    def test_characters_of_a_set_file_are_written_in_the_requested_order(self):
        data = str(Path(__file__).resolve().parent.parent / "data" / "version_1.set")
        self.run_program("write", "北一", "--out", "out", "--characters", data, "--mode", "force")
        self.assertEqual([(row["strokes_completed"], row["strokes"]) for row in self.summary()], [(5, 5), (1, 1)])
        self.run_program("write", "北", "--out", "other", "--characters", data, "--mode", "force", "--order", "Table 3")
        self.assertEqual([row["strokes_completed"] for row in self.summary("other")], [5])
        self.assertNotEqual((self.directory / "out/01-北-force-writing.svg").read_bytes(),
                            (self.directory / "other/01-北-force-writing.svg").read_bytes())

    def test_characters_of_hanzi_writer_data_are_written(self):
        self.run_program("write", "永和九年", "--out", "out", "--characters", self.data_directory())
        rows = self.summary()
        self.assertEqual([row["character"] for row in rows[::2]], list("永和九年"))
        for row in rows:
            self.assertEqual(row["strokes_completed"], row["strokes"])


class Refusals(ProgramTest):
    def test_usage_errors_are_one_line_and_exit_with_two(self):
        for arguments, words in (
                (["frobnicate"], ["frobnicate"]),
                (["write"], ["TEXT"]),
                (["write", "北"], ["--out"]),
                (["write", "", "--out", "out"], ["TEXT"]),
                (["write", " \u3000\n", "--out", "out"], ["TEXT"]),
                (["write", b"\xe5\x8c", "--out", "out"], ["TEXT", "byte 0"]),
                (["write", "北", "--out", ""], ["--out"]),
                (["write", "北", "--out", "out", "--device", "phantasm"], ["--device", "phantasm", "phantom"]),
                (["write", "北", "--out", "out", "--device", "simulated:"], ["--device", "simulated:", "desktop"]),
                (["write", "北", "--out", "out", "--device", "phantom:"], ["--device", "phantom:", "colon"]),
                (["write", "北", "--out", "out", "--timeout", "5"], ["--timeout", "simulated"]),
                (["write", "北", "--out", "out", "--wire-profile", "omni"], ["--wire-profile", "simulated"]),
                (["write", "北", "--out", "out", "--rules", "wang2006", "--renderer", "everything"], ["--renderer"]),
                (["write", "北", "--out", "out", "--device", "simulated:novint"], ["--device", "novint", "desktop"]),
                (["write", "北", "--out", "out", "--writer", "poet"], ["--writer", "poet"]),
                (["write", "北", "--out", "out", "--mode", "blind"], ["--mode", "blind"]),
                (["write", "北", "--out", "out", "--method", "guess"], ["--method", "guess"]),
                (["write", "北", "--out", "out", "--rules", "none"], ["--rules", "none"]),
                (["write", "北", "--out", "out", "--page", "wall"], ["--page", "wall", "desk"]),
                (["write", "北", "--out", "out", "--unknown"], ["--unknown"])):
            with self.subTest(arguments=arguments):
                self.assert_refused(2, arguments, *words)

    def test_invalid_numbers_are_named(self):
        for option in ("--rate", "--tolerance", "--repeat", "--seed", "--peak-force", "--timeout", "--motion-scale"):
            for value in ("nan", "inf", "1e999", "-1", "x", "", "1x", "0x10", "18446744073709551616"):
                with self.subTest(option=option, value=value):
                    self.assert_refused(2, ["write", "北", "--out", "out", f"{option}={value}"], option, value)
        (self.directory / "far.txt").write_text("calligraphy characters 2\ncharacter 一\nstroke 1 0,1e300 1,0\n")
        self.assert_refused(1, ["write", "一", "--out", "out", "--characters", "far.txt"], "far.txt:3", "(0, 1e+300)")
        for option in ("--rate", "--tolerance", "--repeat", "--motion-scale"):
            with self.subTest(option=option):
                self.assert_refused(2, ["write", "北", "--out", "out", option, "0"], option, "0")

    def test_an_unknown_character_is_named_with_its_code(self):
        self.assert_refused(1, ["write", "北\u9f98", "--out", "out"], "\u9f98", "U+9F98")
        self.assert_refused(1, ["write", "\x01", "--out", "out"], "U+0001")
        self.assert_refused(1, ["write", "北\u9f98，\u9f98犇", "--out", "out"],
                            "not in the built-in set (see --characters): \u9f98 (U+9F98), 犇 (U+7287); it has 永北京",
                            "`calligraphy import` makes a set of thousands")
        self.assert_refused(1, ["write", "，。", "--out", "out"], "not in the built-in set (see --characters): ， (U+FF0C), 。 (U+3002)\n")

    def test_a_missing_or_malformed_file_is_named(self):
        self.assert_refused(1, ["write", "北", "--out", "out", "--characters", "none.txt"], "none.txt")
        self.assert_refused(1, ["info", "北", "--characters", "/dev/zero"], "/dev/zero", "regular file")
        (self.directory / "bad.txt").write_text("calligraphy characters 2\ncharacter 北\nstroke 99 0,0 1,1\n")
        self.assert_refused(1, ["write", "北", "--out", "out", "--characters", "bad.txt"], "bad.txt", "3", "99")
        (self.directory / "empty.txt").write_text("")
        self.assert_refused(1, ["write", "北", "--out", "out", "--characters", "empty.txt"], "empty.txt")
        (self.directory / "data").mkdir()
        self.assert_refused(1, ["write", "北", "--out", "out", "--characters", "data"], "北")
        (self.directory / "data" / "北.json").write_text('{"medians": [[[0, 0], [1e999, 5]]]}')
        self.assert_refused(1, ["write", "北", "--out", "out", "--characters", "data"], "北.json")

    def test_nothing_that_the_program_did_not_make_is_removed(self):
        (self.directory / "gone").symlink_to("unmounted/disk")
        (self.directory / "there").mkdir()
        (self.directory / "link").symlink_to("there")
        (self.directory / "link/.calligraphy-probe").write_text("mine")
        for out in ("gone", "gone/", "gone/sub"):
            self.assert_refused(1, ["write", "一", "--out", out], "gone is a link to unmounted/disk, which is not a")
            self.assertEqual(os.readlink(self.directory / "gone"), "unmounted/disk")
        self.assert_refused(1, ["write", "一", "--out", "link/gnome/../sub", "--characters", "none.txt"], "none.txt")
        self.assertEqual(os.readlink(self.directory / "link"), "there")
        self.run_program("write", "一", "--mode", "force", "--out", "link")
        self.assertEqual((self.directory / "there/.calligraphy-probe").read_text(), "mine")
        self.assertEqual(len(self.summary("there")), 1)

    def test_an_unwritable_directory_is_named_before_the_run(self):
        (self.directory / "file").write_text("keep")
        self.assert_refused(1, ["write", "北", "--out", "file"], "file")
        self.assert_refused(1, ["write", "北", "--out", "file/out"], "file/out")
        self.assert_refused(1, ["write", "北", "--out", "new/" + "x" * 300], "new")
        self.assert_refused(1, ["write", "北", "--out", "/proc/calligraphy/out"], "/proc/calligraphy/out")
        self.assertEqual((self.directory / "file").read_text(), "keep")
