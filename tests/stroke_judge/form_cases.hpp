// Pens with faults of form, and what match_strokes() tells of them; they are matched with every accepted form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <calligraphy/judge/character_index.hpp>
#include <calligraphy/judge/judge_tolerances.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/model/character_set.hpp>

#include "form_faults.hpp"

namespace calligraphy_test {

struct FormCase {
  const RightPen* pen;
  std::uint64_t seed;
  Malformed written;
};

struct FormOutcome {
  bool told = false;                                 ///< by a remark of one of the row's kinds that names the stroke
  bool told_best = false;                            ///< by one of the first of them
  bool form = false;                                 ///< some remark is of form
  int remarks = 0;                                   ///< of any kind
  char32_t other = 0;                                ///< another character that is told to have been written; 0: none
  std::vector<calligraphy::StrokeRemarkKind> kinds;  ///< of all remarks, notes too
  std::string text;                                  ///< what is told
};

/// Every form of the characters of a set, by code.
using AcceptedForms = std::map<char32_t, std::vector<calligraphy::Character>>;

AcceptedForms accepted_forms(const calligraphy::CharacterSet& set, const std::vector<RightPen>& pens);

/// `count` cases of the row with this index in form_rows(): each of the pens in turn, until there are enough, or none
/// of them can have the fault. They refer to the pens. Of a row in which nothing is random each pen has one.
std::vector<FormCase> form_cases_of(const std::vector<RightPen>& pens, std::size_t row, std::size_t count,
                                    std::uint64_t seed);

/// Whether a result tells this fault: by a remark of a kind, which names one of the faulty strokes, as what was written
/// or as the other one of a relation.
bool tells(const calligraphy::MatchResult& match, const Malformed& written, calligraphy::StrokeRemarkKind kind,
           calligraphy::WritingOrientation orientation);

/// Notes of a hook that is missing do not count, except in the row of that. `others`: that match_strokes() may take the
/// writing for; nullptr: none.
std::vector<FormOutcome> judge_form_cases(const std::vector<FormCase>& cases, const FormRow& row,
                                          const AcceptedForms& forms, const calligraphy::JudgeTolerances& tolerances,
                                          const calligraphy::CharacterIndex* others, int threads);

/// What is told of right pens as they are.
std::vector<FormOutcome> judge_right_pens(const std::vector<RightPen>& pens, const AcceptedForms& forms,
                                          const calligraphy::JudgeTolerances& tolerances,
                                          const calligraphy::CharacterIndex* others, int threads);

}  // namespace calligraphy_test
