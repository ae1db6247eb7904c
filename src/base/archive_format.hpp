// Recognises archives, which users pass by mistake instead of a character file.
#pragma once

#include <cstddef>
#include <string_view>

namespace calligraphy {

/// Bytes at the start of a file that suffice to recognise an archive.
inline constexpr std::size_t archive_start = 262;

/// "gzip", "zip" or "tar", from the first bytes of a file; empty if it is none of these.
inline std::string_view archive_format(std::string_view start) noexcept {
  constexpr std::string_view tar = "ustar";
  if (start.starts_with("\x1F\x8B")) return "gzip";
  if (start.starts_with("PK\x03\x04") || start.starts_with("PK\x05\x06")) return "zip";  // the latter is empty
  const bool is_tar = start.size() >= archive_start && start.substr(archive_start - tar.size(), tar.size()) == tar;
  return is_tar ? "tar" : "";
}

}  // namespace calligraphy
