#include "form_cases.hpp"

#include <algorithm>

#include <calligraphy/base/random.hpp>

#include "base/parallel.hpp"
#include "truth.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

bool names(const StrokeRemark& remark, const MatchResult& match, int path) {
  if (remark.path <= path && path < remark.path + remark.path_count) return true;
  const auto written = static_cast<std::size_t>(path);
  if (written >= match.drawn.size() || match.drawn[written].stroke < 0) return false;
  const int stroke = match.drawn[written].stroke;
  return remark.other_stroke == stroke ||
         (remark.stroke <= stroke && stroke < remark.stroke + std::max(1, remark.stroke_count));
}

FormOutcome outcome_of(const MatchResult& match, bool counts_hooks) {
  FormOutcome outcome;
  for (const StrokeRemark& remark : match.remarks) {
    outcome.kinds.push_back(remark.kind);
    const bool is_note = remark.kind == StrokeRemarkKind::hook && !counts_hooks;
    outcome.remarks += !is_note;
    outcome.form = outcome.form || (is_of_form(remark.kind) && !is_note);
  }
  outcome.other = other_character(match);
  outcome.text = describe(match);
  return outcome;
}

FormOutcome judge(const FormCase& each, const FormRow& row, const std::vector<Character>& forms,
                  const JudgeTolerances& tolerances, const CharacterIndex* others) {
  const MatchResult match = match_strokes(std::span(forms), each.written.paths, tolerances, others);
  FormOutcome outcome = outcome_of(match, row.fault == FormFault::drop_hook);
  const auto is_told_by = [&](StrokeRemarkKind kind) { return tells(match, each.written, kind, row.orientation); };
  outcome.told_best = is_told_by(row.kinds.front());
  outcome.told = std::any_of(row.kinds.begin(), row.kinds.end(), is_told_by);
  return outcome;
}

}  // namespace

AcceptedForms accepted_forms(const CharacterSet& set, const std::vector<RightPen>& pens) {
  AcceptedForms forms;
  for (const RightPen& pen : pens) {
    std::vector<Character>& of = forms[pen.character.code];
    if (!of.empty()) continue;
    for (const StoredCharacter& form : set.forms(pen.character.code)) of.push_back(form.character());
  }
  return forms;
}

std::vector<FormCase> form_cases_of(const std::vector<RightPen>& pens, std::size_t row, std::size_t count,
                                    std::uint64_t seed) {
  std::vector<FormCase> cases;
  const FormRow& what = form_rows()[row];
  for (int round = 0; cases.size() < count; ++round) {
    const std::size_t at_first = cases.size();
    for (std::size_t i = 0; i < pens.size() && cases.size() < count; ++i) {
      Random random(seed, {static_cast<int>(row), static_cast<int>(i), round});
      const std::uint64_t case_seed = random.bits() >> 32;
      auto written = malform(pens[i], what, case_seed);
      if (written) cases.push_back({&pens[i], case_seed, std::move(*written)});
    }
    if (cases.size() == at_first || !what.is_random()) break;
  }
  return cases;
}

bool tells(const MatchResult& match, const Malformed& written, StrokeRemarkKind kind, WritingOrientation orientation) {
  return std::any_of(match.remarks.begin(), match.remarks.end(), [&](const StrokeRemark& remark) {
    if (remark.kind != kind || remark.orientation != orientation) return false;
    return written.strokes.empty() || std::any_of(written.strokes.begin(), written.strokes.end(),
                                                  [&](int stroke) { return names(remark, match, stroke); });
  });
}

std::vector<FormOutcome> judge_form_cases(const std::vector<FormCase>& cases, const FormRow& row,
                                          const AcceptedForms& forms, const JudgeTolerances& tolerances,
                                          const CharacterIndex* others, int threads) {
  std::vector<FormOutcome> outcomes(cases.size());
  parallel_for(
      cases.size(), threads, [](double) {},
      [&](std::size_t i) {
        outcomes[i] = judge(cases[i], row, forms.at(cases[i].pen->character.code), tolerances, others);
      });
  return outcomes;
}

std::vector<FormOutcome> judge_right_pens(const std::vector<RightPen>& pens, const AcceptedForms& forms,
                                          const JudgeTolerances& tolerances, const CharacterIndex* others,
                                          int threads) {
  std::vector<FormOutcome> outcomes(pens.size());
  parallel_for(
      pens.size(), threads, [](double) {},
      [&](std::size_t i) {
        const std::vector<Character>& of = forms.at(pens[i].character.code);
        outcomes[i] = outcome_of(match_strokes(std::span(of), pens[i].paths, tolerances, others), false);
      });
  return outcomes;
}

}  // namespace calligraphy_test
