// The output directory of a run.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace calligraphy::tools {

/// Creates the directory and its parents if missing; the destructor removes those it created that are still empty, and
/// nothing else. No other run may use it in the meantime: the system's lock on the directory goes with the process,
/// however it ends. Where there are no such locks (some network file systems) it is not locked.
class OutputDirectory {
 public:
  /// @throws FileError naming the directory if no file can be written into it, or another run uses it
  explicit OutputDirectory(const std::filesystem::path& path);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  /// Writes the whole file or none. @throws FileError
  void write(const std::filesystem::path& name, std::string_view content) const;

 private:
  void create(const std::filesystem::path& path);
  void lock(const std::filesystem::path& path);
  void check_writable(const std::filesystem::path& path) const;
  void release() noexcept;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> created_;  ///< parents first
  int lock_ = -1;                               ///< descriptor of the locked directory; -1: not locked
};

}  // namespace calligraphy::tools
