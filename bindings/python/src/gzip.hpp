// Files compressed by gzip, through Python's zlib: the library itself needs none.
#pragma once

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <pybind11/pybind11.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/practice/recording_file.hpp>

namespace calligraphy::python {

namespace py = pybind11;

constexpr std::size_t max_text_bytes = 1 << 30;  ///< of a compressed file
constexpr int gzip_format = 15 + 16;             ///< zlib's wbits: the largest window, with gzip's header

/// Whether a file that is written is to be compressed.
inline bool is_named_gzip(const std::filesystem::path& path) { return path.extension() == ".gz"; }

/// Whether a file is compressed. @throws FileError as open_file()
inline bool is_gzip(const std::filesystem::path& path) {
  std::ifstream file = open_file(path);
  constexpr int magic_1 = 0x1f, magic_2 = 0x8b;
  return file.get() == magic_1 && file.get() == magic_2;
}

/// The content of a gzip file. Requires the GIL.
inline std::string deflated(std::string_view text) {
  using namespace py::literals;
  const py::object gzip = py::module_::import("gzip");
  return gzip.attr("compress")(py::bytes(text.data(), text.size()), 9, "mtime"_a = 0).cast<std::string>();
}

/// Whether a text that was cut off is of use.
enum class CutOff { refused, accepted };

/// The text in the content of a gzip file; of one that was cut off, all of it up to there. Requires the GIL.
/// @throws FormatError with the name of the file
inline std::string inflated(std::string_view content, const std::string& name, CutOff cut_off) {
  constexpr std::size_t piece = 1 << 16;  // becomes 66 MB at most
  const py::module_ zlib = py::module_::import("zlib");
  std::string text;
  bool is_whole = false;
  try {
    while (!content.empty()) {  // for each of several files in a row
      const py::object stream = zlib.attr("decompressobj")(gzip_format);
      is_whole = false;
      while (!content.empty() && !is_whole) {
        const std::string_view next = content.substr(0, piece);
        content.remove_prefix(next.size());
        text += stream.attr("decompress")(py::bytes(next.data(), next.size())).cast<std::string_view>();
        if (text.size() > max_text_bytes) throw FormatError(name + ": too large");
        is_whole = stream.attr("eof").cast<bool>();
        if (!is_whole) continue;
        const std::size_t rest = py::len(stream.attr("unused_data"));
        content = {next.data() + next.size() - rest, content.size() + rest};
      }
    }
  } catch (const py::error_already_set& error) {
    if (!error.matches(zlib.attr("error"))) throw;
    throw FormatError(name + ": the compressed data is damaged");
  }
  if (!is_whole && cut_off == CutOff::refused) throw FormatError(name + ": the compressed data is cut off");
  return text;
}

/// A recording in a file that is written while the recording is made, at least every quarter of a second while it is
/// called. Until it is finished the name of the file ends in .part: whatever stops the program, everything up to a
/// moment before can be read from it.
class Store {
 public:
  explicit Store(std::optional<std::filesystem::path> path) : path_(std::move(path)) {
    if (path_) partial_ = path_->string() + ".part";
  }
  /// Requires the GIL.
  ~Store() {
    try {
      if (file_ != nullptr) write(sync_flush);
    } catch (...) {  // what has been written so far can be read
    }
    if (file_ != nullptr) std::fclose(file_);
  }
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  explicit operator bool() const noexcept { return path_.has_value(); }
  bool is_open() const noexcept { return file_ != nullptr; }

  /// For SessionOptions::keep, with or without the GIL. @throws FileError
  void take(const Recording& recording) {
    if (!writer_) {
      if (std::filesystem::exists(*path_)) fail(*path_, EEXIST);
      errno = 0;
      file_ = std::fopen(partial_.c_str(), "wbx");
      if (file_ == nullptr) fail(partial_, errno);
      writer_.emplace(text_, recording);
    }
    writer_->add(recording);
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(250);
    const py::gil_scoped_acquire gil;
    write(sync_flush);
  }

  /// Ends the file and gives it its name. Requires the GIL. @throws FileError
  void finish() {
    if (!writer_) return;
    writer_->finish();
    write(finish_flush);
    errno = 0;
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(partial_, errno);
    std::error_code error;
    std::filesystem::rename(partial_, *path_, error);
    if (error) fail(*path_, error.value());
  }

 private:
  static constexpr const char* sync_flush = "Z_SYNC_FLUSH";
  static constexpr const char* finish_flush = "Z_FINISH";

  [[noreturn]] static void fail(const std::filesystem::path& path, int error) {
    throw FileError(path.string(), "cannot be written: " + std::generic_category().message(error), error);
  }

  /// Writes what has come since the last call, so that it can be read. Nothing more after a failure.
  void write(const char* flush) {
    if (has_failed_) return;
    has_failed_ = true;
    std::string text = std::exchange(text_, std::ostringstream()).str();
    if (is_named_gzip(*path_)) {
      const py::module_ zlib = py::module_::import("zlib");
      if (!stream_) stream_ = zlib.attr("compressobj")(9, zlib.attr("DEFLATED"), gzip_format, 9);
      const auto compressed = stream_.attr("compress")(py::bytes(text)).cast<std::string>();
      text = compressed + stream_.attr("flush")(zlib.attr(flush)).cast<std::string>();
    }
    errno = 0;
    const bool is_written = std::fwrite(text.data(), 1, text.size(), file_) == text.size();
    if (!is_written || std::fflush(file_) != 0) fail(partial_, errno);
    has_failed_ = false;
  }

  std::optional<std::filesystem::path> path_;
  std::filesystem::path partial_;
  std::FILE* file_ = nullptr;
  std::ostringstream text_;  ///< not written yet
  std::optional<RecordingWriter> writer_;
  py::object stream_;
  std::chrono::steady_clock::time_point next_ = {};
  bool has_failed_ = false;
};

}  // namespace calligraphy::python
