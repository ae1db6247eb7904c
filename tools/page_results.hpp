// What a page that was written is measured by, and its pictures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <calligraphy/judge/judge_tolerances.hpp>
#include <calligraphy/judge/language.hpp>
#include <calligraphy/pictures/stroke_style.hpp>
#include <calligraphy/practice/recording.hpp>

#include "output_directory.hpp"
#include "summary.hpp"

namespace calligraphy::tools {

/// Where a page belongs in a run.
struct PageInRun {
  int first_position = 1;  ///< of its first character in the text, from 1
  int repetition = 1;      ///< from 1
  std::uint64_t seed = 0;
};

/// One result per character. The recording must have a set-up. Forces are as the hand feels them, and times since the
/// first tick.
std::vector<Result> results_of(const Recording& recording, const PageInRun& where,
                               const JudgeTolerances& tolerances = {});

/// How pictures are drawn.
struct PictureOptions {
  StrokeStyle style = StrokeStyle::ink;
  Language language;
  bool has_plots = true;  ///< of the forces, too
};

/// Draws a picture of each character of a page and, with force, a force plot: "03-北-force.svg",
/// "03-北-force-force.svg". One that fails is a warning. @throws FileError if a picture cannot be written
void draw_page(const Recording& recording, const PageInRun& where, const PictureOptions& options,
               OutputDirectory& out);

/// Whether gnuplot is there; otherwise says that forces are not plotted.
bool can_plot();

/// The strokes of all results as comma-separated values, a line each, for R and spreadsheets. An empty cell was not
/// measured.
std::string strokes_table(const std::vector<Result>& results);

/// The ticks of a recording, likewise.
std::string ticks_table(const Recording& recording);

}  // namespace calligraphy::tools
