import json
import math
import unicodedata
import xml.etree.ElementTree as xml
from pathlib import Path

from program import ProgramTest

# 三 and 十 of the built-in set as straight lines on a square of 1000, y down.
THREE = [((160, 220), (840, 200)), ((240, 500), (760, 480)), ((80, 800), (920, 790))]
TEN = [((100, 500), (900, 470)), ((500, 80), (500, 940))]
SVG = "{http://www.w3.org/2000/svg}"
BUILT_IN = Path(__file__).resolve().parents[2] / "data" / "characters.txt"
# 明, and 已 and 己, which differ in where stroke 3 begins.
MORE = """calligraphy characters 2
character 明
stroke 2 0.13,0.78 0.13,0.24
stroke 16 0.13,0.78 0.38,0.79 0.38,0.25
stroke 1 0.13,0.53 0.37,0.54
stroke 1 0.13,0.28 0.37,0.29
stroke 4 0.55,0.86 0.55,0.50 0.53,0.26 0.40,0.09
stroke 18 0.55,0.86 0.86,0.87 0.86,0.12 0.77,0.16
stroke 1 0.55,0.63 0.85,0.64
stroke 1 0.55,0.41 0.85,0.42
character 已
stroke 16 0.24,0.82 0.70,0.84 0.70,0.52
stroke 1 0.26,0.52 0.69,0.54
stroke 31 LLLL 0.25,0.68 0.25,0.14 0.31,0.08 0.84,0.08 0.85,0.24
character 己
stroke 16 0.24,0.82 0.70,0.84 0.70,0.52
stroke 1 0.26,0.52 0.69,0.54
stroke 31 LLLL 0.25,0.52 0.25,0.14 0.31,0.08 0.84,0.08 0.85,0.24
"""


def stroke(begin, end, time):
    steps = 40
    words = [f"S {steps + 1}"]
    for i in range(steps + 1):
        x, y = (a + (b - a) * i / steps for a, b in zip(begin, end))
        words.append(f"{x:.1f} {y:.1f} {time + 10 * i}")
    return " ".join(words)


def columns(line):
    """How many columns of a terminal a line takes."""
    return sum(2 if unicodedata.east_asian_width(letter) in "WF" else 1 for letter in line)


def character(code, lines, name="made-up"):
    text = f"C {code} {ord(code):04X} {name} 1000 {len(lines)}\n"
    return text + "".join(stroke(*line, 1000 * i) + "\n" for i, line in enumerate(lines))


class ReplayTest(ProgramTest):
    def traces(self, *texts):
        (self.directory / "pens.txt").write_text("# CC0, drawn by this test\n" + "".join(texts))
        return "pens.txt"

    def replay(self, *texts, options=()):
        return json.loads(self.run_program("replay", self.traces(*texts), "--json", *options).stdout)

    def remarks(self, *texts):
        return [[(r["kind"], r["pen_down"], r["stroke"]) for r in trace["remarks"]]
                for trace in self.replay(*texts)["traces"]]


class Replay(ReplayTest):
    def test_the_correct_order_and_direction_have_no_remark(self):
        report = self.replay(character("三", THREE), character("十", TEN))
        self.assertEqual([trace["character"] for trace in report["traces"]], ["三", "十"])
        for trace in report["traces"]:
            self.assertEqual(trace["remarks"], [])
            self.assertEqual(trace["order_mistakes"], 0)
            self.assertEqual(trace["direction_mistakes"], 0)
            self.assertEqual(trace["strokes_drawn"], trace["strokes"])
            self.assertEqual([d["strokes"] for d in trace["drawn"]], [[i + 1] for i in range(trace["strokes"])])
            self.assertEqual({d["course"] for d in trace["drawn"]}, {"forwards"})

    def test_the_motion_of_the_person_is_told(self):
        (trace,) = self.replay(character("十", TEN))["traces"]
        motion = trace["motion"]
        length = sum(math.dist(*line) for line in TEN) / 1000.0
        self.assertAlmostEqual(motion["path_length_em"], length, places=3)  # coordinates are rounded to 1e-4 em
        self.assertAlmostEqual(motion["mean_speed_em_per_s"], length / 0.8, places=3)  # 40 steps of 10 ms each
        for name, value in (("duration_s", 1.4), ("time_on_paper_s", 0.8), ("time_in_air_s", 0.6)):
            self.assertAlmostEqual(motion[name], value, places=9)
        self.assertEqual((motion["pen_ups"], motion["velocity_peaks"]), (1, 2))
        table = self.run_program("replay", "pens.txt").stdout
        self.assertIn(f"{motion['path_length_em']:.2f}", table)
        self.assertIn(f"{motion['smoothness_sparc']:.2f}", table)

    def test_a_trace_on_a_desk_gives_the_report_of_one_upright(self):
        trace = character("十", TEN)
        self.assertEqual(self.replay(trace, options=("--page", "desk")), self.replay(trace))

    def test_the_limits_of_the_device_hold_at_other_motion_scales(self):
        trace = character("三", THREE)
        for scale in ("0.5", "2"):
            with self.subTest(scale=scale):
                report = self.replay(trace, options=("--motion-scale", scale))
                for each in report["traces"]:
                    self.assertGreater(each["peak_force_N"], 0.0)
                    self.assertLessEqual(each["peak_force_N"], report["peak_force_limit_N"] + 1e-9)
                    self.assertLessEqual(each["max_force_step_N"], report["force_step_limit_N"] + 1e-9)
        self.assert_refused(2, ["replay", "pens.txt", "--motion-scale", "0"], "--motion-scale", "0")

    def test_a_wrong_order_names_the_written_and_the_expected_stroke(self):
        one, two, three = THREE
        self.assertEqual(self.remarks(character("三", [one, three, two])), [[("order", 2, 3)]])
        self.assertEqual(self.remarks(character("三", [three, two, one])), [[("order", 1, 1)]])
        text = self.run_program("replay", self.traces(character("三", [one, three, two]))).stdout
        self.assertIn("  1 三  Stroke 3 (héng) came too early: write stroke 2 (héng) first.\n", text)
        chinese = self.run_program("replay", "pens.txt", "--language", "zh").stdout
        self.assertIn("  1 三  第3笔（横）写早了，先写第2笔（横）。\n", chinese)
        self.assertIn("1 个字中，0 个没有意见，0 个笔顺正确，1 个方向正确\n", chinese)
        words, said = text.splitlines(), chinese.splitlines()
        self.assertEqual((words[2].split()[3:6], said[2].split()[3:5]), (["1", "out", "of"], ["1", "处有误"]))
        self.assertEqual([columns(line) for line in said[:3]], [columns(line) for line in words[:3]])
        self.assertIn("0 of 1 without a remark, 0 in the correct order, 1 in the correct direction", text)

    def test_a_stroke_written_from_its_end_is_a_direction_mistake(self):
        one, two, three = THREE
        self.assertEqual(self.remarks(character("三", [one, two[::-1], three])), [[("direction", 2, 2)]])

    def test_only_asks_for_what_characters_mean(self):
        traces = [character(code, TEN) for code in ("十", "\u2f17", "三")]
        for only in ("十", "\u2f17"):
            self.assertEqual(len(self.replay(*traces, options=("--only", only))["traces"]), 2)

    def test_a_recording_in_another_format_is_named_with_what_reads_it(self):
        (self.directory / "十.svc").write_text("2\n100 100 0 1\n300 120 100 1\n")
        self.assert_refused(1, ["replay", "十.svc"], "is SVC", "`calligraphy traces 十.svc -o pens.txt`")

    def test_a_typical_stroke_is_judged_alone(self):
        numbers = " ".join(map(str, range(1, 40)))
        strokes = json.loads(self.run_program("info", numbers, "--json").stdout)["text"]
        lines = []
        for row in strokes:
            points = row["strokes"][0]["control_points_em"]  # a polygon through them: the shape's outline, not its curves
            for turn, name in ((points, "forwards"), (points[::-1], "backwards")):
                samples = " ".join(f"{1000 * x:g} {1000 - 1000 * y:g} {100 * i}" for i, (x, y) in enumerate(turn))
                lines.append(f"C {row['character']} {ord(row['character']):X} {name} 1000 1\nS {len(turn)} {samples}\n")
        (self.directory / "strokes.txt").write_text("".join(lines))
        for trace in json.loads(self.run_program("replay", "strokes.txt", "--json").stdout)["traces"]:
            kinds = [remark["kind"] for remark in trace["remarks"]]
            self.assertEqual("direction" in kinds, trace["set"] == "backwards", trace)

    def test_a_file_whose_y_points_up_is_told_once_and_judged_the_right_way_round(self):
        def turned(lines):
            return [tuple((x, 1000 - y) for x, y in line) for line in lines]

        earth = [((200, 400), (800, 390)), ((500, 100), (500, 890)), ((120, 900), (880, 890))]
        tree = [((100, 350), (900, 340)), ((500, 80), (500, 940)), ((480, 350), (120, 750)), ((520, 350), (880, 740))]
        written = (("十", TEN), ("三", THREE), ("土", earth), ("木", tree))
        pupils = [character(code, turned(lines)) for code, lines in written]
        report = self.replay(*pupils)
        self.assertEqual([trace["remarks"] for trace in report["traces"]], [[], [], [], []])
        told = self.run_program("replay", "pens.txt").stderr
        self.assertEqual((told.count("y seems to point up"), len(report["warnings"])), (1, 1))
        left = self.replay(*pupils, options=("--y-axis", "down"))
        self.assertEqual(left["warnings"], [])
        self.assertEqual([remark["orientation"] for remark in left["traces"][0]["remarks"]], ["upside down"])
        alone = self.replay(pupils[0], options=("--y-axis", "up"))
        self.assertEqual((alone["warnings"], alone["traces"][0]["remarks"]), ([], []))

    def test_another_character_is_told_instead_of_its_strokes(self):
        ((remark,),) = [trace["remarks"] for trace in self.replay(character("二", TEN))["traces"]]
        self.assertEqual((remark["kind"], remark["other_character"]), ("character", "十"))
        table = self.run_program("replay", self.traces(character("二", TEN))).stdout
        self.assertIn("another character", table)

    def test_what_was_written_is_looked_up_on_request(self):
        report = self.replay(character("龘", TEN), character("三", THREE), options=("--recognise",))
        self.assertEqual([each["resembles"][0]["character"] for each in report["recognised"]], ["十", "三"])
        self.assertNotIn("recognised", self.replay(character("三", THREE)))
        table = self.run_program("replay", self.traces(character("龘", TEN)), "--recognise").stdout
        self.assertIn("1 龘  resembles: 十 0.0", table)

    def test_every_form_of_the_sets_is_accepted_unless_one_is_asked_for(self):
        provenance = "source {}\nlicence MIT\nattribution this test\n"
        (heng, shu) = ("stroke 1 0.1,0.5 0.9,0.53\n", "stroke 2 0.5,0.92 0.5,0.06\n")
        text = "calligraphy characters 2\n" + provenance
        (self.directory / "one.txt").write_text(text.format("One") + "character 十\n" + heng + shu)
        (self.directory / "two.txt").write_text(text.format("Two") + "character 十\n" + shu + heng +
                                                "character 十 order Kaisho\n" + heng + shu)
        sets = ("--characters", "one.txt", "--characters", "two.txt")
        swapped = character("十", TEN[::-1])
        (trace,) = self.replay(swapped, options=sets)["traces"]
        self.assertEqual((trace["remarks"], trace["source"], trace["accepted_forms"]), ([], "Two", 3))
        for order, source, mistakes, accepted in (("One", "One", 1, 1), ("Kaisho", "Two", 1, 1), ("Two", "Two", 0, 2)):
            (trace,) = self.replay(swapped, options=(*sets, "--order", order))["traces"]
            self.assertEqual((trace["source"], trace["order_mistakes"], trace["accepted_forms"]),
                             (source, mistakes, accepted))
        table = self.run_program("replay", self.traces(swapped), *sets).stdout
        self.assertIn("read as Two: 1 十", table)
        refused = self.run_program("replay", self.traces(swapped), *sets, "--order", "Three", code=1)
        self.assertIn('from the source "Three"', refused.stderr)

    def test_the_leniency_sets_what_is_told(self):
        slanted = character("三", [THREE[0], ((350, 700), (650, 272)), THREE[2]])  # by 55 degrees
        def told(leniency):
            (trace,) = self.replay(slanted, options=("--leniency", leniency))["traces"]
            return {(remark["kind"], remark["stroke"]) for remark in trace["remarks"]}
        self.assertLessEqual(told("lenient"), told("normal"))
        self.assertLess(told("normal"), told("strict"))

    def test_results_up_to_ctrl_c_are_saved(self):
        self.traces(*[character("三", THREE)] * 2000)
        printed, told = self.interrupted("replay", "pens.txt", "--out", "out", once="out/01-三.svg")
        self.assertIn("三", printed)
        report = json.loads((self.directory / "out/replay.json").read_text())
        replayed = len(report["traces"])
        self.assertTrue(report["interrupted"])
        self.assertEqual(told, f"calligraphy: interrupted after {replayed} of 2000 traces\n")
        self.assertEqual(len(list((self.directory / "out").glob("*.svg"))), replayed)

    def test_joined_strokes_are_not_an_order_mistake(self):
        lines = "".join(stroke(*line, 500 * i)[len("S 41"):] for i, line in enumerate(THREE[:2]))
        text = "C 三 4E09 made-up 1000 2\nS 82" + lines + "\n" + stroke(*THREE[2], 2000) + "\n"
        self.assertEqual(self.remarks(text), [[("joined", 1, 1)]])

    def test_missing_and_extra_strokes_are_reported(self):
        one, two, three = THREE
        self.assertEqual(self.remarks(character("三", [one, three])), [[("missing", None, 2)]])
        extra = ((950, 60), (990, 400))
        self.assertEqual(self.remarks(character("三", [one, two, three, extra])), [[("extra", 4, None)]])

    def test_the_pen_under_guidance_stays_within_the_limits_on_every_device(self):
        devices = [(device, "default") for device in ("omni", "touch", "desktop", "premium-1.5", "ideal")]
        for device, renderer in [*devices, ("desktop", "everything")]:
            with self.subTest(device=device, renderer=renderer):
                options = ["--device", "simulated:" + device, "--renderer", renderer]
                report = self.replay(character("三", THREE), options=options)
                self.assertEqual(report["renderer"], renderer)
                (trace,) = report["traces"]
                self.assertEqual(trace["faults"], 0)
                self.assertEqual(trace["strokes_completed"], 3)
                self.assertGreater(trace["peak_force_N"], 0.1)
                limit = report["peak_force_limit_N"]  # None for the ideal device
                self.assertLessEqual(trace["peak_force_N"], math.inf if limit is None else limit)
                self.assertLessEqual(trace["max_force_step_N"], report["force_step_limit_N"] * (1 + 1e-9))

    def test_the_output_directory_has_a_picture_of_each_trace_and_the_json(self):
        traces = self.traces(character("三", THREE[::-1]), character("十", TEN), character("〇", TEN, "other"))
        done = self.run_program("replay", traces, "--out", "deep/out", "--json")
        self.assertEqual(done.stderr, "", "no progress bar in a pipe")
        out = self.directory / "deep" / "out"
        record = self.record("deep/out", "replay.json")
        report = json.loads(done.stdout)
        self.assertEqual({key: record[key] for key in report}, report)
        self.assertEqual((record["finished"], record["command"]),
                         (True, ["replay", traces, "--out", "deep/out", "--json"]))
        self.assertEqual(record["files"], ["01-三.svg", "02-十.svg", "03-〇.svg"])
        self.assertEqual((record["device"]["model"], record["options"]["guidance.stiffness"], record["page"]["pose"]),
                         ("Phantom Desktop", "600", "upright"))
        pictures = sorted(path.name for path in out.glob("*.svg"))
        self.assertEqual(pictures, ["01-三.svg", "02-十.svg", "03-〇.svg"])
        for name in pictures:
            root = xml.parse(out / name).getroot()
            self.assertEqual(root.tag, SVG + "svg")
            self.assertLess((out / name).stat().st_size, 150000)
        root = xml.parse(out / "01-三.svg").getroot()
        group = {g.get("class"): g for g in root.iter(SVG + "g")}
        self.assertEqual([t.text for t in group["drawn-number"]], ["1", "2", "3"])
        self.assertEqual([t.text for t in group["standard-number"]], ["1", "2", "3"])
        colours = [p.get("stroke") for p in group["written"] if p.get("stroke") != "none"]
        self.assertEqual(colours, ["#e02020"] * 3)
        self.assertGreaterEqual(len(list(group["guided"])), 3)

    def test_templates_are_ink_or_lines(self):
        traces = self.traces(character("十", TEN))
        for options, style in ([], "fill"), (["--lines"], "stroke"):
            self.run_program("replay", traces, "--out", style, *options)
            groups = list(xml.parse(self.directory / style / "01-十.svg").getroot().iter(SVG + "g"))
            self.assertEqual([g.get(style) for g in groups if g.get("class") == "template"], ["#c5d6f7"] * 2)

    def test_only_requested_characters_are_replayed(self):
        texts = [character("三", THREE), character("十", TEN), character("三", THREE)]
        report = self.replay(*texts, options=["--only", "三"])
        self.assertEqual([trace["position"] for trace in report["traces"]], [1, 3])

    def test_a_character_without_a_template_is_named_and_does_not_affect_others(self):
        report = self.replay(character("\u9f98", TEN), character("十", TEN))
        self.assertEqual([trace["character"] for trace in report["traces"]], ["十"])
        self.assertEqual(report["without_template"], ["\u9f98"])

    def test_the_table_has_units_and_limits(self):
        text = self.run_program("replay", self.traces(character("三", THREE))).stdout
        for word in ("[N]", "[N/tick]", "3/3", "correct", "limits of"):
            self.assertIn(word, text)

    def test_the_same_run_gives_the_same_bytes(self):
        traces = self.traces(character("三", THREE[::-1]), character("十", TEN))
        first = self.run_program("replay", traces, "--json", "--out", "a")
        second = self.run_program("replay", traces, "--json", "--out", "b")
        self.assertEqual(first.stdout, second.stdout)
        for path in (self.directory / "a").glob("*.svg"):
            self.assertEqual(path.read_bytes(), (self.directory / "b" / path.name).read_bytes())
        records = [self.record(out, "replay.json") for out in "ab"]
        for record in records:
            for key in ("command", "date"):
                del record[key]
        self.assertEqual(*records)


class Form(ReplayTest):
    def setUp(self):
        super().setUp()
        (self.directory / "more.txt").write_text(MORE, encoding="utf-8")
        self.sets = ("--characters", str(BUILT_IN), "--characters", "more.txt")
        rows = json.loads(self.run_program("info", "刀三永明已己", *self.sets, "--json").stdout)["text"]
        self.templates = {row["character"]: [stroke["control_points_em"] for stroke in row["strokes"]] for row in rows}

    def told(self, code, strokes):
        """What is told of strokes through these points, y up: the table, and its trace in JSON."""
        lines = [" ".join(f"{1000 * x:g} {1000 - 1000 * y:g} {1000 * number + 100 * i}"
                          for i, (x, y) in enumerate(points)) for number, points in enumerate(strokes)]
        text = f"C {code} {ord(code):X} form 1000 {len(lines)}\n" + "".join(
            f"S {len(points)} {line}\n" for points, line in zip(strokes, lines))
        # A file of turned writing alone would be taken for one whose y points up.
        (trace,) = self.replay(text, options=(*self.sets, "--y-axis", "down"))["traces"]
        return self.run_program("replay", "pens.txt", *self.sets, "--y-axis", "down").stdout, trace

    def test_what_is_wrong_with_the_form_is_told(self):
        of = self.templates
        dao, yong, ming = of["刀"], of["永"], of["明"]
        mirrored = [[(1 - x, y) for x, y in points] for points in yong]
        exchanged = [[(x + (0.45 if i < 4 else -0.40), y) for x, y in points] for i, points in enumerate(ming)]
        for code, strokes, cells, kind, words in (
                ("永", mirrored, "unclear unclear mirrored or turned", "orientation", "永 is mirrored"),
                ("明", exchanged, "unclear unclear parts exchanged", "parts",
                 "strokes 1 (shù) to 4 (héng) belong at the left"),
                ("三", [of["三"][1]] * 3, "correct correct 1 too close", "overlap", "are too close to one another"),
                ("刀", [dao[0], [(0.525, 1.0), *dao[1]]], "correct correct 1 crossing", "crossing",
                 "Stroke 2 (piě) begins too high"),
                ("永", [[points[0], points[-1]] for points in yong], "correct correct 1 straight", "straight",
                 "The strokes are straight"),
                ("已", of["己"], "correct correct 1 not crossing", "no crossing",
                 "Stroke 3 (shùwāngōu) begins too low: here it becomes 己")):
            with self.subTest(character=code, kind=kind):
                table, trace = self.told(code, strokes)
                (remark,) = trace["remarks"]
                self.assertEqual((remark["kind"], remark["orientation"]),
                                 (kind, "mirrored" if kind == "orientation" else "upright"))
                self.assertIn(cells, " ".join(table.splitlines()[2].split()))
                self.assertIn(words, table)
                self.assertEqual(self.told(code, of[code])[1]["remarks"], [])
        (crossing,) = self.told("刀", [dao[0], [(0.525, 1.0), *dao[1]]])[1]["remarks"]
        self.assertEqual((crossing["stroke"], crossing["other_stroke"], crossing["end"]), (2, 1, "start"))
        self.assertAlmostEqual(crossing["amount_em"], 0.2, delta=0.1)


class Refusals(ReplayTest):
    def test_usage_errors_are_one_line_and_exit_with_two(self):
        traces = self.traces(character("十", TEN))
        for arguments, words in (
                ([], ["WHAT"]),
                ([traces, "--only", ""], ["TEXT"]),
                ([traces, "--device", "phantom"], ["--device", "simulated:", "desktop"]),
                ([traces, "--out", ""], ["--out"]),
                ([traces, "--renderer", "none"], ["--renderer"]),
                ([traces, "more"], ["more"])):
            with self.subTest(arguments=arguments):
                self.assert_refused(2, ["replay", *arguments], *words)

    def test_unusable_input_is_named(self):
        traces = self.traces(character("十", TEN))
        self.assert_refused(1, ["replay", "none.txt"], "none.txt")
        self.assert_refused(1, ["replay", traces, "--only", "三"], "三", "pens.txt")
        self.assert_refused(1, ["replay", traces, "--characters", "none"], "none")
        (self.directory / "bad.txt").write_text(character("十", TEN) + "S 1 0 0 0\n")
        self.assert_refused(1, ["replay", "bad.txt"], "bad.txt:4")
        (self.directory / "empty.txt").write_text("")
        self.assert_refused(1, ["replay", "empty.txt"], "empty.txt")
        (self.directory / "rare.txt").write_text(character("\u9f98", TEN))
        self.assert_refused(1, ["replay", "rare.txt"], "--characters")
