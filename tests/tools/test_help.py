import os
import pty
import re
import shutil
import subprocess
import unicodedata

from program import ProgramTest

COMMANDS = ["write", "strokes", "info", "tradeoff", "stability", "import", "traces", "validate", "replay", "devices", "help",
            "completion"]
PROFILES = ["omni", "touch", "desktop", "premium-1.5", "ideal"]
PAGES = [[], *([each] for each in COMMANDS), ["devices", "probe"], ["devices", "profile"], ["devices", "watch"]]


def columns(line):
    return sum(2 if unicodedata.east_asian_width(each) in "WF" else 1 for each in line)


class Help(ProgramTest):
    def test_each_command_is_described_with_an_example_within_the_width(self):
        for width in ("60", "80", "100"):
            for page in PAGES:
                with self.subTest(page=page, width=width):
                    text = self.run_program(*page, "--help", environment={"COLUMNS": width}).stdout
                    self.assertEqual(self.run_program("help", *page, environment={"COLUMNS": width}).stdout, text)
                    head, examples = text.split("\nExamples:\n")
                    examples, options = examples.split("\n\n", 1)
                    self.assertIn("Usage: " + " ".join(["calligraphy", *page]), head)
                    self.assertIn("-h, --help", options)
                    self.assertIn("calligraphy ", examples)
                    for line in examples.splitlines():
                        self.assertLessEqual(columns(line), 80)
                    for line in (head + options).splitlines():
                        self.assertLessEqual(columns(line), int(width), line)

    def test_an_example_tells_where_its_files_come_from(self):
        for page in PAGES:
            examples = self.run_program("help", *page).stdout.split("\nExamples:\n")[1].split("\n\n")[0]
            for file, source in (("hanzi.set", "import"), ("mine.profile", "profile"), ("mine.txt", "import"),
                                 ("pens.txt", "docs/pen-traces.md"), (".tgz", "npm pack")):
                if file in examples:
                    self.assertRegex(examples, rf"#.*{source}|{source} .*#", page)

    def test_the_width_is_that_of_the_terminal(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        os.set_blocking(ours, False)
        subprocess.run(["stty", "cols", "64"], stdin=theirs, check=True)
        subprocess.run([os.environ["CALLIGRAPHY_PROGRAM"], "help", "strokes"], stdout=theirs, stderr=theirs, check=True)
        text = os.read(ours, 100000).decode()
        os.close(theirs)
        self.assertGreater(max(map(columns, text.splitlines())), 50)
        self.assertLessEqual(max(map(columns, text.splitlines())), 64)

    def test_a_width_that_is_none_is_that_of_most_terminals(self):
        usual = self.run_program("help", "write", environment={"COLUMNS": "80"}).stdout
        for width in ("", "0", "-5", "abc", "100x", "1e2", "99999999999999999999999"):
            with self.subTest(width=width):
                text = self.run_program("help", "write", environment={"COLUMNS": width}).stdout
                self.assertEqual(text, usual)
        self.assertNotEqual(self.run_program("help", "write", environment={"COLUMNS": "100"}).stdout, usual)

    def test_without_arguments_the_commands_are_listed(self):
        done = self.run_program(code=2)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr, self.run_program("help").stdout)
        for command in COMMANDS:
            self.assertRegex(done.stderr, rf"(?m)^  {command} +\w")

    def test_the_version_is_printed(self):
        for option in ("-V", "--version"):
            self.assertRegex(self.run_program(option).stdout, r"\Acalligraphy \d+\.\d+\.\d+\n\Z")

    def test_what_follows_help_or_version_does_not_count(self):
        for word in ("foo", "--foo"):
            for option in ("-V", "--version", "-h", "--help"):
                self.assertEqual(self.run_program(option, word).stdout, self.run_program(option).stdout)
            self.assertEqual(self.run_program("write", "--help", word).stdout, self.run_program("help", "write").stdout)
        self.assertEqual(self.run_program("--version", "write").stdout, self.run_program("--version").stdout)
        self.assertEqual(self.run_program("--help", "write").stdout, self.run_program("help", "write").stdout)

    def test_a_mistyped_word_is_named_with_the_near_one(self):
        for arguments, message in (
                ("wriet 永", "unknown command wriet; did you mean write?"),
                ("devices prob", "unknown command prob; did you mean probe?"),
                ("help imprt", "unknown command imprt; did you mean import?"),
                ("help write extra", "unexpected argument extra: calligraphy write has no commands"),
                ("help devices watch extra", "unexpected argument extra: calligraphy devices watch has no commands"),
                ("-- write", "--: a command must come first; calligraphy --help lists them"),
                ("devices -- watch", "--: a command must come first; calligraphy devices --help lists them"),
                ("frobnicate", "unknown command frobnicate; calligraphy --help lists them"),
                ("write 永 --outt x", "unknown option --outt; did you mean --out?"),
                ("write --outt x 永", "unknown option --outt; did you mean --out?"),
                ("write 永 -out x", "unknown option -out; did you mean --out?"),
                ("write 永 --motion=2 -o x", "unknown option --motion; did you mean --motion-scale?"),
                ("devices watch --secnods 2", "unknown option --secnods; did you mean --seconds?"),
                ("write 永 -o x -q", "unknown option -q; calligraphy write --help lists them"),
                ("write 永 --frobnicate", "unknown option --frobnicate; calligraphy write --help lists them"),
                ("write 永 -o", "-o: its value is missing: -o, --out DIR"),
                ("write 永 --out --json", "--out: its value is missing: -o, --out DIR"),
                ("write 永 -o x --out y", "--out: given twice"),
                ("write 永 -o x --json=3", "--json=3: it takes no value"),
                ("write 永 和 -o x", "unexpected argument 和; quote words that belong together"),
                ("write -o - 永", "--out: several files are written, into a directory; ./- is one named -")):
            with self.subTest(arguments=arguments):
                self.assert_refused(2, arguments.split(), message + "\n")
        self.run_program("write", "--out=a b", "-o", "x", "永", code=2)
        self.run_program("write", "永", "--mode", "force", "-ox", "--seed", "3", "--")
        self.assertTrue((self.directory / "x/summary.json").exists())


class ForShells(ProgramTest):
    def made_by_the_build(self, name):
        return (os.path.join(os.path.dirname(os.environ["CALLIGRAPHY_PROGRAM"]), "share", name))

    def program(self, name):
        if shutil.which(name) is None:
            if os.environ.get("CALLIGRAPHY_REQUIRE_DATA"):
                self.fail(f"{name} is required")
            self.skipTest(f"{name} is missing")
        return name

    def test_the_manual_page_has_every_option_and_is_well_formed(self):
        page = self.run_program("help", "--man").stdout
        with open(self.made_by_the_build("calligraphy.1"), encoding="utf-8") as file:
            self.assertEqual(file.read(), page)
        done = subprocess.run([self.program("groff"), "-man", "-Tutf8", "-Kutf8", "-ww", "-P-cbou"], input=page.encode(),
                              capture_output=True)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        text = " ".join(done.stdout.decode().replace("\u2212", "-").split())
        for words in ("NAME calligraphy - haptic", "calligraphy write [OPTIONS] TEXT --out DIR", "EXIT STATUS",
                      "--motion-scale K", "-o, --out FILE", "devices watch", "calligraphy write 永 -o out"):
            self.assertIn(words, text)

    def test_documents_that_the_program_names_are_installed_with_it(self):
        built = os.path.dirname(os.environ["CALLIGRAPHY_PROGRAM"])
        subprocess.run(["cmake", "--install", built, "--prefix", self.directory], capture_output=True, check=True)
        named = re.findall(r"docs/[a-z-]+\.md", self.run_program("help", "--man").stdout.replace("\\-", "-"))
        self.assertIn("docs/wire-profile.md", named)
        for name in named:
            self.assertTrue((self.directory / "share/doc/calligraphy" / name).exists(), name)

    def completed_by_bash(self, line):
        words = line.split(" ")
        script = f"""source '{self.made_by_the_build("calligraphy")}'
compopt() {{ echo "$2"; }}
COMP_WORDS=({" ".join(f"'{word}'" for word in words)}); COMP_CWORD={len(words) - 1}
_calligraphy; printf '%s\\n' "${{COMPREPLY[@]}}" """
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, cwd=self.directory)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def offered_by_fish(self, line):
        """Words, with their descriptions after a tab."""
        script = f"""source '{self.made_by_the_build("calligraphy.fish")}'; complete -C '{line}'"""
        done = subprocess.run([self.program("fish"), "--no-config", "-c", script], capture_output=True, text=True,
                              cwd=self.directory, env={**os.environ, "HOME": str(self.directory)})
        self.assertEqual(done.stderr, "")
        return done.stdout.splitlines()

    def completed_by_fish(self, line):
        return [each.split("\t")[0] for each in self.offered_by_fish(line)]

    def completed_by_zsh(self, line):
        """Its line editor, in a terminal of its own, inserts what is unambiguous."""
        share = os.path.dirname(self.made_by_the_build("_calligraphy"))
        script = (f"fpath=('{share}' $fpath); autoload -U compinit; compinit -u -D; PS1='>'; unsetopt zle_bracketed_paste; "
                  "finish() { print -r -- \"<<$BUFFER>>\"; exit; }; zle -N finish; bindkey '^X' finish; "
                  "bindkey '^I' complete-word; LISTMAX=1000; calligraphy() {}")
        return self.typed(["zsh", "-f", "-i"], script, line)

    def inserted_by_bash(self, line):
        """As zsh; so it is tested where bash divides words."""
        script = (f"""source '{self.made_by_the_build("calligraphy")}'; PS1='>'; bind 'set bell-style none'; """
                  """finish() { printf '<<%s>>\\n' "$READLINE_LINE"; exit; }; bind -x '"\C-t": finish'""")
        return self.typed(["bash", "--norc", "-i"], script, line, end="\x14")

    def typed(self, shell, script, line, end="\x18"):
        """The line of this shell, in a terminal of its own, after a tab; `end` is the key that prints it."""
        ours, theirs = pty.openpty()
        running = subprocess.Popen([self.program(shell[0]), *shell[1:]], stdin=theirs, stdout=theirs, stderr=theirs,
                                   cwd=self.directory, start_new_session=True, env={**os.environ, "TERM": "dumb"})
        os.close(theirs)
        os.write(ours, f"{script}\n{line}\t{end}".encode())
        seen = b""
        try:
            while part := os.read(ours, 10000):
                seen += part
        except OSError:  # its end
            pass
        os.close(ours)
        running.wait(60)
        begin = seen.rfind(b"<<")
        self.assertGreater(begin, 0, seen)
        return seen[begin + 2:seen.rfind(b">>")].decode().replace("\r\n", "")

    def test_bash_completes_commands_options_and_values(self):
        (self.directory / "hanzi.set").write_text("")
        for line, words in (("calligraphy wr", ["write"]), ("calligraphy devices ", ["probe", "profile", "watch"]),
                            ("calligraphy write 永 --mo", ["--mode", "--model", "--motion-scale"]),
                            ("calligraphy write --mode f", ["force"]), ("calligraphy write --mode = f", ["force"]),
                            ("calligraphy write --mode =", ["both", "vision", "force"]),
                            ("calligraphy write --device pre", ["premium-1.5"]),
                            ("calligraphy write 永 --out ", ["dirnames"]), ("calligraphy import han", ["default"]),
                            ("calligraphy devices profile om", ["omni"]), ("calligraphy completion z", ["zsh"]),
                            ("calligraphy help wr", ["write"]), ("calligraphy help devices pr", ["probe", "profile"]),
                            ("calligraphy help write ", []), ("calligraphy help write --m", ["--man"]),
                            ("calligraphy devices watch ", ["phantom", "openhaptics"]),
                            ("calligraphy write --wire-profile ", ["filenames", "omni", "simulated", "hanzi.set"]),
                            ("calligraphy write --device simul", [f"simulated:{name}" for name in PROFILES]),
                            ("calligraphy replay --device simulated :", PROFILES),
                            ("calligraphy replay --device simulated : o", ["omni"]),
                            ("calligraphy replay --device = simulated : o", ["omni"]),
                            ("calligraphy stability --grip ", ["soft", "normal", "firm"])):
            with self.subTest(line=line):
                self.assertEqual(self.completed_by_bash(line), words)

    def test_bash_inserts_what_follows_a_colon(self):
        (self.directory / "hanzi.set").write_text("")
        for line, completed in (("calligraphy write --device simul", "calligraphy write --device simulated:"),
                                ("calligraphy write --device simulated:o",
                                 "calligraphy write --device simulated:omni "),
                                ("calligraphy write --device=simulated:o",
                                 "calligraphy write --device=simulated:omni "),
                                ("calligraphy write --wire-profile h", "calligraphy write --wire-profile hanzi.set "),
                                ("calligraphy write --mode=f", "calligraphy write --mode=force ")):
            with self.subTest(line=line):
                self.assertEqual(self.inserted_by_bash(line), completed)

    def test_fish_completes_commands_options_and_values(self):
        (self.directory / "hanzi.set").write_text("")
        for line, words in (("calligraphy wr", ["write"]), ("calligraphy devices pro", ["probe", "profile"]),
                            ("calligraphy write 永 --mo", ["--mode", "--model", "--motion-scale"]),
                            ("calligraphy write --mode f", ["force"]), ("calligraphy import han", ["hanzi.set"]),
                            ("calligraphy completion z", ["zsh"]), ("calligraphy help wr", ["write"]),
                            ("calligraphy help devices pr", ["probe", "profile"]), ("calligraphy help write ", []),
                            ("calligraphy devices watch ", ["openhaptics", "phantom"]),
                            ("calligraphy write --wire-profile ", ["hanzi.set", "omni", "simulated"]),
                            ("calligraphy write --device simulated:o", ["simulated:omni"]),
                            ("calligraphy stability --grip ", ["firm", "normal", "soft"])):
            with self.subTest(line=line):
                self.assertEqual(self.completed_by_fish(line), words)

    def test_fish_does_not_repeat_the_description_of_an_option_with_each_value(self):
        self.assertRegex(self.offered_by_fish("calligraphy write --mod")[0], r"\A--mode\tVision only")
        self.assertEqual(self.offered_by_fish("calligraphy write --mode "), ["both", "force", "vision"])

    def test_zsh_completes_commands_options_and_values(self):
        (self.directory / "hanzi.set").write_text("")
        for line, completed in (("calligraphy wr", "calligraphy write "),
                                ("calligraphy write 永 --tol", "calligraphy write 永 --tolerance="),
                                ("calligraphy write --mode f", "calligraphy write --mode force "),
                                ("calligraphy write --mode=f", "calligraphy write --mode=force "),
                                ("calligraphy import x -ohan", "calligraphy import x -ohanzi.set "),
                                ("calligraphy import x --out=h", "calligraphy import x --out=hanzi.set "),
                                ("calligraphy devices prof", "calligraphy devices profile "),
                                ("calligraphy import han", "calligraphy import hanzi.set "),
                                ("calligraphy devices profile om", "calligraphy devices profile omni "),
                                ("calligraphy completion f", "calligraphy completion fish "),
                                ("calligraphy help wr", "calligraphy help write "),
                                ("calligraphy help devices prof", "calligraphy help devices profile "),
                                ("calligraphy devices watch ph", "calligraphy devices watch phantom "),
                                ("calligraphy write --wire-profile om", "calligraphy write --wire-profile omni "),
                                ("calligraphy write --wire-profile h", "calligraphy write --wire-profile hanzi.set "),
                                ("calligraphy write --device simul", "calligraphy write --device simulated:"),
                                ("calligraphy write --device simulated:o",
                                 "calligraphy write --device simulated:omni "),
                                ("calligraphy stability --grip s", "calligraphy stability --grip soft ")):
            with self.subTest(line=line):
                self.assertEqual(self.completed_by_zsh(line), completed)
