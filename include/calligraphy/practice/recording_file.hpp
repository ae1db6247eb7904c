// Recordings in files: what came in, exactly, and all that it takes to make the forces again (docs/recordings.md).
#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string_view>

#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// Writes a recording while it is made. What has been written so far can be read at any time, if the stream is flushed.
class RecordingWriter {
 public:
  /// Writes everything but the ticks. The stream must outlive the writer.
  /// @throws ValueError when the recording has no set-up
  RecordingWriter(std::ostream& out, const Recording& recording);
  /// After the move, the source may only be destroyed.
  RecordingWriter(RecordingWriter&&) noexcept;
  ~RecordingWriter();

  /// Writes the ticks that the recording has gained since the last call. The stream's state says whether it could.
  /// @throws ValueError when there is a tick without an input
  void add(const Recording& recording);
  /// Writes the end, without which a file counts as incomplete. Nothing may be added after it.
  void finish();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Writes a whole recording. @throws ValueError when it has no set-up, or a tick without an input
void write_recording(std::ostream& out, const Recording& recording);

/// A recording that was read, and what is known of the file.
struct StoredRecording {
  Recording recording;           ///< its ticks made again from its inputs (replayed())
  bool is_complete = false;      ///< the file has its end; otherwise whoever wrote it was stopped
  bool has_same_forces = false;  ///< the forces are those of the session to the last bit; false if incomplete
};

/// Reads what RecordingWriter wrote, whole or cut off anywhere after the set-up. `name` is used in messages.
/// @throws FormatError naming the line and the value; FileError when the stream fails
StoredRecording read_recording(std::istream& in, std::string_view name);
/// Reads a file in this format. @throws FileError when it cannot be opened, FormatError as above
StoredRecording read_recording(const std::filesystem::path& path);

/// Writes the ticks as comma-separated values, one line each, for R, spreadsheets and pandas: columns with their units in
/// the first line, rounded to 1 us, 0.1 um, 0.1 mN and 0.1 mrad; the time is since the first tick. Numbers are independent
/// of the locale; an unknown one is empty. Not to be read back.
void write_ticks(std::ostream& out, const Recording& recording);

}  // namespace calligraphy
