// Tarballs and zips. zlib decompresses the former and verifies the checksums, which libarchive's filter does not;
// libarchive reads the tar inside. A zip is read by its directory, which is at its end: a truncated one has none.
#include "source_files.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include <locale.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

#include <archive.h>
#include <archive_entry.h>
#include <zlib.h>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

constexpr std::size_t max_path = 512;   // [byte]; of an entry
constexpr std::size_t end_mark = 1024;  // [byte]; zeros that end a tar; a tar of texts has no such run before
constexpr std::size_t ratio_judged_from = 16u << 20;  // [byte]; below this, any ratio is acceptable

/// The tar as a stream of bytes, within the limits, decompressed if it is gzip data. Uses inflate(), because gzread()
/// accepts truncated data if the output so far exactly fills its buffer. Stores errors, because libarchive cannot
/// propagate exceptions.
class Unpacker {
 public:
  Unpacker(const std::filesystem::path& path, const SourceLimits& limits)
      : name_(path.string()), limits_(limits), file_(std::fopen(path.c_str(), "rb")) {
    if (!file_) throw FileError(name_, "cannot be opened: " + std::generic_category().message(errno), errno);
    if (inflateInit2(&stream_, gzip_window) != Z_OK) throw std::bad_alloc();
    read_packed();
    is_packed_ = begins_member();
  }
  ~Unpacker() { inflateEnd(&stream_); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  /// The next bytes: returns their count, 0 at the end, -1 on failure.
  la_ssize_t next(const void** bytes) noexcept {
    std::size_t count = 0;
    if (is_packed_) {
      count = unpack();
      *bytes = unpacked_.data();
    } else {
      if (stream_.avail_in == 0) read_packed();
      count = stream_.avail_in;
      *bytes = stream_.next_in;
      stream_.avail_in = 0;
    }
    bytes_ += count;
    look_for_end_mark(std::span(static_cast<const unsigned char*>(*bytes), count));
    if (bytes_ > limits_.total_bytes) {
      fail("unpacks to more than " + std::to_string(limits_.total_bytes) + " bytes");
    } else if (bytes_ > ratio_judged_from &&
               static_cast<double>(bytes_) > limits_.unpacked_to_packed * static_cast<double>(packed_offset())) {
      fail("unpacks to more than " + std::to_string(static_cast<int>(limits_.unpacked_to_packed)) + " times its size");
    }
    return failure_.empty() ? static_cast<la_ssize_t>(count) : -1;
  }

  /// True once the zeros that end a tar were read. libarchive does not require them, and so would accept a tar
  /// truncated after a file.
  bool has_end_mark() const { return zeros_ >= end_mark; }

  const std::string& failure() const { return failure_; }
  std::string place() const { return " (packed byte " + std::to_string(packed_offset()) + ")"; }

 private:
  static constexpr int gzip_window = 15 + 16;  // zlib's value for any gzip data

  /// Only the first failure is reported.
  void fail(std::string what) noexcept {
    if (failure_.empty()) failure_ = std::move(what);
  }

  std::size_t packed_offset() const { return packed_bytes_ - stream_.avail_in; }

  void look_for_end_mark(std::span<const unsigned char> bytes) noexcept {
    for (std::size_t i = 0; i < bytes.size() && !has_end_mark(); ++i) zeros_ = bytes[i] == 0 ? zeros_ + 1 : 0;
  }

  void read_packed() noexcept {
    const std::size_t count = std::fread(packed_.data(), 1, packed_.size(), file_.get());
    if (std::ferror(file_.get()) != 0) fail("cannot be read");
    packed_bytes_ += count;
    stream_.next_in = packed_.data();
    stream_.avail_in = static_cast<uInt>(count);
  }

  bool begins_member() const { return stream_.avail_in > 0 && *stream_.next_in == 0x1F; }

  std::size_t unpack() noexcept {
    stream_.next_out = unpacked_.data();
    stream_.avail_out = static_cast<uInt>(unpacked_.size());
    while (stream_.avail_out > 0 && !is_at_end_ && failure_.empty()) {
      if (stream_.avail_in == 0) read_packed();
      if (stream_.avail_in == 0) {
        fail("the gzip data ends too early");
        break;
      }
      const int result = inflate(&stream_, Z_NO_FLUSH);
      if (result == Z_STREAM_END) {
        if (stream_.avail_in == 0) read_packed();
        is_at_end_ = !begins_member();  // like gzip, ignores trailing data that is not gzip
        inflateReset(&stream_);
      } else if (result != Z_OK) {
        fail(std::string("damaged gzip data: ") + (stream_.msg == nullptr ? "unreadable" : stream_.msg));
      }
    }
    return unpacked_.size() - stream_.avail_out;
  }

  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  std::string name_;
  SourceLimits limits_;
  std::unique_ptr<std::FILE, Close> file_;
  z_stream stream_{};
  bool is_packed_ = false;
  bool is_at_end_ = false;
  std::array<unsigned char, 1 << 16> packed_{};
  std::array<unsigned char, 1 << 16> unpacked_{};
  std::size_t packed_bytes_ = 0;  ///< read from the file
  std::size_t bytes_ = 0;         ///< of the tar
  std::size_t zeros_ = 0;         ///< in a row, until the end mark
  std::string failure_;
};

la_ssize_t next_bytes(archive* reader, void* unpacker, const void** bytes) {
  const la_ssize_t count = static_cast<Unpacker*>(unpacker)->next(bytes);
  if (count < 0) archive_set_error(reader, EIO, "unpacking failed");
  return count < 0 ? ARCHIVE_FATAL : count;
}

/// In the calling thread, while it exists: libarchive converts the names in a zip to the character set of the locale,
/// and fails in that of C. Without such a locale, everything stays as it is.
class Utf8Locale {
 public:
  Utf8Locale() : utf8_(newlocale(LC_CTYPE_MASK, "C.UTF-8", locale_t{})) {
    if (utf8_ != locale_t{}) before_ = uselocale(utf8_);
  }
  ~Utf8Locale() {
    if (utf8_ == locale_t{}) return;
    uselocale(before_);
    freelocale(utf8_);
  }
  Utf8Locale(const Utf8Locale&) = delete;
  Utf8Locale& operator=(const Utf8Locale&) = delete;

 private:
  locale_t utf8_;
  locale_t before_{};
};

/// Reads one tarball or zip.
class Archive {
 public:
  Archive(const std::filesystem::path& path, std::string_view format, const SourceLimits& limits)
      : name_(path.string()), is_zip_(format == "zip"), limits_(limits), reader_(archive_read_new()) {
    if (!reader_) throw std::bad_alloc();
    if (is_zip_) {
      constexpr std::size_t block = 1 << 16;  // [byte]
      archive_read_support_format_zip_seekable(reader_.get());
      check(archive_read_open_filename(reader_.get(), path.c_str(), block), "");
      packed_ = std::filesystem::file_size(path);
    } else {
      unpacker_ = std::make_unique<Unpacker>(path, limits);
      archive_read_support_format_tar(reader_.get());
      check(archive_read_open(reader_.get(), unpacker_.get(), nullptr, next_bytes, nullptr), "");
    }
  }

  SourceFiles read(const FilePlanner& plan) {
    SourceFiles found;
    archive_entry* entry = nullptr;
    std::size_t entries = 0;
    for (std::string last; next(entry, last);) {
      if (++entries > limits_.entries) fail(last, "more than " + std::to_string(limits_.entries) + " entries");
      const std::string path = path_of(entry, last);
      last = path;
      if (archive_entry_filetype(entry) == AE_IFDIR) continue;
      FilePlan file{kind_reason(entry)};
      if (file.skip_reason.empty()) file = plan(path);
      std::optional<std::string> text;
      if (file.skip_reason.empty()) text = text_of(entry, path, file);
      if (text) {
        found.files.push_back({path, std::move(*text)});
      } else {
        found.skipped.push_back({path, std::move(file.skip_reason)});
      }
    }
    if (!is_zip_) read_to_the_end();
    return found;
  }

 private:
  [[noreturn]] void fail(const std::string& entry, const std::string& what) const {
    const std::string place = entry.empty() ? "" : ": " + entry;
    throw FormatError(name_ + place + ": " + what);
  }

  /// Throws on failure. Warnings concern names in other alphabets, or attributes, which are not used.
  void check(int result, const std::string& entry) const {
    if (result >= ARCHIVE_WARN) return;
    const char* const message = archive_error_string(reader_.get());
    if (unpacker_ && !unpacker_->failure().empty()) fail(entry, unpacker_->failure() + unpacker_->place());
    const char* const kind = is_zip_ ? "zip: " : "tarball (a single file must not be packed): ";
    fail(entry, std::string("damaged, or not a ") + kind + (message == nullptr ? "unreadable" : message) +
                    (unpacker_ ? unpacker_->place() : ""));
  }

  bool next(archive_entry*& entry, const std::string& last) {
    const int result = archive_read_next_header(reader_.get(), &entry);
    if (result == ARCHIVE_EOF) return false;
    check(result, last.empty() ? "" : "after " + last);
    return true;
  }

  std::string path_of(archive_entry* entry, const std::string& last) const {
    const char* path = archive_entry_pathname_utf8(entry);
    if (path == nullptr) path = archive_entry_pathname(entry);
    if (path == nullptr) fail(last.empty() ? "" : "after " + last, "an entry without a readable name");
    std::string name(path);
    if (name.size() > max_path) {
      fail(name.substr(0, 60) + "...", "a name of more than " + std::to_string(max_path) + " bytes");
    }
    const std::filesystem::path parts(name);
    if (parts.is_absolute()) fail(name, "an absolute path");
    for (const std::filesystem::path& part : parts) {
      if (part == "..") fail(name, std::string("a path that leaves the ") + (is_zip_ ? "zip" : "tarball"));
    }
    return name;
  }

  static std::string kind_reason(archive_entry* entry) {
    const bool is_hard_link = archive_entry_hardlink(entry) != nullptr || archive_entry_hardlink_utf8(entry) != nullptr;
    if (is_hard_link || archive_entry_filetype(entry) == AE_IFLNK) return "a link";
    if (archive_entry_sparse_count(entry) > 0) return "a sparse file";
    if (archive_entry_is_encrypted(entry) != 0) return "encrypted";
    return archive_entry_filetype(entry) == AE_IFREG ? "" : "not a regular file";
  }

  /// Empty, with the reason in the plan, if the file is skipped for its size.
  std::optional<std::string> text_of(archive_entry* entry, const std::string& path, FilePlan& plan) {
    const la_int64_t size = archive_entry_size_is_set(entry) != 0 ? archive_entry_size(entry) : -1;
    if (size < 0) fail(path, "has no size");
    plan.skip_reason = size_reason(static_cast<std::uintmax_t>(size), plan, limits_, name_ + ": " + path);
    if (!plan.skip_reason.empty()) return std::nullopt;
    if (is_zip_) count_unpacked(static_cast<std::size_t>(size), path);
    std::string text(static_cast<std::size_t>(size), '\0');
    std::size_t at = 0;
    while (at < text.size()) {
      const la_ssize_t count = archive_read_data(reader_.get(), text.data() + at, text.size() - at);
      if (count < 0) check_data(count, path);
      if (count <= 0) fail(path, "is shorter than its " + std::to_string(size) + " bytes");
      at += static_cast<std::size_t>(count);
    }
    if (is_zip_) read_checksum(path, text.size());
    return text;
  }

  /// A warning while a zip is read concerns its data.
  void check_data(la_ssize_t result, const std::string& path) const {
    check(is_zip_ && result < 0 ? ARCHIVE_FATAL : static_cast<int>(result), path);
  }

  /// libarchive compares it at the end of the data.
  void read_checksum(const std::string& path, std::size_t size) {
    char more = 0;
    const la_ssize_t count = archive_read_data(reader_.get(), &more, 1);
    if (count < 0) check_data(count, path);
    if (count > 0) fail(path, "is longer than its " + std::to_string(size) + " bytes");
  }

  /// The limits that Unpacker keeps for a tarball.
  void count_unpacked(std::size_t bytes, const std::string& path) {
    unpacked_ += bytes;
    const std::string more = "unpacks to more than ";
    if (unpacked_ > limits_.total_bytes) fail(path, more + std::to_string(limits_.total_bytes) + " bytes");
    if (unpacked_ > ratio_judged_from &&
        static_cast<double>(unpacked_) > limits_.unpacked_to_packed * static_cast<double>(packed_)) {
      fail(path, more + std::to_string(static_cast<int>(limits_.unpacked_to_packed)) + " times its size");
    }
  }

  /// The data after the end of the tar contains the checksum of all of it.
  void read_to_the_end() {
    const void* bytes = nullptr;
    la_ssize_t count = 0;
    do {
      count = unpacker_->next(&bytes);
    } while (count > 0);
    if (count < 0) fail("", unpacker_->failure() + unpacker_->place());
    if (!unpacker_->has_end_mark()) fail("", "is truncated: it has no end-of-archive marker" + unpacker_->place());
  }

  struct Free {
    void operator()(archive* reader) const noexcept { archive_read_free(reader); }
  };

  std::string name_;
  bool is_zip_;
  SourceLimits limits_;
  std::unique_ptr<Unpacker> unpacker_;  ///< of a tarball
  std::uintmax_t packed_ = 0;           ///< size of a zip [byte]
  std::size_t unpacked_ = 0;            ///< read from a zip [byte]
  std::unique_ptr<archive, Free> reader_;
};

}  // namespace

SourceFiles read_archive(const std::filesystem::path& path, std::string_view format, const FilePlanner& plan,
                         const SourceLimits& limits) {
  const Utf8Locale locale;
  return Archive(path, format, limits).read(plan);
}

}  // namespace calligraphy
