// Tarballs, read in memory; refused where the build has no libarchive or no zlib.
#pragma once

#include <calligraphy/importers/source_files.hpp>

namespace calligraphy {

SourceFiles read_tarball(const std::filesystem::path& path, const SkipReason& skip_reason, const SourceLimits& limits);

}  // namespace calligraphy
