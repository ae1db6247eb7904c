#include <calligraphy/base/error.hpp>

#include "source_files.hpp"

namespace calligraphy {

SourceFiles read_archive(const std::filesystem::path& path, std::string_view format, const FilePlanner&,
                         const SourceLimits&) {
  throw FileError(path.string() + ": this build cannot read " + (format == "zip" ? "zips" : "tarballs") +
                  ", because libarchive or zlib was missing; unpack it and specify the directory");
}

}  // namespace calligraphy
