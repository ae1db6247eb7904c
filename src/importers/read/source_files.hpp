// Files of a directory or an npm tarball, read into memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/importers/character_import.hpp>

namespace calligraphy {

struct SourceFile {
  std::string path;  ///< within the source
  std::string text;
};

struct SourceFiles {
  std::vector<SourceFile> files;     ///< from a directory by path, from a tarball in its order
  std::vector<SkippedFile> skipped;  ///< files that were not read, including links and devices
};

/// A text as it is redistributed: UTF-8 with '\n' line endings. @throws FormatError naming the place
std::string with_plain_line_ends(std::string_view text, const std::string& place);

/// Returns why a file is skipped, given its path within the source; empty if it is to be read.
using SkipReason = std::function<std::string(std::string_view path)>;

/// Reads the files of a directory (links are not followed) or of a tarball (.tgz or .tar; nothing is unpacked to disk).
/// @throws FileError if the source cannot be opened or read, or this build cannot read tarballs; FormatError naming
///         source and entry if it is damaged, exceeds the limits, or contains a path that leaves the tarball
SourceFiles read_source(const std::filesystem::path& source, const SkipReason& skip_reason,
                        const SourceLimits& limits = {});

/// The same for a tarball.
SourceFiles read_tarball(const std::filesystem::path& path, const SkipReason& skip_reason, const SourceLimits& limits);

}  // namespace calligraphy
