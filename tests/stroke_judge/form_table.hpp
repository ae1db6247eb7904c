// The part of stroke_judge on form: two tables, of right pens and of faults.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/judge/pen_trace.hpp>

#include "form_cases.hpp"

namespace calligraphy_test {

struct FormTableOptions {
  calligraphy::JudgeTolerances tolerances = {};         ///< of the faults: right pens are judged with all three
  const calligraphy::CharacterIndex* others = nullptr;  ///< that match_strokes() may take the writing for
  std::string row = {};                                 ///< this one alone, or "right"; empty: all
  std::size_t cases = 300;                              ///< of each row and source
  std::uint64_t seed = 1;
  int threads = 0;
  bool list = false;  ///< prints each case that failed
};

/// Prints both tables of each source of pens. Returns the cases that failed: right pens with a remark of form, and
/// faults that are not told.
std::vector<calligraphy::PenTrace> print_form_tables(const std::vector<std::vector<RightPen>>& sources,
                                                     const calligraphy::CharacterSet& set,
                                                     const FormTableOptions& options);

}  // namespace calligraphy_test
