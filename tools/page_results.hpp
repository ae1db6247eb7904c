// What a page that was written is measured by, and its pictures.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/judge/judge_tolerances.hpp>
#include <calligraphy/judge/language.hpp>
#include <calligraphy/model/character.hpp>
#include <calligraphy/pictures/stroke_style.hpp>
#include <calligraphy/practice/recording.hpp>

#include "output_directory.hpp"
#include "summary.hpp"

namespace calligraphy::tools {

/// Where a page belongs in a run.
struct PageInRun {
  int page = 1;            ///< its number, from 1
  int first_position = 1;  ///< of its first character in the text, from 1
  int repetition = 1;      ///< from 1
  std::optional<std::uint64_t> seed = {};  ///< of a simulated writer, if it is known
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
  std::function<bool()> is_stopped = [] { return false; };  ///< asked before each picture
  JudgeTolerances tolerances = {};                          ///< of the remarks on the writing
};

/// Draws what was written of each character of a page and, with force, a plot of the forces: "03-北-force-writing.svg",
/// "03-北-force-plot.svg"; and of several characters the whole page: "page-1-force-writing.svg". One that fails is told
/// and added to `warnings`.
void draw_page(const Recording& recording, const PageInRun& where, const PictureOptions& options, OutputDirectory& out,
               std::vector<std::string>& warnings);

/// Says so if fonts can be found, but none has the Chinese that pictures of these characters will contain.
void warn_of_missing_font(const std::vector<Character>& characters, const Language& language);

/// Draws the errors of a run without and with force, "error-by-character.svg", if there are enough pairs of runs to show
/// an effect. Failing is told likewise.
void draw_errors(const std::vector<Result>& results, const std::string& device, const PictureOptions& options,
                 OutputDirectory& out, std::vector<std::string>& warnings);

/// Writes what a function makes. If it fails, that is told and added to `warnings`: nothing else depends on it.
void try_to_write(const std::string& name, const std::function<std::string()>& make, OutputDirectory& out,
                  std::vector<std::string>& warnings);

/// Whether gnuplot works; otherwise that forces are not plotted is told and added to `warnings`.
bool can_plot(std::vector<std::string>& warnings);

/// The strokes of all results as comma-separated values, a line each, for R and spreadsheets. An empty cell was not
/// measured.
std::string strokes_table(const std::vector<Result>& results);

/// The ticks of a recording, likewise.
std::string ticks_table(const Recording& recording);

}  // namespace calligraphy::tools
