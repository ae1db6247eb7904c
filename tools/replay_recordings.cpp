#include "replay_recordings.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <calligraphy/base/error.hpp>

#include "commands.hpp"
#include "counted.hpp"
#include "interrupt.hpp"
#include "kept_recording.hpp"
#include "output_directory.hpp"
#include "page_results.hpp"
#include "progress.hpp"
#include "run_record.hpp"

namespace calligraphy::tools {
namespace {

/// The name without the suffix.
std::string stem_of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return name.substr(0, name.find(recording_suffix));
}

/// "page-1-force-1.recording.gz: 12,345 ticks, linear: 600 N/m; the same forces to the last bit".
std::string description(const std::filesystem::path& file, const StoredRecording& stored) {
  const char* const forces = !stored.is_complete ? "incomplete: it was cut off, or whoever wrote it was stopped"
                             : !stored.has_same_forces ? "other forces than in the session"
                             : stored.recording.setup->has_own_law ? "the forces of an author's own law, as stored"
                                                                   : "the same forces to the last bit";
  return fmt::format("{}: {}, law {}; {}", file.filename().string(),
                     counted(stored.recording.samples.size(), "tick"), stored.recording.law, forces);
}

nlohmann::ordered_json json_of(const std::filesystem::path& file, const StoredRecording& stored) {
  const RecordingSetup& setup = *stored.recording.setup;
  return {{"file", file.filename().string()},
          {"ticks", stored.recording.samples.size()},
          {"rate_Hz", stored.recording.rate},
          {"mode", to_string(setup.mode)},
          {"law", stored.recording.law},
          {"complete", stored.is_complete},
          {"same_forces", stored.is_complete ? nlohmann::ordered_json(stored.has_same_forces) : nullptr},
          {"mapping", mapping_json(setup.mapping)},
          {"device", device_json(setup.device)},
          {"options", options_json(setup.renderer)}};
}

}  // namespace

void replay_recordings(const RecordingReplay& replay) {
  const Interrupt interrupt;
  std::optional<OutputDirectory> out;
  const std::filesystem::path to = replay.out.directory;
  for (const std::filesystem::path& file : replay.files) {
    std::error_code none;
    if (!to.empty() && std::filesystem::equivalent(file.parent_path().empty() ? "." : file.parent_path(), to, none)) {
      throw UsageError("--out: " + to.string() + " has the recordings that are replayed: choose another directory");
    }
  }
  Summary summary;
  PictureOptions pictures = {replay.style, replay.language, false, [&interrupt] { return interrupt.asked(); },
                             replay.tolerances};
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  std::string descriptions;
  std::map<std::pair<int, std::uint32_t>, PageInRun> pages;  // by number or id
  int next_position = 1, changed = 0, damaged = 0;
  Progress progress;
  for (std::size_t i = 0; i < replay.files.size(); ++i) {
    const std::filesystem::path& file = replay.files[i];
    interrupt.check();
    StoredRecording stored;
    try {
      stored = open_recording(file);
    } catch (const FormatError& error) {
      if (replay.files.size() == 1) throw;
      ++damaged;
      spdlog::error("{}", error.what());
      continue;
    }
    if (!to.empty() && !out) {  // now that something was read
      out.emplace(to, replay_file, replay.out.force);
      pictures.has_plots = can_plot(summary.warnings);
    }
    const Recording& recording = stored.recording;
    const PlaceInRun place = place_in_run(file);
    const std::pair<int, std::uint32_t> page = {place.page, place.page > 0 ? 0 : recording.page};
    const int number = place.page > 0 ? place.page : static_cast<int>(pages.size()) + 1;
    const auto [known, is_new] = pages.try_emplace(page, PageInRun{number, next_position, 1, {}});
    if (is_new) next_position += static_cast<int>(recording.setup->page.characters.size());
    PageInRun where = known->second;
    where.repetition = std::max(place.repetition, 1);
    summary.repetitions = std::max(summary.repetitions, where.repetition);
    descriptions += description(file, stored) + "\n";
    list.push_back(json_of(file, stored));
    changed += stored.is_complete && !stored.has_same_forces;
    std::vector<Result> results = results_of(recording, where, replay.tolerances);
    if (out) {
      if (replay.ticks) out->write(stem_of(file) + "-ticks.csv", ticks_table(recording));
      if (where.repetition == 1) draw_page(recording, where, pictures, *out, summary.warnings);
    }
    summary.results.insert(summary.results.end(), std::make_move_iterator(results.begin()),
                           std::make_move_iterator(results.end()));
    progress.show(static_cast<double>(i + 1) / static_cast<double>(replay.files.size()));
  }
  const auto order = [](const Result& a, const Result& b) {
    return std::tie(a.position, a.mode, a.repetition) < std::tie(b.position, b.mode, b.repetition);
  };
  std::sort(summary.results.begin(), summary.results.end(), order);
  nlohmann::ordered_json all = {{"recordings", list}};
  all.update(json(summary));
  if (out) {
    out->write("strokes.csv", strokes_table(summary.results));
    out->keep(all);
    out->finish();
  }
  fmt::print(output(), "{}", replay.json ? json_text(all)
                                         : descriptions + "\n" + table(summary, replay.language) +
                                               remarks(summary, replay.language));
  if (damaged > 0) throw Error(fmt::format("{} could not be read", counted(static_cast<std::size_t>(damaged), "recording")));
  if (changed > 0) {
    throw Error(fmt::format("the forces of {} are not those of the session: another version of the program wrote it, "
                            "ticks are missing, strokes were skipped or taken back, or the file was changed",
                            counted(static_cast<std::size_t>(changed), "recording")));
  }
}

}  // namespace calligraphy::tools
