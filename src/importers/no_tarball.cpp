#include <calligraphy/base/error.hpp>

#include "tarball.hpp"

namespace calligraphy {

SourceFiles read_tarball(const std::filesystem::path& path, const SkipReason&, const SourceLimits&) {
  throw FileError(path.string() +
                  ": tarballs cannot be read by this build, which was made without libarchive or zlib; "
                  "unpack it and name the directory");
}

}  // namespace calligraphy
