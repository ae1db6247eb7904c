"""Runs the program as a user would."""
import fcntl
import json
import os
import pty
import shutil
import signal
import subprocess
import tempfile
import termios
import time
import unittest
from pathlib import Path


# A background job ignores both, and so would the programs that it starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGQUIT, signal.SIG_DFL)
# A program under AddressSanitizer ends at a crash as it does without.
os.environ["ASAN_OPTIONS"] = os.environ.get("ASAN_OPTIONS", "") + ":handle_segv=0"


class ProgramTest(unittest.TestCase):
    """A test that runs the program in a temporary directory."""

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)

    def run_program(self, *arguments, code=0, environment=None):
        program = os.environ["CALLIGRAPHY_PROGRAM"]
        done = subprocess.run([program, *arguments], cwd=self.directory, capture_output=True, stdin=subprocess.DEVNULL,
                              env={**os.environ, **(environment or {})})
        done.stdout = done.stdout.decode()
        done.stderr = done.stderr.decode(errors="replace")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def run_on_emulated_phantom(self, *arguments, hand=(), code=0):
        """The program on a device behind the real libusb and hidapi (docs/emulated-phantom.md)."""
        emulated = os.environ.get("CALLIGRAPHY_EMULATED_PHANTOM")
        if not emulated or shutil.which("umockdev-wrapper") is None:
            if os.environ.get("CALLIGRAPHY_REQUIRE_DATA"):
                self.fail("umockdev and umockdev-wrapper are required")
            self.skipTest("no emulated Phantom: umockdev is missing")
        done = subprocess.run([emulated, *hand, "--", os.environ["CALLIGRAPHY_PROGRAM"], *arguments],
                              cwd=self.directory, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=600)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def on_emulated_phantom_in_terminal(self, *arguments, hand=(), once="", key=b""):
        """The program on an emulated device in a terminal of its own, in which `key` is pressed once its output contains
        `once`. Returns exit code, output, and the terminal's settings before, during and after."""
        emulated = os.environ.get("CALLIGRAPHY_EMULATED_PHANTOM")
        if not emulated or shutil.which("umockdev-wrapper") is None:
            self.skipTest("no emulated Phantom: umockdev is missing")
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        self.addCleanup(os.close, theirs)

        def in_its_own_session():
            os.setsid()
            fcntl.ioctl(theirs, termios.TIOCSCTTY, 0)

        settings = [termios.tcgetattr(theirs)]
        running = subprocess.Popen([emulated, *hand, "--", os.environ["CALLIGRAPHY_PROGRAM"], *arguments],
                                   cwd=self.directory, stdin=theirs, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   preexec_fn=in_its_own_session)
        told = b""
        while once.encode() not in told or len(settings) > 1:
            line = running.stderr.readline()
            if not line:
                break
            told += line
            if once.encode() in told and len(settings) == 1:
                settings.append(termios.tcgetattr(theirs))
                os.write(ours, key)
        code = running.wait(timeout=600)
        running.stderr.close()
        return code, told.decode(errors="replace"), [*settings, termios.tcgetattr(theirs)]

    def assert_refused(self, code, arguments, *words, environment=None):
        """Expects this exit code, a one-line message that contains `words`, and no files left behind."""
        before = self.files()
        done = self.run_program(*arguments, code=code, environment=environment)
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, r"\Acalligraphy: [^\n]+\n\Z")
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertEqual(self.files(), before)

    def interrupted(self, *arguments, once):
        """Sends Ctrl-C as soon as the file or directory `once` exists. Returns standard output and standard error."""
        running = subprocess.Popen([os.environ["CALLIGRAPHY_PROGRAM"], *arguments], cwd=self.directory,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while running.poll() is None and not (self.directory / once).exists():
            time.sleep(0.001)
        running.send_signal(signal.SIGINT)
        printed, told = running.communicate(timeout=600)
        self.assertEqual(running.returncode, -signal.SIGINT, told)  # so that a shell's loop ends too
        return printed, told

    def assert_interrupted_leaves_nothing(self, *arguments):
        """Sends Ctrl-C as soon as the output directory exists."""
        done = self.interrupted(*arguments, "--out", "out/new", once="out/new")
        self.assertEqual(done, ("", "calligraphy: interrupted\n"))
        self.assertEqual(self.files(), [])

    def summary(self, out="out"):
        return self.record(out)["results"]

    def record(self, out="out", name="summary.json"):
        """What the record of a run says."""
        return json.loads((self.directory / out / name).read_text())

    def contents(self):
        """Every file with its bytes."""
        return {path: (self.directory / path).read_bytes() for path in self.files()
                if (self.directory / path).is_file()}

    def killed(self, *arguments, once):
        """Ends the program without a warning as soon as the file `once` exists."""
        running = subprocess.Popen([os.environ["CALLIGRAPHY_PROGRAM"], *arguments], cwd=self.directory,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while running.poll() is None and not (self.directory / once).exists():
            time.sleep(0.001)
        running.kill()
        self.assertEqual(running.wait(600), -signal.SIGKILL)

    def files(self):
        return sorted(str(path.relative_to(self.directory)) for path in self.directory.rglob("*"))

    def data_directory(self):
        """The unpacked npm package hanzi-writer-data."""
        return self.package("CALLIGRAPHY_HANZI_WRITER_DATA")

    def package(self, variable):
        """The npm package, packed or unpacked, that this variable names."""
        path = os.environ.get(variable, "")
        if not path:
            if os.environ.get("CALLIGRAPHY_REQUIRE_DATA"):
                self.fail(f"{variable} is not set")
            self.skipTest(f"{variable} is not set")
        return path
