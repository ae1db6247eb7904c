#include "gzip_file.hpp"

#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>

namespace calligraphy::tools {
namespace {

constexpr int gzip_format = 15 + 16;  // the largest window, with gzip's header
constexpr int gzip_or_zlib = 15 + 32;
constexpr std::size_t block = 1 << 15;  ///< [bytes]

}  // namespace

class GzipWriter::Buffer : public std::streambuf {
 public:
  explicit Buffer(const std::filesystem::path& path) : path_(path) {
    errno = 0;
    file_ = std::fopen(path.c_str(), "wbx");
    if (file_ == nullptr) fail(errno);
    if (deflateInit2(&stream_, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_format, 9, Z_DEFAULT_STRATEGY) != Z_OK) {
      std::fclose(file_);
      throw std::bad_alloc();
    }
    setp(text_.data(), text_.data() + text_.size());
  }
  ~Buffer() override {
    deflateEnd(&stream_);
    if (file_ != nullptr) std::fclose(file_);
  }

  void finish() {
    compress(Z_FINISH);
    if (file_ != nullptr && std::fclose(std::exchange(file_, nullptr)) != 0 && error_ == 0) error_ = errno;
  }

  void check() const {
    if (error_ != 0) fail(error_);
  }

 protected:
  int_type overflow(int_type c) override {
    if (!compress(Z_NO_FLUSH)) return traits_type::eof();
    return traits_type::eq_int_type(c, traits_type::eof()) ? 0 : sputc(traits_type::to_char_type(c));
  }
  int sync() override { return compress(Z_SYNC_FLUSH) ? 0 : -1; }

 private:
  [[noreturn]] void fail(int error) const {
    throw FileError(path_.string(), "cannot be written: " + std::generic_category().message(error), error);
  }

  bool compress(int flush) {
    stream_.next_in = reinterpret_cast<Bytef*>(text_.data());
    stream_.avail_in = static_cast<uInt>(pptr() - pbase());
    do {
      stream_.next_out = compressed_.data();
      stream_.avail_out = static_cast<uInt>(compressed_.size());
      deflate(&stream_, flush);
      const std::size_t count = compressed_.size() - stream_.avail_out;
      errno = 0;
      if (error_ == 0 && std::fwrite(compressed_.data(), 1, count, file_) != count) error_ = errno;
    } while (stream_.avail_out == 0);
    errno = 0;
    if (error_ == 0 && flush != Z_NO_FLUSH && std::fflush(file_) != 0) error_ = errno;
    setp(text_.data(), text_.data() + text_.size());
    return error_ == 0;
  }

  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  int error_ = 0;  ///< of the first failure, after which nothing more is written
  z_stream stream_ = {};
  std::array<char, block> text_;
  std::array<Bytef, block> compressed_;
};

GzipWriter::GzipWriter(const std::filesystem::path& path)
    : std::ostream(nullptr), buffer_(std::make_unique<Buffer>(path)) {
  rdbuf(buffer_.get());
}

GzipWriter::~GzipWriter() = default;

void GzipWriter::finish() {
  buffer_->finish();
  check();
}

void GzipWriter::check() const { buffer_->check(); }

class GzipReader::Buffer : public std::streambuf {
 public:
  explicit Buffer(const std::filesystem::path& path) : path_(path), file_(open_file(path)) {
    if (inflateInit2(&stream_, gzip_or_zlib) != Z_OK) throw std::bad_alloc();
    constexpr int magic_1 = 0x1f, magic_2 = 0x8b;
    is_compressed_ = file_.get() == magic_1 && file_.get() == magic_2;
    file_.clear();
    file_.seekg(0);
  }
  ~Buffer() override { inflateEnd(&stream_); }

  bool was_cut_off() const noexcept { return was_cut_off_; }

 protected:
  int_type underflow() override {
    const std::size_t count = is_compressed_ ? inflate_some() : read_some(text_.data());
    setg(text_.data(), text_.data(), text_.data() + count);
    return count == 0 ? traits_type::eof() : traits_type::to_int_type(text_[0]);
  }

 private:
  std::size_t read_some(char* to) {
    file_.read(to, block);
    if (file_.bad()) throw FileError(path_.string() + ": cannot be read");
    return static_cast<std::size_t>(file_.gcount());
  }

  std::size_t inflate_some() {
    stream_.next_out = reinterpret_cast<Bytef*>(text_.data());
    stream_.avail_out = block;
    while (stream_.avail_out == block) {
      if (stream_.avail_in == 0) {
        stream_.next_in = reinterpret_cast<Bytef*>(compressed_.data());
        stream_.avail_in = static_cast<uInt>(read_some(compressed_.data()));
        if (stream_.avail_in == 0) {
          was_cut_off_ = !is_at_end_;
          break;
        }
      }
      const int result = inflate(&stream_, Z_SYNC_FLUSH);
      is_at_end_ = result == Z_STREAM_END;
      if (is_at_end_) inflateReset(&stream_);  // another may follow, as after `cat a.gz b.gz`
      if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR) {
        throw FormatError(path_.string() + ": the compressed data is damaged");
      }
    }
    return block - stream_.avail_out;
  }

  std::filesystem::path path_;
  std::ifstream file_;
  bool is_compressed_ = false;
  bool is_at_end_ = false;  ///< of what was compressed at once
  bool was_cut_off_ = false;
  z_stream stream_ = {};
  std::array<char, block> text_;
  std::array<char, block> compressed_;
};

GzipReader::GzipReader(const std::filesystem::path& path)
    : std::istream(nullptr), buffer_(std::make_unique<Buffer>(path)) {
  rdbuf(buffer_.get());
  exceptions(std::ios::badbit);  // so that what the buffer throws arrives
}

GzipReader::~GzipReader() = default;

bool GzipReader::was_cut_off() const noexcept { return buffer_->was_cut_off(); }

std::string unpacked(const std::string& path) {
  constexpr std::size_t most = 64 << 20;
  GzipReader in(path);
  std::string content;
  std::vector<char> block(1 << 16);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())), in.gcount() > 0) {
    content.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (content.size() > most) throw FormatError(path + ": larger than 64 MiB");
  }
  if (in.was_cut_off()) throw FormatError(path + ": the file is truncated");
  return content;
}

}  // namespace calligraphy::tools
