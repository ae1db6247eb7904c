#include "cases.hpp"

#include <algorithm>

#include <calligraphy/base/random.hpp>

#include "base/parallel.hpp"
#include "judge/judge_constants.hpp"
#include "judge/pens/resemblance.hpp"
#include "judge/reading/stroke_reading.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

double comparisons(const Case& each) {
  std::vector<PenPath> paths;
  for (const PenPath& path : each.corrupted.paths) {
    paths.push_back(without_jitter(path, detail::judge_constants.pen_spacing));
  }
  const StrokeOutlines outlines(each.pen->character);
  const StrokeReading reading = read_strokes(each.pen->character, outlines, paths);
  return static_cast<double>(reading.comparisons) / static_cast<double>(paths.size() * outlines.count());
}

Outcome judge(const Case& each, const JudgeTolerances& tolerances, const CharacterIndex* others) {
  const MatchResult match = match_strokes(each.pen->character, each.corrupted.paths, tolerances, others);
  const std::vector<Truth>& truths = each.corrupted.truths;
  const bool told = std::any_of(truths.begin(), truths.end(), [&](const Truth& truth) { return tells(match, truth); });
  return {told,
          is_silent_but_form(match),
          is_form_remarked(match),
          other_character(match),
          comparisons(each),
          describe(match)};
}

}  // namespace

std::vector<Case> cases_of(const std::vector<std::vector<RightPen>>& sources, std::size_t row, StrokeClass stroke_class,
                           std::size_t count, std::uint64_t seed) {
  std::vector<Case> cases;
  const Corruption& corruption = corruptions()[row];
  for (std::size_t source = 0; source < sources.size(); ++source) {
    const std::vector<RightPen>& pens = sources[source];
    const std::size_t wanted = corruption.is_random() ? (count + source) / sources.size() : pens.size();
    const std::size_t most = cases.size() + wanted;
    for (int round = 0; cases.size() < most; ++round) {
      const std::size_t at_first = cases.size();
      for (std::size_t i = 0; i < pens.size() && cases.size() < most; ++i) {
        Random random(seed, {static_cast<int>(row), static_cast<int>(source), static_cast<int>(i), round});
        const std::uint64_t case_seed = random.bits() >> 32;
        auto corrupted = corrupt(pens[i], corruption, case_seed, stroke_class);
        if (corrupted) cases.push_back({&pens[i], case_seed, std::move(*corrupted)});
      }
      if (cases.size() == at_first) break;
    }
  }
  return cases;
}

PenTrace trace_of(char32_t code, const std::string& name, const std::vector<PenPath>& paths) {
  PenTrace trace{code, name, 1000.0, {}};
  double time = 0.0;
  for (const PenPath& path : paths) {
    PenStroke& stroke = trace.strokes.emplace_back();
    time += 0.3;
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (i > 0) time += (path[i] - path[i - 1]).norm() / 0.5;
      stroke.push_back({path[i], time});
    }
  }
  return trace;
}

std::vector<Outcome> judge_cases(const std::vector<Case>& cases, const JudgeTolerances& tolerances,
                                 const CharacterIndex* others, int threads) {
  std::vector<Outcome> outcomes(cases.size());
  parallel_for(
      cases.size(), threads, [](double) {}, [&](std::size_t i) { outcomes[i] = judge(cases[i], tolerances, others); });
  return outcomes;
}

}  // namespace calligraphy_test
