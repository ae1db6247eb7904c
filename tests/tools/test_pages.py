"""The commands of the program in the documentation run, one after the other in one directory."""
import shutil
import sys
from pathlib import Path

from program import ProgramTest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "structure"))
from page_blocks import blocks
from test_commands import commands

#: Words of commands that are not run, because they need a real device.
NEED_DEVICE = {"openhaptics", "phantom", "probe"}
#: Commands that take long and that other tests run in smaller form.
LONG = {"tradeoff --out out", "stability --out out"}
#: Whole collections take minutes to import, so only these characters of them are.
SOME = "一永和九年福十三"


#: Recordings of a pen that a reader may have: two characters of a stroke each, and one in two other formats.
READERS_OWN = {
    "lesson.inkml": '<ink xmlns="http://www.w3.org/2003/InkML">'
                    + "<traceGroup><trace>1 1, 5 2, 9 1</trace></traceGroup>" * 2 + "</ink>",
    "永.json": '[{"points": [{"x": 1, "y": 1, "time": 1700000000000}, {"x": 9, "y": 2, "time": 1700000000200}]}]',
    "十-1.svc": "3\n100 100 0 1\n300 120 100 1\n500 100 200 1\n",
}


def documented_commands():
    """The arguments of each command once, and where it stands."""
    found = {}
    for block in blocks(ROOT):
        for words in commands(block.text) if block.language == "sh" else []:
            if words and Path(words[0]).name == "calligraphy":
                found.setdefault(tuple(words[1:]), f"{block.page}:{block.line}")
    return [(place, words) for words, place in found.items()
            if not NEED_DEVICE.intersection(words) and " ".join(words) not in LONG]


class Pages(ProgramTest):
    def test_the_commands_in_the_documentation_run(self):
        for name in ("HANZI_WRITER_DATA", "KANJIVG", "CNCHAR_ORDER"):
            package = self.package(f"CALLIGRAPHY_{name}_TARBALL")
            (self.directory / Path(package).name).symlink_to(package)
        shutil.copytree(ROOT / "examples", self.directory / "examples")
        shutil.copy(ROOT / "examples" / "pupil.txt", self.directory / "pens.txt")  # the reader's own
        for name, content in READERS_OWN.items():
            (self.directory / name).write_text(content, encoding="utf-8")
        for place, words in documented_commands():
            arguments, output = list(words), None
            if ">" in arguments:
                output = arguments[arguments.index(">") + 1]
                del arguments[arguments.index(">"):]
            if arguments[0] in ("import", "validate") and arguments[1].endswith(".tgz"):
                arguments += ["--only", SOME]
            with self.subTest(page=place, command=" ".join(words)):
                printed = self.run_program(*arguments).stdout
                if output:
                    (self.directory / output).write_text(printed, encoding="utf-8")
