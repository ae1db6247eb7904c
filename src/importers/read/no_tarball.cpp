#include <calligraphy/base/error.hpp>

#include "source_files.hpp"

namespace calligraphy {

SourceFiles read_tarball(const std::filesystem::path& path, const SkipReason&, const SourceLimits&) {
  throw FileError(path.string() +
                  ": this build cannot read tarballs, because libarchive or zlib was missing; "
                  "unpack it and specify the directory");
}

}  // namespace calligraphy
