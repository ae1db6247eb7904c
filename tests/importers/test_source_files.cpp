// Directories as sources; hostile tarballs are tested in tests/tools/test_import.py.
#include <sys/stat.h>

#include <string>

#include <calligraphy/base/error.hpp>

#include "../catch.hpp"
#include "../temporary_directory.hpp"
#include "importers/read/source_files.hpp"

namespace source_files_tests {

using namespace calligraphy;
namespace fs = std::filesystem;

namespace {

FilePlan take_all(std::string_view) { return {}; }

std::string complaint(const fs::path& source, const SourceLimits& limits = {}) {
  try {
    read_source(source, take_all, limits);
  } catch (const FormatError& error) {
    return std::string("FormatError ") + error.what();
  } catch (const FileError& error) {
    return std::string("FileError ") + error.what();
  }
  return {};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("files of a directory are read by path, byte for byte, and skipped ones are listed with the reason",
          "[practice]") {
  const TemporaryDirectory directory;
  const std::string binary("a\0b\r\n", 5);
  directory.write("b/2.txt", "two");
  directory.write("a.txt", binary);
  directory.write("b/1.txt", "");
  directory.write("c.txt", "no");
  const SourceFiles found = read_source(
      directory.path(), [](std::string_view path) { return FilePlan{path == "c.txt" ? "why" : ""}; });
  REQUIRE(found.files.size() == 3);
  CHECK(found.files[0].path == "a.txt");
  CHECK(found.files[0].text == binary);
  CHECK(found.files[1].path == "b/1.txt");
  CHECK(found.files[2].text == "two");
  REQUIRE(found.skipped.size() == 1);
  CHECK(found.skipped[0].path == "c.txt");
  CHECK(found.skipped[0].reason == "why");
}

TEST_CASE("links, pipes and files nested too deeply are skipped and listed", "[practice]") {
  const TemporaryDirectory directory;
  directory.write("plain.txt", "x");
  fs::create_symlink("/dev/zero", directory.path() / "device");
  fs::create_symlink("plain.txt", directory.path() / "link.txt");
  fs::create_directory_symlink("..", directory.path() / "up");
  REQUIRE(mkfifo((directory.path() / "pipe").c_str(), 0600) == 0);
  fs::path deep;
  for (int i = 0; i < 20; ++i) deep /= "d";
  directory.write(deep / "lost.txt", "x");
  const SourceFiles found = read_source(directory.path(), take_all);
  REQUIRE(found.files.size() == 1);
  REQUIRE(found.skipped.size() == 5);
  CHECK(has(found.skipped[0].reason, "nested more than 16 levels deep"));
  for (const std::size_t link : {1u, 2u, 4u}) CHECK(found.skipped[link].reason == "a link");
  CHECK(found.skipped[3].reason == "not a regular file");
}

TEST_CASE("a source that exceeds a limit is rejected with the limit", "[practice]") {
  const TemporaryDirectory directory;
  directory.write("a.txt", std::string(100, 'x'));
  directory.write("b.txt", std::string(100, 'x'));
  SourceLimits limits;
  limits.entry_bytes = 100;
  limits.total_bytes = 200;
  limits.entries = 2;
  CHECK(complaint(directory.path(), limits).empty());
  limits.entry_bytes = 99;
  CHECK(has(complaint(directory.path(), limits), "a.txt: larger than the limit of 99 bytes"));
  limits.entry_bytes = 100;
  limits.total_bytes = 199;
  CHECK(has(complaint(directory.path(), limits), "more than 199 bytes"));
  limits.total_bytes = 200;
  limits.entries = 1;
  CHECK(has(complaint(directory.path(), limits), "more than 1 entries"));
}

TEST_CASE("a missing source or a device is named", "[practice]") {
  const TemporaryDirectory directory;
  const fs::path none = directory.path() / "none";
  CHECK(complaint(none) == "FileError " + none.string() + ": no such file or directory");
  CHECK(has(complaint("/dev/zero"), "FileError /dev/zero: neither a directory nor a regular file"));
}

}  // namespace source_files_tests
