// Tarballs, read in memory; rejected if the build has no libarchive or no zlib.
#pragma once

#include "source_files.hpp"

namespace calligraphy {

SourceFiles read_tarball(const std::filesystem::path& path, const SkipReason& skip_reason, const SourceLimits& limits);

}  // namespace calligraphy
