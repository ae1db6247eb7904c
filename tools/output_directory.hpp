// The output directory of a run.
#pragma once

#include <filesystem>
#include <string_view>

namespace calligraphy::tools {

/// Creates the directory and its parents if missing; the destructor removes those it created that are still empty.
class OutputDirectory {
 public:
  /// @throws FileError naming the directory if no file can be written into it
  explicit OutputDirectory(const std::filesystem::path& path);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  /// Writes the whole file or none. @throws FileError
  void write(const std::filesystem::path& name, std::string_view content) const;

 private:
  void remove_empty() noexcept;

  std::filesystem::path path_;
  std::filesystem::path first_created_;  ///< empty: nothing was created
};

}  // namespace calligraphy::tools
