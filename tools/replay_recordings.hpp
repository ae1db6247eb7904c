// `calligraphy replay` of recordings: makes their forces again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <calligraphy/judge/judge_tolerances.hpp>
#include <calligraphy/judge/language.hpp>
#include <calligraphy/pictures/stroke_style.hpp>

#include "output_file.hpp"

namespace calligraphy::tools {

/// What is to be done with the recordings.
struct RecordingReplay {
  std::vector<std::filesystem::path> files;
  RunOutput out;  ///< nothing is written unless it names a directory
  JudgeTolerances tolerances;
  StrokeStyle style = StrokeStyle::ink;
  Language language;
  bool ticks = false;
  bool json = false;
};

/// Scores the recordings, whose forces are made again, and says whether they are those of then to the last bit.
/// @throws FileError, FormatError; Error if they are not
void replay_recordings(const RecordingReplay& replay);

}  // namespace calligraphy::tools
