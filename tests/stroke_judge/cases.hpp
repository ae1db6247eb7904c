// Cases of one row of the table, and what match_strokes() tells of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <calligraphy/judge/character_index.hpp>
#include <calligraphy/judge/judge_tolerances.hpp>
#include <calligraphy/judge/pen_trace.hpp>

#include "corruptions.hpp"

namespace calligraphy_test {

struct Case {
  const RightPen* pen;
  std::uint64_t seed;
  Corrupted corrupted;
};

struct Outcome {
  bool told = false;         ///< exactly
  bool silent = false;       ///< nothing is remarked that is not of form
  bool form = false;         ///< something is remarked of form, other than a note
  char32_t other = 0;        ///< another character that is told to have been written; 0: none
  double comparisons = 0.0;  ///< of a pen-down with a stroke, per pen-down and stroke
  std::string text;          ///< what is told
};

/// `count` cases of the row with this index in corruptions(), as many of each source: each of its pens in turn, until
/// there are enough, or none of them can have the fault. They refer to the pens. A row in which nothing is random has
/// one of each pen.
std::vector<Case> cases_of(const std::vector<std::vector<RightPen>>& sources, std::size_t row, StrokeClass stroke_class,
                           std::size_t count, std::uint64_t seed);

/// A drawing without times, as a pen of 0.5 em/s with 0.3 s in the air before each stroke draws it.
calligraphy::PenTrace trace_of(char32_t code, const std::string& name, const std::vector<calligraphy::PenPath>& paths);

/// `others`: that match_strokes() may take the writing for; nullptr: none.
std::vector<Outcome> judge_cases(const std::vector<Case>& cases, const calligraphy::JudgeTolerances& tolerances,
                                 const calligraphy::CharacterIndex* others, int threads);

}  // namespace calligraphy_test
