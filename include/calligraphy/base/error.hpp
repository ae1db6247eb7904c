// Exceptions thrown during set-up. Messages name the place and the value. The servo loop never throws.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

/// Haptic guidance for writing Chinese characters. Everything public is declared here, except what serves the backend
/// for Phantom devices alone (calligraphy::phantom).
namespace calligraphy {

/// Base class of all exceptions thrown by this library.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument or option outside its domain; the message names it and its value.
class ValueError : public Error {
 public:
  using Error::Error;
};

/// A file or directory that cannot be opened, read, written or renamed; the message names it.
class FileError : public Error {
 public:
  using Error::Error;
  /// "path: what"; `code` is the system's errno, 0 if it gave none.
  FileError(std::string path, const std::string& what, int code = 0)
      : Error(path + ": " + what), path_(std::move(path)), code_(code) {}

  const std::string& path() const noexcept { return path_; }  ///< empty if unknown
  int code() const noexcept { return code_; }                 ///< errno, such as ENOENT; 0 if unknown

 private:
  std::string path_;
  int code_ = 0;
};

/// Malformed input; the message names the source, the line if there is one, and the value.
class FormatError : public Error {
 public:
  using Error::Error;
};

/// A device that cannot be opened or that failed.
class DeviceError : public Error {
 public:
  using Error::Error;
};

}  // namespace calligraphy
