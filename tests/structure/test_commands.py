#!/usr/bin/env python3
"""Every command in README.md and docs/ exists, with its options, targets, tests, files and packages.

Read are the blocks of shell commands, and every `code` elsewhere that begins with a command of the project. What a
program of the project takes is looked up in its help (the program `calligraphy`) or in its source files.

usage: test_commands.py SOURCE_DIRECTORY [CALLIGRAPHY_PROGRAM]     without the program its options are not checked
"""
import fnmatch
import pathlib
import re
import shlex
import subprocess
import sys

from page_blocks import FENCE, LANGUAGES, blocks, pages

#: Programs of the system and commands of the shell, and those after whose own words another command follows.
SYSTEM = {"apt-get", "cc", "cp", "docker", "export", "groupadd", "kill", "man", "mypy", "printf", "tee", "udevadm",
          "usermod", "."}
BEFORE_OTHERS = {"sudo", "python", "python3", "in_test_bed.sh"}
#: Directories where a build puts programs, of which a page may leave out the first part.
BUILDS = re.compile(r"^(\.\./\.\./|\./|build-tests/release/|build/)")
#: What the documentation gives to cmake, beside targets and the project's own variables.
CMAKE = {"-S", "-B", "-G", "--build", "--install", "--prefix", "--target", "-DCMAKE_BUILD_TYPE", "-DCMAKE_PREFIX_PATH"}
#: First words of files, which are no commands.
FILE_HEADERS = {"characters", "recording", "wire"}


class Project:
    """What commands may name."""

    def __init__(self, root, program):
        self.root, self.program, self.helps = root, program, {}
        tracked = [path for top in ("benchmarks", "examples", "src", "tests", "tools", "bindings")
                   for path in (root / top).glob("**/CMakeLists.txt")]
        self.lists = {str(path.parent.relative_to(root)): path.read_text(encoding="utf-8")
                      for path in [root / "CMakeLists.txt", *tracked]}
        lists = "\n".join(self.lists.values())
        self.variables = set(re.findall(r"\b(?:option|set)\((CALLIGRAPHY_\w+)", lists))
        self.tests = {f"test_{path.name}": path for path in (root / "tests").glob("**")
                      if list(path.glob("test_*.cpp"))}
        makers = "add_executable|add_library|add_custom_target|calligraphy_on_demand|calligraphy_emulator_tests"
        self.targets = {"all", *self.tests, *re.findall(rf"\b(?:{makers})\((\w+)", lists)}
        script = (root / "scripts" / "test.sh").read_text(encoding="utf-8")
        self.packages = {"@".join(pair) for pair in re.findall(r"^fetch_data \w+ (\S+) (\S+)$", script, re.MULTILINE)}

    def find(self, word):
        """The source files of a script or program, or None."""
        place = pathlib.PurePosixPath(BUILDS.sub("", word))
        for script in (place, pathlib.PurePosixPath("tests/devices/phantom/emulator") / place,
                       pathlib.PurePosixPath("examples/python") / place):
            if place.suffix in (".py", ".sh") and (self.root / script).is_file():
                return [self.root / script]
        for directory in (place.parent, "tests" / place.parent):
            cmake = self.lists.get(str(directory), "")
            if re.search(rf"\((\w+ )*{re.escape(place.name)}\b", cmake) or place.name in self.tests:
                sources = self.tests.get(place.name, self.root / directory)
                return [path for ending in ("cpp", "hpp") for path in sources.glob(f"*.{ending}")]
        return None

    def help(self, words):
        """The help of the command of `calligraphy` that these words begin with."""
        for count in (2, 1):
            if len(words) >= count and all(re.fullmatch("[a-z]+", word) for word in words[:count]):
                command = tuple(words[:count])
                if command not in self.helps:
                    done = subprocess.run([self.program, "help", *command], capture_output=True, text=True)
                    self.helps[command] = done.stdout if done.returncode == 0 else None
                if self.helps[command]:
                    return self.helps[command]
        return None

    def mistakes(self, words):
        """What is wrong with a command, as a list of texts."""
        while words and re.fullmatch(r"\w+=\S*", words[0]):  # variables of the environment
            words = words[1:]
        if not words:
            return []
        first, rest = words[0], words[1:]
        name = pathlib.PurePosixPath(first).name
        options = [word.partition("=")[0] for word in rest if re.match(r"--?[A-Za-z]", word)]
        files = [word for word in re.findall(r"(?:^|[=\s])((?:data|examples|bindings)/\S+)", " ".join(rest))]
        wrong = [f"there is no file {path}" for path in files if not (self.root / path).exists()]
        wrong += [f"there is no variable {found}" for found in
                  re.findall(r"(?:-D|cmake\.define\.)(CALLIGRAPHY_\w+)", " ".join(rest)) if found not in self.variables]
        if name == "calligraphy":
            return wrong + self.mistakes_of_program(rest, options)
        if name == "cmake":
            wrong += [f"cmake has no option {option}" for option in options
                      if option not in CMAKE and not option.startswith("-DCALLIGRAPHY_")]
            targets = re.search(r"--target((?: \w+)+)", " ".join(rest))
            return wrong + [f"there is no target {target}" for target in (targets[1].split() if targets else [])
                            if target not in self.targets]
        if name == "npm":
            return wrong + [f"scripts/test.sh does not fetch {word}" for word in rest[1:] if word not in self.packages]
        if name == "pip":
            project = (self.root / "pyproject.toml").read_text(encoding="utf-8")
            extras = re.findall(r"^(\w+) = \[", project, re.MULTILINE)
            return wrong + [f"pyproject.toml has no extra {extra}"
                            for extra in re.findall(r"\.\[(\w+)\]", " ".join(rest)) if extra not in extras]
        if name in BEFORE_OTHERS and rest and not (name.startswith("python") and rest[0] == "-m"):
            return wrong + self.mistakes(rest)
        if name in SYSTEM or name in BEFORE_OTHERS:
            return wrong
        found = self.find(first)
        if found is None:
            return [f"there is no program or script {first}"]
        text = "\n".join(path.read_text(encoding="utf-8") for path in found)
        if name.startswith("test_") and not name.endswith(".py"):
            cases = re.findall(r'^TEST_CASE\("((?:[^"\\]|\\.)*)"', text, re.MULTILINE)
            return wrong + [f"no test of {name} is called {word}" for word in rest if not word.startswith("-")
                            if not fnmatch.filter(cases, word)]
        if name.endswith(".sh"):
            options += [word for word in rest if re.fullmatch("[a-z]+", word)]
        return wrong + [f"{first} does not know {option}" for option in options if not option.startswith("--benchmark_")
                        if not re.search(rf"(?<![\w-]){option}(?![\w-])", text)]

    def mistakes_of_program(self, rest, options):
        if self.program is None or (rest and rest[0] == "help" and self.help(rest[1:])):
            return []
        text = self.help(rest)
        if text is None:
            return [f"calligraphy has no command {' '.join(rest[:1])}"]
        known = set(re.findall(r"(?<![\w-])--?[A-Za-z][\w-]*", text))
        return [f"`calligraphy {rest[0]}` has no option {option}" for option in options if option not in known]


def commands(text):
    """The commands of shell text, each as a list of words."""
    for line in re.sub(r"\\\n", " ", text).splitlines():
        lexer = shlex.shlex(line, posix=True, punctuation_chars=";&|<>")
        lexer.whitespace_split = True
        words = []
        for word in lexer:
            if word in (";", "&&", "||", "|", "&", "--"):  # after -- stands a command that the first one starts
                yield words
                words = []
            else:
                words.append(word)
        yield words


def is_command(words):
    """Whether `code` of a page is a command: a script, or a program with arguments."""
    name = pathlib.PurePosixPath(words[0]).name if words else ""
    if len(words) < 2 or words[1] in FILE_HEADERS:
        return name.endswith((".py", ".sh"))
    return (name in {"calligraphy", "cmake", "npm", "pip", "sudo", "python", "python3"} or
            name.endswith((".py", ".sh")) or
            re.fullmatch(r"[\w.-]+(/[\w.-]+)+|test_\w+", words[0]) is not None)


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    project = Project(root, sys.argv[2] if len(sys.argv) > 2 else None)
    wrong = []

    def check(place, text):
        for words in commands(text):
            wrong.extend(f"{place}: {mistake}" for mistake in project.mistakes(words))

    for block in blocks(root):
        place = f"{block.page}:{block.line}"
        if block.language not in LANGUAGES:
            wrong.append(f"{place}: the language of the block is one of {', '.join(sorted(LANGUAGES))}")
        elif block.language == "sh":
            check(place, block.text)
    for page in pages(root):
        page_name = str(page.relative_to(root))
        text = FENCE.sub(lambda match: "\n" * match[0].count("\n"), page.read_text(encoding="utf-8"))
        for match in re.finditer(r"`([^`\n]+)`", text):
            code = match[1].replace("\\|", "|")
            if is_command(code.split()):
                check(f"{page_name}:{text.count(chr(10), 0, match.start()) + 1}", re.sub(r"\[.*", "", code))
        wrong.extend(f"{page_name}:{text.count(chr(10), 0, match.start()) + 1}: a fence must begin its line, as ```"
                     for match in re.finditer(r"^ *(?:```|~~~)", text, re.MULTILINE))
        wrong.extend(f"{page_name}:{text.count(chr(10), 0, match.start()) + 2}: a block without a fence"
                     for match in re.finditer(r"\n\n(?: {4}|\t)(?![\s*|-]|\d)\S", text))
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
