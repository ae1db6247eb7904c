#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>

#include "../catch.hpp"

using namespace calligraphy;
namespace fs = std::filesystem;

namespace {

/// A temporary directory, removed at the end of the test.
struct Directory {
  fs::path path;
  Directory() {
    std::string name = (fs::temp_directory_path() / "calligraphy-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  ~Directory() { fs::remove_all(path); }
  auto entries() const { return std::distance(fs::directory_iterator(path), fs::directory_iterator()); }
};

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string error_of(const fs::path& path, const std::string& text) {
  try {
    write_file(path, text);
  } catch (const FileError& error) {
    return error.what();
  }
  return {};
}

/// During its lifetime no file can grow beyond `bytes`, as if the disk were full.
struct SmallDisk {
  rlimit before{};
  void (*handler)(int);
  explicit SmallDisk(rlim_t bytes) : handler(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before);
    rlimit limit = before;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
};

}  // namespace

TEST_CASE("a file is read completely, up to the given number of bytes", "[practice]") {
  const Directory directory;
  const fs::path path = directory.path / "text";
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 200000u}) {
    std::string all(size, 'x');
    if (size > 0) all.back() = '\0';
    write_file(path, all);
    CAPTURE(size);
    CHECK(read_file(path, size) == all);
    CHECK(read_file(path, size + 1) == all);
    if (size == 0) continue;
    const std::string reason = ": larger than the limit of " + std::to_string(size - 1) + " bytes";
    CHECK_THROWS_WITH(read_file(path, size - 1), path.string() + reason);
    CHECK_THROWS_AS(read_file(path, size - 1), FormatError);
  }
  CHECK_THROWS_WITH(read_file("/dev/zero", 10), "/dev/zero: is not a regular file");
  CHECK_THROWS_WITH(read_file(directory.path, 10), directory.path.string() + ": is not a regular file");
}

TEST_CASE("a written file has the given content byte for byte, and no other file is left behind", "[practice]") {
  const Directory directory;
  std::string all(100006, 'x');
  all.replace(0, 6, std::string("a\0b\r\n\xff", 6));
  for (const std::string& text : {std::string(), std::string("one"), all}) {
    write_file(directory.path / "out.txt", text);
    CHECK(content(directory.path / "out.txt") == text);
    CHECK(directory.entries() == 1);
  }
}

TEST_CASE("a name without a directory is written to the working directory", "[practice]") {
  const Directory directory;
  const fs::path before = fs::current_path();
  fs::current_path(directory.path);
  const std::string error = error_of("plain.txt", "text");
  fs::current_path(before);
  CHECK(error == "");
  CHECK(content(directory.path / "plain.txt") == "text");
}

TEST_CASE("a path that cannot be written is an error that names path and reason", "[practice]") {
  const Directory directory;
  write_file(directory.path / "file", "old");
  const fs::path inside_file = directory.path / "file" / "out.txt";
  const fs::path nowhere = directory.path / "missing" / "out.txt";
  CHECK(error_of(inside_file, "new") == inside_file.string() + ": cannot be written: Not a directory");
  CHECK(error_of(nowhere, "new") == nowhere.string() + ": cannot be written: No such file or directory");
  CHECK(error_of(directory.path, "new") ==
        directory.path.string() + ": cannot be written: it exists and is not a regular file");
  CHECK(content(directory.path / "file") == "old");
  CHECK(directory.entries() == 1);
}

TEST_CASE("a pipe and a character device are written to and stay what they are", "[practice]") {
  const Directory directory;
  const fs::path pipe = directory.path / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::string received;
  std::thread reader([&] { received = content(pipe); });
  check_can_write(pipe);
  write_file(pipe, "text");
  reader.join();
  CHECK(received == "text");
  CHECK(error_of(pipe, "text") == pipe.string() + ": cannot be written: no program reads this pipe");
  CHECK(fs::is_fifo(pipe));

  int ends[2] = {};
  REQUIRE(::pipe(ends) == 0);
  const std::string shells_name = "/dev/fd/" + std::to_string(ends[1]);
  check_can_write(shells_name);
  write_file(shells_name, "text");
  std::string bytes(4, '\0');
  CHECK(read(ends[0], bytes.data(), bytes.size()) == 4);
  CHECK(bytes == "text");
  close(ends[0]);
  close(ends[1]);

  check_can_write("/dev/null");
  CHECK(error_of("/dev/null", "text") == "");
  CHECK(fs::is_character_file("/dev/null"));
#ifdef __linux__
  CHECK(error_of("/dev/full", "text") == "/dev/full: cannot be written: No space left on device");
#endif
  CHECK(directory.entries() == 1);
}

TEST_CASE("a full disk leaves the old file unchanged and no partial new one", "[practice]") {
  const Directory directory;
  const fs::path path = directory.path / "out.txt";
  write_file(path, "old");
  // Small: fails when flushed. Large: fails while written.
  for (const std::size_t size : {std::size_t{2000}, std::size_t{1000000}}) {
    std::string error;
    {
      const SmallDisk disk(1000);
      error = error_of(path, std::string(size, 'x'));
    }
    CHECK(error == path.string() + ": cannot be written: File too large");
    CHECK(content(path) == "old");
    CHECK(directory.entries() == 1);
  }
}

TEST_CASE("a replaced file keeps its permissions, and a link to it stays a link", "[practice]") {
  const Directory directory;
  const fs::path path = directory.path / "private.txt", link = directory.path / "link.txt";
  write_file(path, "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("private.txt", link);
  write_file(link, "new");
  CHECK(fs::is_symlink(link));
  CHECK_FALSE(fs::is_symlink(path));
  CHECK(content(path) == "new");
  CHECK(fs::status(path).permissions() == (fs::perms::owner_read | fs::perms::owner_write));

  fs::create_symlink("missing.txt", directory.path / "dangling.txt");
  CHECK(error_of(directory.path / "dangling.txt", "new").find("the link is dangling") != std::string::npos);
}
