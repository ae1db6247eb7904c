// Files of a directory, a tarball or a zip, read into memory.
#pragma once

#include <cstddef>
#include <cstdint>
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
  std::vector<SourceFile> files;     ///< from a directory by path, from an archive in its order
  std::vector<SkippedFile> skipped;  ///< files that were not read, including links and devices
};

/// A text as it is redistributed: UTF-8 with '\n' line endings. @throws FormatError naming the place
std::string with_plain_line_ends(std::string_view text, const std::string& place);

/// What to do with a file of a source.
struct FilePlan {
  std::string skip_reason;   ///< empty: it is read
  bool is_list = false;      ///< has a character a line: may be larger, SourceLimits::list_bytes
  bool is_optional = false;  ///< skipped if it is too large, as it may have no character
};

/// Of a file, from its path within the source.
using FilePlanner = std::function<FilePlan(std::string_view path)>;

/// Reads the files of a directory (links are not followed), of a tarball (.tgz or .tar) or of a zip; nothing is
/// unpacked to disk. Any other regular file is the only one of its source.
/// @throws FileError if the source cannot be opened or read, or this build cannot read archives; FormatError naming
///         source and entry if it is damaged, exceeds the limits, or contains a path that leaves the archive
SourceFiles read_source(const std::filesystem::path& source, const FilePlanner& plan, const SourceLimits& limits = {});

/// The same for an archive, `format` as archive_format() names it.
SourceFiles read_archive(const std::filesystem::path& path, std::string_view format, const FilePlanner& plan,
                         const SourceLimits& limits);

/// Why a file of this size is skipped; empty: it is read. @throws FormatError naming it if it must not be so large
std::string size_reason(std::uintmax_t bytes, const FilePlan& plan, const SourceLimits& limits,
                        const std::string& name);

}  // namespace calligraphy
