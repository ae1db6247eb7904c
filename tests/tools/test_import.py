import contextlib
import gzip
import io
import json
import os
import pty
import random
import resource
import signal
import subprocess
import tarfile
import zipfile
import zlib
from pathlib import Path

from program import ProgramTest

HENG = '<path kvg:type="㇐" d="M10,50c30,0,60,-1,90,-2"/>'
SHU = '<path kvg:type="㇑" d="M50,10c0,30,0,60,0,85"/>'
FIELDS = {"file", "format", "bytes", "kind", "source", "licence", "attribution", "characters", "strokes",
          "alternate_orders", "within", "worst", "labels", "ids_used", "skipped", "notes"}


def svg(content=HENG, head=""):
    return f'{head}<svg viewBox="0 0 109 109"><g>{content}</g></svg>'


def member(name, content="", **fields):
    info = tarfile.TarInfo(name)
    data = content.encode() if isinstance(content, str) else content
    info.size = len(data)
    for key, value in fields.items():
        setattr(info, key, value)
    return info, data


class ImportTest(ProgramTest):
    @contextlib.contextmanager
    def on_terminal(self, *arguments):
        """The program, and its terminal output as a file that ends with the program."""
        terminal, end = pty.openpty()
        with open(terminal, "rb", buffering=0) as screen, \
                subprocess.Popen([os.environ["CALLIGRAPHY_PROGRAM"], *arguments], stderr=end,
                                 stdout=subprocess.DEVNULL, cwd=self.directory) as running:
            os.close(end)
            with contextlib.suppress(OSError):  # a terminal without writers ends with EIO
                yield running, screen

    def tar(self, *members, name="source.tgz", format=tarfile.PAX_FORMAT, mode="w:gz"):
        with tarfile.open(self.directory / name, mode, format=format) as tar:
            for info, data in members:
                tar.addfile(info, io.BytesIO(data))
        return name

    def write(self, name, content):
        path = self.directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return name

    def zip(self, files, compression=zipfile.ZIP_STORED, name="source.zip"):
        with zipfile.ZipFile(self.directory / name, "w", compression) as archive:
            for path, content in files.items():
                archive.writestr(path, content)
        return name

    def report(self, *arguments):
        return json.loads(self.run_program("import", *arguments, "-o", "out.txt", "--json").stdout)


class ImportResult(ImportTest):
    def test_the_measures_are_of_every_stroke_and_only_on_request(self):
        self.write("kanji/05341.svg", svg(HENG + SHU))
        self.assertNotIn("measures", self.report("kanji"))
        measures = self.report("kanji", "--report")["measures"]
        self.assertEqual([(row["character"], row["stroke"], row["id"]) for row in measures["strokes"]],
                         [("十", 1, 1), ("十", 2, 2)])
        self.assertEqual((measures["crossings"], measures["crossings_kept"]), (1, 1))
        self.assertEqual((measures["labelled"], measures["allowed_by_label"]), (2, 2))
        for row in measures["strokes"]:
            self.assertLess(row["frechet_em"], 0.01)
            self.assertAlmostEqual(row["length_em"], row["source_length_em"], delta=0.01)
        text = self.run_program("import", "kanji", "-o", "out.set", "--report").stdout
        self.assertIn("crossings of strokes kept                    100.00 %", text)

    def test_ink_is_kept_as_asked_for_and_measured_against_the_outlines(self):
        outline = "M 100 250 L 500 258 L 900 240 L 900 350 L 100 300 Z"
        self.write("data/一.json", json.dumps({"strokes": [outline], "medians": [[[110, 275], [890, 295]]]}))
        sizes, areas = [], []
        for ink in ("none", "half-widths", "full"):
            self.run_program("import", "data", "-o", f"{ink}.set", "--ink", ink)
            report = self.report("data", "--ink", ink, "--report", "--format", "text")
            self.assertEqual("ink" in report, ink != "none")
            self.assertEqual("\nink " in (self.directory / "out.txt").read_text(), ink != "none")
            sizes.append((self.directory / f"{ink}.set").stat().st_size)
            areas.append(max((row["iou_mean"] for row in report.get("ink", {}).values()), default=0.0))
        self.assertEqual(sizes, sorted(set(sizes)))
        self.assertGreater(areas[1], 0.8)
        self.assertGreaterEqual(areas[2], areas[1])
        text = self.run_program("import", "data", "-o", "out.set", "--report").stdout
        self.assertRegex(text, r"half-widths, offsets, shifts +\d+\.\d +0\.9")

    def test_a_directory_and_its_tarball_in_every_format_give_the_same_characters(self):
        for code in ("04e00", "05341"):
            self.write(f"package/dist/{code}.svg", svg(HENG + SHU))
        self.run_program("import", "package", "-o", "directory.txt", "--format", "text")
        expected = (self.directory / "directory.txt").read_bytes()
        self.assertIn("character 一", expected.decode())
        members = [member(f"package/dist/{code}.svg", svg(HENG + SHU)) for code in ("05341", "04e00")]
        for format in (tarfile.USTAR_FORMAT, tarfile.GNU_FORMAT, tarfile.PAX_FORMAT):
            for mode in ("w:gz", "w"):
                with self.subTest(format=format, mode=mode):
                    self.tar(*members, format=format, mode=mode)
                    self.run_program("import", "source.tgz", "-o", "tarball.txt", "--format", "text")
                    self.assertEqual((self.directory / "tarball.txt").read_bytes(), expected)

    def test_names_of_characters_are_read_from_every_kind_of_tar_header_in_every_locale(self):
        content = '{"medians":[[[100,400],[900,400]]]}'
        for format in (tarfile.USTAR_FORMAT, tarfile.GNU_FORMAT, tarfile.PAX_FORMAT):
            for name in ("一.json", "package/" + "long/" * 30 + "一.json"):
                if format == tarfile.USTAR_FORMAT and len(name) > 100:
                    continue
                with self.subTest(format=format, name=name):
                    self.tar(member(name, content), format=format)
                    self.assertEqual(self.report("source.tgz")["characters"], 1)

    def test_a_zip_is_read_in_every_locale_and_without_what_macos_adds(self):
        files = {"kanji/04e00.svg": svg(), "__MACOSX/kanji/._04e00.svg": b"\0", "kanji/.DS_Store": b"\0"}
        report = self.report(self.zip(files, zipfile.ZIP_DEFLATED))
        self.assertEqual((report["kind"], report["characters"]), ("KanjiVG", 1))
        self.assertEqual([(row["reason"], row["unusable"], row["count"]) for row in report["skipped"]],
                         [("not a character file", False, 2)])
        self.zip({"data/一.json": '{"medians":[[[100,400],[900,400]]]}'})
        for locale in ("C", "C.UTF-8"):
            self.run_program("import", "source.zip", "-o", "out.txt", environment={"LC_ALL": locale})

    def test_an_unusable_file_is_skipped_and_told_or_fails_a_strict_import(self):
        for code, content in ((0x4e00, svg()), (0x4e01, svg('<path d="M1,2B3,4"/>')), (0x4e03, "<svg")):
            self.write(f"data/{code:05x}.svg", content)
        done = self.run_program("import", "data", "-o", "out.txt", "--json")
        self.assertIn("2 unusable files: 04e01.svg: stroke 1: path data at byte 4", done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual(report["characters"], 1)
        self.assertEqual([row["files"] for row in report["skipped"] if row["unusable"]], [["04e03.svg"], ["04e01.svg"]])
        self.assert_refused(1, ["import", "data", "--strict", "-o", "out.txt"], "data: 04e01.svg: stroke 1")
        listed = self.run_program("validate", "data").stdout
        self.assertIn("04e03.svg: unusable: line 1: not XML", listed)
        self.assertIn("2 unusable files, and", listed)
        self.assertEqual(len(json.loads(self.run_program("validate", "data", "--json").stdout)["unusable"]), 2)
        self.assert_refused(1, ["validate", "data", "--strict"], "04e01.svg")

    def test_the_json_contains_the_whole_report(self):
        self.tar(member("package/04e00.svg", svg(HENG + SHU.replace("㇑", "㇒") + HENG.replace("㇐", "６"))),
                 member("package/04e00-VtFst.svg", svg()), member("package/03042.svg", svg()),
                 member("package/readme.md", "text"), member("package/link", type=tarfile.SYMTYPE, linkname="/etc"))
        report = self.report("source.tgz")
        self.assertEqual(set(report), FIELDS)
        self.assertEqual((report["kind"], report["format"], report["file"]), ("KanjiVG", "set", "out.txt"))
        self.assertEqual((report["characters"], report["strokes"]), (1, 3))
        self.assertEqual(report["bytes"], (self.directory / "out.txt").stat().st_size)
        self.assertEqual([row["error_em"] for row in report["within"]], [0.01, 0.02, 0.04])
        for row in report["within"]:
            self.assertEqual((row["strokes"], row["characters"]), (3, 1))
            self.assertEqual(row["strokes_share"], 1.0)
        self.assertEqual(len(report["worst"]), 3)
        self.assertEqual(sum(report["ids_used"].values()), 3)
        labels = report["labels"]
        self.assertEqual((labels["strokes"], labels["agreed"]), (2, 1))
        self.assertEqual([conflict["label"] for conflict in labels["conflicts"]], ["㇒", "６"])
        self.assertEqual(labels["conflicts"][1]["resolution"], "unknown")
        self.assertEqual({row["reason"]: row["files"] for row in report["skipped"]},
                         {"a link": ["package/link"], "an alternate order": ["package/04e00-VtFst.svg"],
                          "not a character file": ["package/readme.md"],
                          "not an ideograph": ["package/03042.svg"]})

    def test_the_tables_contain_what_the_json_contains(self):
        self.tar(member("package/04e00.svg", svg(HENG + SHU.replace("㇑", "㇒"))), member("package/03042.svg", svg()))
        done = self.run_program("import", "source.tgz", "-o", "out.txt")
        for words in ("1 character, 2 strokes from KanjiVG", "Attribution-Share Alike", "Ulrich Apel", "100.00 %",
                      "一 (U+4E00) stroke 1", "横", "of 2 strokes, geometry alone recognises 1", "㇒ looks like 2 竖",
                      "not an ideograph: package/03042.svg", "note: "):
            self.assertIn(words, done.stdout)
        self.assertEqual(done.stderr, "", "no progress bar in a pipe")

    def test_progress_is_shown_on_a_terminal(self):
        self.write("data/04e00.svg", svg())
        shown = b""
        with self.on_terminal("import", "data", "-o", "out.txt") as (running, screen):
            while part := screen.read(10000):  # the output so far, possibly part of a line
                shown += part
        self.assertEqual(running.returncode, 0)
        self.assertRegex(shown, rb"\A +0 % +\r.* +\r\Z")  # one line, removed at the end

    def test_standard_output_takes_the_place_of_a_file_and_the_report_steps_aside(self):
        self.write("data/05341.svg", svg(HENG + SHU))
        for asked in (["--format", "text"], ["--format", "set"]):
            self.run_program("import", "data", "-o", "out", *asked)
            done = subprocess.run([os.environ["CALLIGRAPHY_PROGRAM"], "import", "data", "-o", "-", *asked],
                                  cwd=self.directory, capture_output=True, check=True)
            self.assertEqual(done.stdout, (self.directory / "out").read_bytes())
            self.assertIn(b"1 character, 2 strokes", done.stderr)
        self.assertEqual(self.files(), ["data", "data/05341.svg", "out"])
        self.assert_refused(2, ["import", "data", "-o", "-", "--json"], "--json")

    def test_text_and_set_files_convert_without_loss(self):
        self.write("data/05341.svg", svg(HENG + SHU))
        self.write("data/05341-VtFst.svg", svg(SHU + HENG))
        self.run_program("import", "data", "-o", "first.txt", "--format", "text", "--alternates")
        self.run_program("import", "first.txt", "-o", "exact.set", "--precision", "exact")
        self.run_program("import", "exact.set", "-o", "second.txt", "--format", "text")
        self.assertEqual((self.directory / "first.txt").read_bytes(), (self.directory / "second.txt").read_bytes())
        self.run_program("write", "十", "--characters", "exact.set", "--out", "out", "--mode", "force")

    def test_alternate_orders_are_counted_as_info_counts_them(self):
        self.write("data/05341.svg", svg(HENG + SHU))
        self.write("data/05341-VtFst.svg", svg(SHU + HENG))
        self.write("data/04e00-Kaisho.svg", svg(HENG))  # has no standard order
        done = self.run_program("import", "data", "-o", "out.txt", "--alternates")
        self.assertIn(": 2 characters, 3 strokes, 1 alternate stroke order from KanjiVG\n", done.stdout)
        imported = self.report("data", "--alternates")
        told = json.loads(self.run_program("info", "out.txt", "--json").stdout)
        for count in ("characters", "strokes", "alternate_orders"):
            self.assertEqual(imported[count], told[count])
        self.assertRegex(self.run_program("info", "out.txt").stdout,
                         r"Characters +2\nStrokes +3\nAlternate stroke orders +1\n")

    def test_a_coarser_precision_makes_a_smaller_set_with_a_larger_error(self):
        for code in range(0x4e00, 0x4e40):
            self.write(f"data/{code:05x}.svg", svg(HENG + SHU))
        sizes, errors = [], []
        for precision in ("coarse", "standard", "fine", "exact"):
            self.run_program("import", "data", "-o", "out.set", "--precision", precision)
            info = json.loads(self.run_program("info", "out.set", "--json").stdout)
            self.assertEqual((info["characters"], info["strokes"]), (64, 128))
            self.assertIn("Ulrich Apel", info["attribution"])
            sizes.append(info["bytes"])
            errors.append(info["coordinate_error_em"])
        self.assertEqual(sizes, sorted(sizes))
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertEqual(errors[-1], 0.0)

    def test_only_requested_characters_are_imported(self):
        for code in ("04e00", "05341", "04e8c"):
            self.write(f"data/{code}.svg", svg())
        self.assertEqual(self.report("data", "--only", "十 一 永")["characters"], 2)
        done = self.run_program("import", "data", "-o", "out.txt", "--only", "十一永")
        self.assertIn("not in data: 永 (U+6C38)\n", done.stderr)
        self.assert_refused(1, ["import", "data", "-o", "none.txt", "--only", "永"], "requested")

    def test_the_stroke_letters_of_a_package_are_used(self):
        hanzi = self.package("CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL")
        letters = self.package("CALLIGRAPHY_CNCHAR_ORDER_TARBALL")
        report = self.report(hanzi, "--letters", letters, "--only", "永北京航空棻")
        self.assertEqual(report["characters"], 6)
        self.assertGreater(report["labels"]["strokes"], 30)
        self.assertEqual(report["labels"]["letters_unused"], ["棻"])


class Hostile(ImportTest):
    """Input that must not crash the program, exhaust memory or disk, or leave files behind."""

    def assert_fails(self, source, *words):
        self.assert_refused(1, ["import", source, "-o", "out.txt"], source, *words)

    def test_paths_that_leave_the_tarball_are_rejected(self):
        for path in ("../04e00.svg", "package/../../04e00.svg", "/tmp/04e00.svg", "package/.."):
            with self.subTest(path=path):
                self.assert_fails(self.tar(member("package/04e00.svg", svg()), member(path, svg())), path)

    def test_links_and_devices_are_skipped(self):
        self.tar(member("package/04e00.svg", svg()),
                 member("package/05341.svg", type=tarfile.LNKTYPE, linkname="package/04e00.svg"),
                 member("package/04e8c.svg", type=tarfile.SYMTYPE, linkname="/dev/zero"),
                 member("package/04e09.svg", type=tarfile.CHRTYPE, devmajor=1, devminor=5),
                 member("package/056db.svg", type=tarfile.FIFOTYPE))
        report = self.report("source.tgz")
        self.assertEqual(report["characters"], 1)
        self.assertEqual({row["reason"]: row["count"] for row in report["skipped"]},
                         {"a link": 2, "not a regular file": 2})

    def bounded(self, *arguments, megabytes=700):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
        sanitized = b"__asan_init" in Path(os.environ["CALLIGRAPHY_PROGRAM"]).read_bytes()  # reserves terabytes
        return subprocess.run([os.environ["CALLIGRAPHY_PROGRAM"], *arguments], cwd=self.directory, capture_output=True,
                              preexec_fn=None if sanitized else limit, timeout=300)

    def test_a_decompression_bomb_is_stopped_in_bounded_memory(self):
        def bomb(name):
            with gzip.open(self.directory / "bomb.tgz", "wb", compresslevel=1) as out:
                info = tarfile.TarInfo(name)
                info.size = 8 << 30
                out.write(info.tobuf())
                for _ in range(1000):
                    out.write(b"\0" * (1 << 20))
        for name, words in (("package/readme.txt", b"times its size"), ("package/04e00.svg", b"larger than the limit")):
            with self.subTest(name=name):
                bomb(name)
                done = self.bounded("import", "bomb.tgz", "-o", "out.txt")
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(b"bomb.tgz", done.stderr)
                self.assertIn(words, done.stderr)
                self.assertFalse((self.directory / "out.txt").exists())

    def test_a_sparse_file_larger_than_its_content_is_rejected(self):
        pax = {"GNU.sparse.major": "1", "GNU.sparse.minor": "0", "GNU.sparse.name": "package/04e00.svg",
               "GNU.sparse.realsize": str(1 << 40)}
        self.tar(member("package/x", b"1\n0\n0\n" + b"\0" * 506, pax_headers=pax))
        done = self.bounded("import", "source.tgz", "-o", "out.txt")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(b"source.tgz", done.stderr)

    def test_a_truncated_or_damaged_tarball_is_rejected(self):
        # Seeded: one in 15,000 such files unpacks to the same bytes although damaged (equal bytes copied from farther).
        tar = self.noisy_tar(files=16)
        whole = gzip.compress(tar, mtime=0)
        for length in (0, 1, 10, 11, 50, len(whole) // 2, len(whole) - 9, len(whole) - 1):
            with self.subTest(length=length):
                self.assert_fails(self.write("cut.tgz", whole[:length]))
        for at in (2, 3, len(whole) // 3, len(whole) // 2, len(whole) - 12, len(whole) - 6, len(whole) - 1):
            with self.subTest(at=at):
                damaged = bytearray(whole)
                damaged[at] ^= 0x15
                self.assert_fails(self.write("damaged.tgz", bytes(damaged)))
        for length in (300, 513, 1000, 5000):
            with self.subTest(tar=length):
                self.assert_fails(self.write("cut.tar", tar[:length]))
        for length in (2048, 4096, 16 * 2048, 16 * 2048 + 512):  # at the end of a file, before the end of the tar
            with self.subTest(tar=length):
                self.assert_fails(self.write("cut.tar", tar[:length]), "end-of-archive marker")
                self.assert_fails(self.write("cut.tgz", gzip.compress(tar[:length])), "end-of-archive marker")
        self.assertEqual(self.report(self.write("whole.tar", tar[:16 * 2048 + 1024]))["characters"], 16)

    def noisy_tar(self, files):
        """A tar of files that compress badly, 2 KiB each with its header."""
        noise = random.Random(1)
        return (self.directory / self.tar(
            *(member(f"package/{code:05x}.svg", svg(HENG + f"<!-- {noise.randbytes(500).hex()} -->"))
              for code in range(0x4e00, 0x4e00 + files)), name="source.tar", mode="w")).read_bytes()

    def test_a_tarball_truncated_where_a_file_and_a_buffer_end_is_rejected(self):
        """zlib's gzread() takes some of these for complete: all packed data was read, and its buffer was full."""
        whole = gzip.compress(self.noisy_tar(files=40), mtime=0)
        unpacker, sizes = zlib.decompressobj(wbits=31), [0]
        for byte in whole:
            sizes.append(sizes[-1] + len(unpacker.decompress(bytes([byte]))))
        cuts = [length for length, size in enumerate(sizes)
                for buffer in (1 << 14, 1 << 15, 1 << 16) if buffer <= size <= buffer + 300]
        self.assertGreater(len(cuts), 20)
        for length in cuts:
            with self.subTest(length=length):
                self.assert_fails(self.write("cut.tgz", whole[:length]), "ends too early")

    def test_gzip_data_of_several_members_or_with_trailing_data_is_read(self):
        tar = self.noisy_tar(files=16)
        self.write("whole.tgz", gzip.compress(tar))
        expected = self.report("whole.tgz")["characters"]
        self.assertEqual(expected, 16)
        for name, data in (("pieces", b"".join(gzip.compress(tar[at:at + 5000]) for at in range(0, len(tar), 5000))),
                           ("empty", gzip.compress(b"") + gzip.compress(tar) + gzip.compress(b"")),
                           ("behind", gzip.compress(tar) + bytes(1000) + b"and more")):
            with self.subTest(name=name):
                self.assertEqual(self.report(self.write("source.tgz", data))["characters"], expected)
        self.assert_fails(self.write("cut.tgz", gzip.compress(tar) + gzip.compress(b"more")[:-1]), "ends too early")

    def test_a_sparse_file_is_skipped_and_reported(self):
        (self.directory / "package").mkdir()
        self.write("package/04e00.svg", svg())
        with open(self.directory / "package/05341.svg", "wb") as file:
            file.truncate(900_000)
        subprocess.run(["tar", "-Sczf", "sparse.tgz", "package"], cwd=self.directory, check=True)
        report = self.report("sparse.tgz")
        self.assertEqual((report["characters"], [(row["reason"], row["count"]) for row in report["skipped"]]),
                         (1, [("a sparse file", 1)]))

    def test_invalid_sources_are_rejected(self):
        self.write("empty", "")
        self.write("picture.png", b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 4)
        self.write("gzip.gz", gzip.compress(b"no tar " * 1000))
        self.write("package.zip", b"PK\x03\x04" + bytes(1000))
        self.tar(name="nothing.tgz")
        (self.directory / "directory").mkdir()
        for source in ("empty", "picture.png", "gzip.gz", "package.zip", "nothing.tgz", "directory", "missing"):
            with self.subTest(source=source):
                self.assert_fails(source)
        self.assert_refused(1, ["import", "/dev/zero", "-o", "out.txt"], "/dev/zero")

    def test_excessive_entities_strokes_and_nesting_are_rejected(self):
        entities = "<!DOCTYPE svg [<!ENTITY a0 'x'>" + "".join(
            f"<!ENTITY a{i} '" + f"&a{i - 1};" * 10 + "'>" for i in range(1, 12)) + "]>"
        for name, content, words in (
                ("entities", svg('<path d="M&a11;"/>', entities), "expected a number"),
                ("strokes", svg(HENG * 1_000_000), "bytes"),
                ("many", svg('<path d="M1,2c1,1,2,2,3,3"/>' * 30_000), "256 strokes"),
                ("points", svg('<path d="M1,2' + "c9,0,-9,0,0,0" * 70_000 + '"/>'), "20000 points"),
                ("nested", "<svg viewBox='0 0 109 109'>" + "<g>" * 300_000, "not XML"),
                ("command", svg('<path d="M1,2B3,4"/>'), "stroke 1"),
                ("text", "永", "not XML")):
            with self.subTest(name=name):
                self.assert_fails(self.tar(member("package/04e00.svg", content), name=name + ".tgz"), words, "04e00.svg")
        for name, content in (("nested", "[" * 500_000), ("strokes", '{"medians":[' + "[[1,2]]," * 100_000 + "[[1,2]]]}"),
                              ("far", '{"medians":[[[1,2],[1e300,4]]]}')):
            with self.subTest(json=name):
                self.assert_fails(self.tar(member("package/永.json", content), name=name + ".tgz"), "永.json")

    def test_damaged_zips_and_paths_that_leave_them_are_rejected(self):
        whole = (self.directory / self.zip({"kanji/04e00.svg": svg()})).read_bytes()
        self.write("truncated.zip", whole[:-40])
        self.assert_fails("truncated.zip", "zip")
        self.write("damaged.zip", whole.replace(b"90,-2", b"90,-3"))  # stored: only the checksum tells
        self.assert_fails("damaged.zip", "04e00.svg", "CRC")
        self.assert_fails(self.zip({"../一.json": "{}"}), "leaves the zip")
        bomb = {f"{code:05x}.svg": " " * 1_000_000 for code in range(0x4e00, 0x4e20)}
        self.assert_fails(self.zip(bomb, zipfile.ZIP_DEFLATED), "100 times its size")

    def test_excessively_long_names_are_rejected(self):
        self.assert_fails(self.tar(member("x" * 5000 + "/04e00.svg", svg())), "512 bytes")

    def test_random_damage_never_crashes(self):
        members = [member(f"package/{code:05x}.svg", svg(HENG + SHU)) for code in range(0x4e00, 0x4e04)]
        whole = (self.directory / self.tar(*members, mode="w")).read_bytes()
        for seed in range(40):
            damaged = bytearray(whole)
            for step in range(8):
                place = (seed * 7919 + step * 104729) % (4 * 1024)
                damaged[place] = (seed * 31 + step * 17) % 256
            self.write("damaged.tar", bytes(damaged))
            done = subprocess.run([os.environ["CALLIGRAPHY_PROGRAM"], "import", "damaged.tar", "-o", "out.txt"],
                                  cwd=self.directory, capture_output=True)
            self.assertIn(done.returncode, (0, 1), done.stderr)


class Output(ImportTest):
    def test_an_existing_file_survives_a_failed_import(self):
        self.write("out.txt", "keep")
        self.write("data/04e00.svg", "no SVG")
        self.run_program("import", "data", "-o", "out.txt", code=1)
        self.assertEqual((self.directory / "out.txt").read_text(), "keep")
        self.assertEqual(self.files(), ["data", "data/04e00.svg", "out.txt"])

    def test_an_existing_file_survives_an_interrupted_import(self):
        self.write("out.txt", "keep")
        for code in range(0x4e00, 0x5600):
            self.write(f"data/{code:05x}.svg", svg((HENG + SHU) * 50))
        with self.on_terminal("import", "data", "-o", "out.txt") as (running, screen):
            shown = screen.read(1)  # the work has begun
            running.send_signal(signal.SIGINT)
            while part := screen.read(10000):
                shown += part
        self.assertEqual(running.returncode, -signal.SIGINT)
        self.assertIn(b"calligraphy: interrupted", shown)
        self.assertEqual((self.directory / "out.txt").read_text(), "keep")
        self.assertEqual([name for name in self.files() if not name.startswith("data")], ["out.txt"])

    def test_an_unwritable_output_file_is_named_before_the_import(self):
        self.write("data/04e00.svg", "no SVG")
        (self.directory / "directory").mkdir()
        self.assert_refused(1, ["import", "data", "-o", "none/out.txt"], "none/out.txt")
        self.assert_refused(1, ["import", "data", "-o", "directory"], "directory")
        self.assert_refused(1, ["import", "data", "-o", "/proc/out.txt"], "/proc/out.txt")

    def test_usage_errors_are_one_line_and_exit_with_two(self):
        self.write("data/04e00.svg", svg())
        for arguments, words in (([], ["SOURCE"]), (["data"], ["--out"]), (["data", "-o", ""], ["--out"]),
                                 (["data", "-o", "x", "--threads", "0"], ["--threads", "0"]),
                                 (["data", "-o", "x", "--threads", "x"], ["--threads", "x"]),
                                 (["data", "-o", "x", "--only", " "], ["TEXT"]),
                                 (["data", "-o", "x", "--format", "png"], ["--format", "png"]),
                                 (["data", "-o", "x", "--precision", "1"], ["--precision", "1"]),
                                 (["data", "-o", "x", "--format", "text", "--precision", "exact"], ["--precision"]),
                                 (["data", "-o", "x", "--unknown"], ["--unknown"]), (["a", "b", "-o", "x"], ["b"])):
            with self.subTest(arguments=arguments):
                self.assert_refused(2, ["import", *arguments], *words)
        self.assert_refused(1, ["import", "data", "-o", "x", "--letters", "none"], "none")
        for date in ("foo", "", "1\n2", "2026-02-29", "2026-13-01", "2026-1-2", "2026-01-02x", "-026-01-02"):
            self.assert_refused(2, ["import", "data", "-o", "x", "--date", date], "--date: ", "YYYY-MM-DD")

    def test_options_that_do_not_apply_to_the_source_are_refused(self):
        self.write("kanji/05341.svg", svg(HENG + SHU))
        self.write("hanzi/一.json", '{"medians":[[[100,400],[900,400]]]}')
        self.write("letters.js", """x=JSON.parse('{"一":"j"}')""")
        self.run_program("import", "kanji", "-o", "mine.txt", "--format", "text", "--date", "2024-02-29")
        self.assertIn("on 2024-02-29", (self.directory / "mine.txt").read_text())
        for source, option in (("mine.txt", ["--alternates"]), ("mine.txt", ["--all"]), ("hanzi", ["--alternates"]),
                               ("hanzi", ["--all"]), ("mine.txt", ["--letters", "letters.js"]),
                               ("kanji", ["--letters", "letters.js"]), ("mine.txt", ["--date", "2026-11-24"]),
                               ("mine.txt", ["--report"])):
            with self.subTest(source=source, option=option):
                self.assert_refused(2, ["import", source, "-o", "x", *option], option[0] + ": applies only to ")
        self.assert_refused(2, ["validate", "mine.txt", "--letters", "letters.js"], "--letters: applies only to hanzi")
