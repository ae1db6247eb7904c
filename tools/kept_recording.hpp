// A recording in the output directory of a run, stored as it comes.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/practice/recording_file.hpp>

#include "gzip_file.hpp"
#include "output_directory.hpp"

namespace calligraphy::tools {

inline constexpr const char* partial_suffix = ".part";  ///< after it, until the recording is finished

/// Stores what a recording has gained, at least every tenth of a second while it is called. Until it is finished the
/// file has a name of its own: whatever stops the program, everything up to a moment before can be read from it.
class KeptRecording {
 public:
  /// @param name without the suffix, as in "page-1-force-1"
  KeptRecording(OutputDirectory& out, const std::string& name) : out_(out), name_(name + recording_suffix) {}

  /// For SessionOptions::keep. @throws FileError if it cannot be stored
  void take(const Recording& recording);
  /// Ends the file and gives it its name. @throws FileError
  void finish();
  /// Removes the file, if there is one.
  void discard();

  const std::string& name() const noexcept { return name_; }

 private:
  OutputDirectory& out_;
  std::string name_;
  std::optional<GzipWriter> file_;
  std::optional<RecordingWriter> writer_;
  double flushed_ = 0.0;  ///< when it was last [s]
};

/// Whether a file begins like a recording, compressed or not.
bool is_recording(const std::filesystem::path& path);

/// Reads a recording, compressed or not, whole or cut off. @throws FileError, FormatError
StoredRecording open_recording(const std::filesystem::path& path);

/// Where a recording belongs in a run, by its name "page-1-force-1": the number of its page and the repetition, from 1.
struct PlaceInRun {
  int page = 0;  ///< 0: the name does not say
  int repetition = 0;
};
PlaceInRun place_in_run(const std::filesystem::path& recording);

/// The recordings of a run in the order of its pages. @throws FileError if there is none
std::vector<std::filesystem::path> recordings_in(const std::filesystem::path& directory);

}  // namespace calligraphy::tools
