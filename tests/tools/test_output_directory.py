import os
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
