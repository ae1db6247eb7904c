// Errors of set-up: every one names the place and the value. The servo loop never throws.
#pragma once

#include <stdexcept>
#include <string>

namespace calligraphy {

/// Base of everything that this library throws.
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
};

/// Text or data that is not what it should be; the message names the source, the line where there is one, and the
/// value.
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
