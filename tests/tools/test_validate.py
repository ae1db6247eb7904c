import json

from program import ProgramTest

HEAD = "calligraphy characters 2\nsource s\nlicence l\nattribution a\n\n"


class Validate(ProgramTest):
    def write(self, text):
        (self.directory / "own.txt").write_text(HEAD + text)
        return "own.txt"

    def test_suspicious_strokes_are_listed_with_character_stroke_and_kind(self):
        self.write("character 二\nstroke 1 0.9,0.7 0.1,0.7\nstroke 1 0.1,0.3 1.1,0.3\n"
                   "character 十\nstroke 1 0.1,0.5 0.9,0.52\nstroke 2 0.1,0.9 0.5,0.2\nstroke 1 0.3,0.504 0.6,0.512\n")
        done = self.run_program("validate", "own.txt")
        lines = done.stdout.splitlines()
        self.assertEqual([line.split(":")[:2] for line in lines[:-1]],
                         [["二 (U+4E8C) stroke 1", " direction"], ["二 (U+4E8C) stroke 2", " outside"],
                          ["十 (U+5341) stroke 2", " type"], ["十 (U+5341) stroke 3", " overlap"]])
        self.assertEqual(lines[-1], "4 warnings in 2 characters, 5 strokes")
        self.assertEqual(done.stderr, "", "no progress bar in a pipe")
        report = json.loads(self.run_program("validate", "own.txt", "--json").stdout)
        self.assertEqual((report["characters"], report["strokes"]), (2, 5))
        self.assertEqual([(warning["character"], warning["stroke"], warning["kind"]) for warning in report["warnings"]],
                         [("二", 1, "direction"), ("二", 2, "outside"), ("十", 2, "type"), ("十", 3, "overlap")])
        for warning in report["warnings"]:
            self.assertEqual(set(warning), {"character", "order", "stroke", "kind", "what"})

    def test_a_file_without_suspicious_strokes_has_no_warnings(self):
        self.write("character 一\nstroke 1 0.1,0.5 0.9,0.5\n")
        self.assertEqual(self.run_program("validate", "own.txt").stdout, "0 warnings in 1 character, 1 stroke\n")
        self.write("character 一\nstroke 1 0.1,0.5 0.9,0.5\n"
                   "character 一 order a\nstroke 1 0.1,0.5 0.9,0.5\ncharacter 一 order b\nstroke 1 0.9,0.7 0.1,0.7\n")
        self.assertEqual(self.run_program("validate", "own.txt").stdout.splitlines()[-1],
                         "1 warning in 1 character, 1 stroke, 2 alternate stroke orders")

    def test_known_faults_of_kanjivg_are_listed(self):
        package = self.package("CALLIGRAPHY_KANJIVG_TARBALL")
        report = json.loads(self.run_program("validate", package, "--only", "祭禁標勵一", "--json").stdout)
        found = {(warning["character"], warning["stroke"]): warning["what"] for warning in report["warnings"]
                 if warning["kind"] == "label"}
        for place in (("祭", 9), ("禁", 11), ("標", 13)):
            self.assertIn("is labelled ㇑ (竖) but has the shape of 12", found[place])
        self.assertTrue(any(character == "勵" and "label ６ is unknown" in what
                            for (character, _), what in found.items()))
        self.assertFalse(any(character == "一" for character, _ in found))

    def test_known_faults_of_hanzi_writer_data_are_listed_in_text_and_json_alike(self):
        hanzi = self.package("CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL")
        letters = self.package("CALLIGRAPHY_CNCHAR_ORDER_TARBALL")
        arguments = ("validate", hanzi, "--letters", letters, "--only", "瀝谗馋饧鬮瀾罵剎一")
        warnings = json.loads(self.run_program(*arguments, "--json").stdout)["warnings"]
        found = {(warning["character"], warning["stroke"], warning["kind"]) for warning in warnings}
        self.assertLessEqual({("瀝", 6, "length"), ("谗", 9, "fold"), ("馋", 10, "fold"), ("饧", 3, "fold"),
                              ("鬮", 14, "direction"), ("瀾", 14, "direction"), ("罵", 2, "type"),
                              ("剎", 4, "label")}, found)
        self.assertFalse(any(character == "一" for character, _, _ in found))
        lines = self.run_program(*arguments).stdout.splitlines()[:-1]
        self.assertEqual([line.split(": ", 2)[1:] for line in lines],
                         [[warning["kind"], warning["what"]] for warning in warnings])

    def test_a_letter_that_contradicts_a_bent_hook_is_listed(self):
        hanzi = self.package("CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL")
        letters = self.package("CALLIGRAPHY_CNCHAR_ORDER_TARBALL")
        done = self.run_program("validate", hanzi, "--letters", letters, "--only", "了")
        self.assertIn("了 (U+4E86) stroke 2: label: is labelled g (竖钩) but has the shape of 13", done.stdout)


class Refusals(ProgramTest):
    def test_a_malformed_or_missing_file_is_named(self):
        (self.directory / "bad.txt").write_text(HEAD + "character 北\nstroke 99 0,0 1,1\n")
        self.assert_refused(1, ["validate", "bad.txt"], "bad.txt:7", "99")
        self.assert_refused(1, ["validate", "none.txt"], "none.txt")
        self.assert_refused(1, ["validate", "/dev/zero"], "/dev/zero")

    def test_usage_errors_are_one_line_and_exit_with_two(self):
        for arguments, words in (([], ["FILE"]), (["a", "b"], ["b"]), (["a", "--threads", "0"], ["--threads"]),
                                 (["a", "--only", ""], ["TEXT"])):
            with self.subTest(arguments=arguments):
                self.assert_refused(2, ["validate", *arguments], *words)
