"""Runs the program as a person would."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path


class ProgramTest(unittest.TestCase):
    """A test with a directory of its own, where the program runs."""

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)

    def run_program(self, *arguments, code=0):
        program = os.environ["CALLIGRAPHY_PROGRAM"]
        done = subprocess.run([program, *arguments], cwd=self.directory, capture_output=True, stdin=subprocess.DEVNULL)
        done.stdout = done.stdout.decode()
        done.stderr = done.stderr.decode(errors="replace")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def assert_refused(self, code, arguments, *words):
        """One line that says where and what, and nothing left behind."""
        before = self.files()
        done = self.run_program(*arguments, code=code)
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, r"\Acalligraphy: [^\n]+\n\Z")
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertEqual(self.files(), before)

    def files(self):
        return sorted(str(path.relative_to(self.directory)) for path in self.directory.rglob("*"))

    def data_directory(self):
        """The unpacked npm package hanzi-writer-data."""
        return self.package("CALLIGRAPHY_HANZI_WRITER_DATA")

    def package(self, variable):
        """An npm package, packed or unpacked, that this variable names."""
        path = os.environ.get(variable, "")
        if not path:
            if os.environ.get("CALLIGRAPHY_REQUIRE_DATA"):
                self.fail(f"{variable} is not set")
            self.skipTest(f"{variable} is not set")
        return path
