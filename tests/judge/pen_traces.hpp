// Pen traces for tests: people's, where available, and synthetic ones.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/model/character_set.hpp>

#include <judge/pens/resemblance.hpp>

#include "../catch.hpp"

namespace calligraphy_test {

/// Every trace in the directory named by CALLIGRAPHY_PEN_TRACES, or none with the reason printed: no package provides
/// them, so no test may require them.
inline std::vector<calligraphy::PenTrace> traces_of_people() {
  const char* const directory = std::getenv("CALLIGRAPHY_PEN_TRACES");
  std::vector<calligraphy::PenTrace> all;
  if (directory == nullptr || *directory == '\0') {
    WARN("skipped: CALLIGRAPHY_PEN_TRACES names no directory of pen traces");
    return all;
  }
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() != ".txt") continue;
    for (calligraphy::PenTrace& trace : calligraphy::read_pen_traces(entry.path().string())) {
      all.push_back(std::move(trace));
    }
  }
  REQUIRE_FALSE(all.empty());
  return all;
}

/// The characters imported from hanzi-writer-data by calligraphy import, if available.
inline std::optional<calligraphy::CharacterSet> imported_characters() {
  const char* const path = std::getenv("CALLIGRAPHY_CHARACTER_FILE");
  if (path != nullptr) return calligraphy::CharacterSet::open(path);
  WARN("skipped: CALLIGRAPHY_CHARACTER_FILE does not name a character set made by calligraphy import");
  return std::nullopt;
}

/// A character made of the person's own strokes, in the person's order: a template for characters in no set.
inline calligraphy::Character own_character(const calligraphy::PenTrace& trace) {
  std::vector<calligraphy::StrokeInput> strokes;
  for (const calligraphy::PenPath& path : calligraphy::pen_paths(trace)) {
    if (calligraphy::path_length(path) < calligraphy::tap_length) continue;
    strokes.push_back(calligraphy::fit_stroke(path).stroke);
  }
  return calligraphy::make_character(trace.character, strokes);
}

/// The strokes drawn by a pen without mistakes.
inline std::vector<calligraphy::PenPath> copy_of(const calligraphy::Character& character) {
  std::vector<calligraphy::PenPath> paths;
  for (const calligraphy::Stroke& stroke : calligraphy::strokes(character)) {
    paths.push_back(calligraphy::middle_line(stroke, {calligraphy::Point::Zero(), 1.0}));
  }
  return paths;
}

/// A pen that draws each path at 0.5 em/s, with 0.3 s in the air before it.
inline calligraphy::PenTrace trace_of(char32_t code, const std::vector<calligraphy::PenPath>& paths) {
  calligraphy::PenTrace trace{code, "made-up", 1000.0, {}};
  double time = 0.0;
  for (const calligraphy::PenPath& path : paths) {
    calligraphy::PenStroke& stroke = trace.strokes.emplace_back();
    time += 0.3;
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (i > 0) time += (path[i] - path[i - 1]).norm() / 0.5;
      stroke.push_back({path[i], time});
    }
  }
  return trace;
}

}  // namespace calligraphy_test
