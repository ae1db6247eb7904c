// The directory that a run fills.
#pragma once

#include <filesystem>
#include <string_view>

namespace calligraphy::tools {

/// Created when missing, with its parents; what was created and is still empty goes away again with this object.
class OutputDirectory {
 public:
  /// @throws FileError naming the directory when no file can be written into it
  explicit OutputDirectory(const std::filesystem::path& path);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  /// @throws FileError; the file is whole or not there
  void write(const std::filesystem::path& name, std::string_view content) const;

 private:
  void remove_empty() noexcept;

  std::filesystem::path path_;
  std::filesystem::path first_created_;  ///< empty: nothing was created
};

}  // namespace calligraphy::tools
