#include "other_characters.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <calligraphy/base/random.hpp>
#include <calligraphy/judge/stroke_matching.hpp>

#include "base/parallel.hpp"
#include "judge/reading/character_features.hpp"
#include "truth.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

constexpr double lookalike = 0.06;  // distance of characters that hardly differ [em]
constexpr int most_strokes = 64;    // of a character

OtherOutcome judge(const OtherCase& each, const JudgeTolerances& tolerances, const CharacterIndex& index) {
  const MatchResult match = match_strokes(each.asked_for, each.pen->paths, tolerances, &index);
  OtherOutcome outcome{false, other_character(match), describe(match)};
  if (outcome.named == 0) return outcome;
  if (match.count(StrokeRemarkKind::lookalike) == 0) {
    outcome.exact = match.remarks.size() == 1;
  } else {
    outcome.exact = apart(character_feature(each.pen->character), character_feature(each.asked_for)) < lookalike;
  }
  return outcome;
}

/// Of characters of so many strokes.
Pairs count_pairs(const CharacterFeatures& features, int strokes) {
  const CharacterFeature none = CharacterFeature::Zero(2 * points_in_stroke * strokes);
  std::set<char32_t> codes;
  std::set<std::pair<char32_t, char32_t>> found;
  for (const CharacterFeatures::Neighbour& one : features.neighbours(none)) {
    codes.insert(one.code);
    for (const CharacterFeatures::Neighbour& other : features.neighbours(features.feature(one))) {
      if (one.code < other.code && other.distance < lookalike) found.insert({one.code, other.code});
    }
  }
  return {found.size(), codes.empty() ? 0 : codes.size() * (codes.size() - 1) / 2};
}

}  // namespace

std::vector<OtherCase> cases_of_another(const std::vector<std::vector<RightPen>>& sources, const CharacterSet& set,
                                        std::size_t count, std::uint64_t seed) {
  std::map<std::size_t, std::vector<StoredCharacter>> forms;  // by the number of strokes
  for (const StoredCharacter& character : set) {
    for (const StoredCharacter& form : set.forms(character.code())) {
      forms[static_cast<std::size_t>(form.stroke_count())].push_back(form);
    }
  }
  std::vector<OtherCase> cases;
  for (std::size_t source = 0; source < sources.size(); ++source) {
    const std::vector<RightPen>& pens = sources[source];
    Random random(seed, {static_cast<int>(source)});
    const std::size_t most = cases.size() + (count + source) / sources.size();
    for (std::size_t at_first = most; cases.size() < most && cases.size() != at_first;) {
      at_first = cases.size();
      for (std::size_t i = 0; i < pens.size() && cases.size() < most; ++i) {
        const std::vector<StoredCharacter>& as_many = forms[pens[i].paths.size()];
        if (as_many.empty()) continue;
        const StoredCharacter& form = as_many[static_cast<std::size_t>(random.index(as_many.size()))];
        if (form.code() != pens[i].character.code) cases.push_back({&pens[i], form.character()});
      }
    }
  }
  return cases;
}

std::vector<Character> forms_of_twins(const CharacterSet& set, std::size_t times) {
  std::set<char32_t> codes;
  for (const Twins& twins : all_twins) codes.insert(twins.first);
  std::vector<Character> forms;
  for (const char32_t code : codes) {
    for (const StoredCharacter& form : set.forms(code)) forms.insert(forms.end(), times, form.character());
  }
  return forms;
}

std::vector<OtherCase> cases_of_twins(const std::vector<RightPen>& pens, const CharacterSet& set, const Twins& twins) {
  std::vector<Character> forms;
  for (const StoredCharacter& form : set.forms(twins.second)) forms.push_back(form.character());
  std::vector<OtherCase> cases;
  for (const RightPen& pen : pens) {
    if (pen.character.code != twins.first) continue;
    for (const Character& form : forms) {
      if (strokes(form).size() == pen.paths.size()) cases.push_back({&pen, form});
    }
  }
  return cases;
}

std::vector<OtherOutcome> judge_others(const std::vector<OtherCase>& cases, const JudgeTolerances& tolerances,
                                       const CharacterIndex& index, int threads) {
  std::vector<OtherOutcome> outcomes(cases.size());
  parallel_for(
      cases.size(), threads, [](double) {}, [&](std::size_t i) { outcomes[i] = judge(cases[i], tolerances, index); });
  return outcomes;
}

Pairs count_pairs(const CharacterIndex& index, int threads) {
  std::vector<Pairs> counts(most_strokes);
  parallel_for(
      counts.size(), threads, [](double) {},
      [&](std::size_t i) { counts[i] = count_pairs(index.features(), static_cast<int>(i) + 1); });
  Pairs sum;
  for (const Pairs& each : counts) sum = {sum.lookalikes + each.lookalikes, sum.all + each.all};
  return sum;
}

}  // namespace calligraphy_test
