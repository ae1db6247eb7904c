// Pens that wrote another character than the one that was asked for, and whether match_strokes() tells it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/judge/character_index.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/judge/judge_tolerances.hpp>

#include "right_pens.hpp"

namespace calligraphy_test {

/// A pen, and a character of as many strokes that it did not write.
struct OtherCase {
  const RightPen* pen;
  calligraphy::Character asked_for;
};

struct OtherOutcome {
  /// That another character was written, and nothing else; where the two hardly differ (by less than 0.06 em), a note
  /// of the lookalike, whatever else is told.
  bool exact = false;
  char32_t named = 0;  ///< the character that is told to have been written; 0: none
  std::string text;    ///< what is told
};

/// `count` cases, as many of each source: each of its pens in turn, and forms of other characters of the set drawn at
/// random. They refer to the pens.
std::vector<OtherCase> cases_of_another(const std::vector<std::vector<RightPen>>& sources,
                                        const calligraphy::CharacterSet& set, std::size_t count, std::uint64_t seed);

/// Two characters that differ by little: the one that was written, and the one that was asked for.
using Twins = std::pair<char32_t, char32_t>;

/// Both ways.
inline constexpr std::array<Twins, 16> all_twins = {{{U'土', U'士'},
                                                     {U'士', U'土'},
                                                     {U'己', U'已'},
                                                     {U'已', U'己'},
                                                     {U'已', U'巳'},
                                                     {U'巳', U'已'},
                                                     {U'己', U'巳'},
                                                     {U'巳', U'己'},
                                                     {U'日', U'曰'},
                                                     {U'曰', U'日'},
                                                     {U'末', U'未'},
                                                     {U'未', U'末'},
                                                     {U'人', U'入'},
                                                     {U'入', U'人'},
                                                     {U'千', U'干'},
                                                     {U'干', U'千'}}};

/// Every form of every twin in the set, so many times each.
std::vector<calligraphy::Character> forms_of_twins(const calligraphy::CharacterSet& set, std::size_t times);

/// Every pen of the one with every form of the other of as many strokes. They refer to the pens.
std::vector<OtherCase> cases_of_twins(const std::vector<RightPen>& pens, const calligraphy::CharacterSet& set,
                                      const Twins& twins);

std::vector<OtherOutcome> judge_others(const std::vector<OtherCase>& cases,
                                       const calligraphy::JudgeTolerances& tolerances,
                                       const calligraphy::CharacterIndex& index, int threads);

/// Pairs of characters of as many strokes.
struct Pairs {
  std::size_t lookalikes = 0;  ///< that hardly differ, by less than 0.06 em, in one of their forms
  std::size_t all = 0;
};

Pairs count_pairs(const calligraphy::CharacterIndex& index, int threads);

}  // namespace calligraphy_test
