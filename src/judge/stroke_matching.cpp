#include <calligraphy/judge/stroke_matching.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "base/require.hpp"
#include "judge/judge_constants.hpp"
#include "judge/pens/pen_paths.hpp"
#include "judge/pens/resemblance.hpp"
#include "judge/reading/farness.hpp"
#include "judge/reading/other_character.hpp"
#include "judge/reading/stroke_direction.hpp"
#include "judge/reading/writing_order.hpp"
#include "judge/remarks/form_remarks.hpp"
#include "judge/remarks/remarks_on.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr double sure_evidence = JudgeTolerances::normal().evidence;

/// Among the pen-downs without a stroke directly before or after this one, one that runs forwards along the stroke.
std::optional<std::size_t> correction_beside(const StrokeReading& reading, std::size_t path, std::size_t stroke) {
  std::vector<bool> is_extra(reading.costs->paths(), false);
  for (const ReadingStep& step : reading.steps) {
    if (step.strokes == 0) is_extra[step.path] = true;
  }
  const auto corrects = [&](std::size_t other) {
    const PairCost& pair = reading.costs->single(other, stroke);
    return !reading.costs->is_tap(other) && !pair.backwards && pair.cost < judge_constants.left_over_cost;
  };
  for (std::size_t next = path + 1; next < is_extra.size() && is_extra[next]; ++next) {
    if (corrects(next)) return next;
  }
  for (std::size_t before = path; before-- > 0 && is_extra[before];) {
    if (corrects(before)) return before;
  }
  return std::nullopt;
}

/// A stroke written backwards and at once again forwards, or vice versa, counts as written forwards; the backwards
/// attempt is extra.
void prefer_corrections(StrokeReading& reading) {
  for (ReadingStep& wrong : reading.steps) {
    if (wrong.paths != 1 || wrong.strokes != 1 || wrong.also) continue;
    if (!reading.costs->single(wrong.path, wrong.stroke).backwards) continue;
    const std::optional<std::size_t> correction = correction_beside(reading, wrong.path, wrong.stroke);
    if (!correction) continue;
    const auto extra = std::find_if(reading.steps.begin(), reading.steps.end(), [&](const ReadingStep& step) {
      return step.strokes == 0 && step.path == *correction;
    });
    std::swap(extra->path, wrong.path);
    wrong.cost = reading.costs->single(wrong.path, wrong.stroke).cost;
  }
}

/// Finds what a pen-down that wrote no stroke attempted: the stroke it resembles most among those along or against
/// which it runs.
void find_attempt(DrawnStroke& drawn, std::size_t path, const StrokeReading& reading, const StrokeOutlines& strokes) {
  double least = judge_constants.left_over_cost;
  for (std::size_t stroke = 0; stroke < strokes.count() && !drawn.tap; ++stroke) {
    const double cost = reading.costs->single(path, stroke).cost;
    const WritingDirection direction = direction_of({path, 1, stroke, 1, cost}, reading, strokes).direction;
    if (cost > least || direction == WritingDirection::neither) continue;
    least = cost;
    drawn.attempt = static_cast<int>(stroke);
    drawn.direction = direction;
  }
}

void require_valid(std::span<const Character> accepted) {
  if (accepted.empty()) throw ValueError("no character to match with");
  for (const Character& character : accepted) {
    const std::vector<ValidationIssue> problems = validate(character);
    if (!problems.empty()) {
      throw ValueError("the character's stroke " + std::to_string(problems[0].stroke) + ": " + problems[0].what);
    }
    if (character.code != accepted.front().code) {
      throw ValueError("accepted forms: expected those of one character, got " + encode_utf8(accepted.front().code) +
                       " and " + encode_utf8(character.code));
    }
  }
}

/// The pen-downs read as one of the accepted forms, without remarks.
struct FormMatch {
  std::unique_ptr<const StrokeOutlines> outlines;  ///< referred to by the costs of the reading
  StrokeReading reading;
  MatchResult result;
  double price = 0.0;               ///< price of the reading [em]
  std::size_t mistakes = 0;         ///< number of remarks at JudgeTolerances::normal(), whatever is reported in the end
  std::optional<CharacterForm> character_form = {};
  std::vector<StrokeRemark> form = {};  ///< remarks on form
  std::size_t form_mistakes = 0;        ///< number of those at JudgeTolerances::normal()
};

FormMatch match_form(const Character& character, std::span<const PenPath> paths, std::span<const PenPath> steady) {
  FormMatch matched;
  matched.outlines = std::make_unique<const StrokeOutlines>(character);
  const StrokeOutlines& outlines = *matched.outlines;
  StrokeReading& reading = matched.reading;
  reading = read_strokes(character, outlines, steady);
  prefer_corrections(reading);
  MatchResult& match = matched.result;
  match.fit = reading.costs->fit();
  match.drawn.resize(steady.size());
  for (const ReadingStep& step : reading.steps) {
    for (std::size_t path = step.path; path < step.path + step.paths; ++path) {
      DrawnStroke& drawn = match.drawn[path];
      drawn.tap = reading.costs->is_tap(path);
      if (step.strokes > 0) {
        drawn.stroke = static_cast<int>(step.stroke);
        drawn.stroke_count = static_cast<int>(step.strokes);
        drawn.continues = path > step.path;
        if (step.also) drawn.also = static_cast<int>(*step.also);
        const StrokeDirection direction = direction_of(step, reading, outlines);
        drawn.direction = direction.direction;
        drawn.evidence = direction.evidence;
        drawn.length = length_share(step, reading, outlines);
        drawn.distance = compare_step(step, reading, outlines).distance();
      } else {
        find_attempt(drawn, path, reading, outlines);
      }
    }
  }
  set_in_turn(match.drawn);
  const WritingOrder order = find_order(match.drawn);
  matched.price = reading.price(order.exchanges.size() + order.moved.size());
  matched.mistakes = remarks_on(character, paths, match.drawn, match.fit,
                                {reading.order_evidence, JudgeTolerances::normal().evidence})
                         .size();
  return matched;
}

/// Judges the form, of a reading that may be chosen.
void judge_form(FormMatch& matched, const Character& character, std::span<const PenPath> steady, double least) {
  const CharacterForm& form = matched.character_form.emplace(character);
  const std::vector<DrawnStroke>& drawn = matched.result.drawn;
  matched.form = form_remarks(form, written_form(form, steady, drawn), drawn, std::min(least, sure_evidence));
  matched.form_mistakes = static_cast<std::size_t>(
      std::count_if(matched.form.begin(), matched.form.end(),
                    [](const StrokeRemark& remark) { return remark.evidence >= sure_evidence; }));
}

/// Indices of the accepted form that the writing is read as, and of the best one with as many strokes as there are
/// pen-downs. Judges the form of those that come into question.
std::pair<std::size_t, std::optional<std::size_t>> best_forms(std::vector<FormMatch>& matched,
                                                              std::span<const Character> accepted,
                                                              std::span<const PenPath> steady,
                                                              const JudgeTolerances& tolerances) {
  double least_price = std::numeric_limits<double>::infinity();
  for (const FormMatch& form : matched) least_price = std::min(least_price, form.price);
  // A form of as many strokes as there are pen-downs, with nothing to remark, may be dearer than one with mistakes.
  const auto is_dear = [&](const FormMatch& form) {
    const bool is_right = form.outlines->count() == steady.size() && form.mistakes == 0;
    return form.price > least_price * (is_right ? judge_constants.max_right_price : judge_constants.max_similar_price);
  };
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (tolerances.form && !is_dear(matched[i])) judge_form(matched[i], accepted[i], steady, tolerances.evidence);
  }
  // Among forms of about the same price, the one with the fewest mistakes comes first.
  const auto rank = [&](const FormMatch& form) {
    if (is_dear(form)) return std::tuple(true, std::size_t{0}, std::size_t{0}, form.price);
    return std::tuple(false, form.mistakes, form.form_mistakes, form.price);
  };
  std::size_t best = 0;
  std::optional<std::size_t> best_of_same_count;
  for (std::size_t i = 0; i < matched.size(); ++i) {
    const FormMatch& next = matched[i];
    if (rank(next) < rank(matched[best])) best = i;
    if (next.outlines->count() != steady.size()) continue;
    if (!best_of_same_count || rank(next) < rank(matched[*best_of_same_count])) best_of_same_count = i;
  }
  return {best, best_of_same_count};
}

/// What is wrong with the writing as a whole, if anything.
std::optional<WholeFault> fault_of_whole(FormMatch& matched, const Character& character,
                                         std::span<const PenPath> steady) {
  if (!matched.character_form) matched.character_form.emplace(character);
  const auto fault = whole_fault(*matched.character_form, steady);
  const std::vector<DrawnStroke>& drawn = matched.result.drawn;
  const bool wrote_it_all =
      std::all_of(drawn.begin(), drawn.end(), [](const DrawnStroke& each) { return each.stroke >= 0 || each.tap; });
  if (fault && !(fault->kind == StrokeRemarkKind::several && wrote_it_all)) return fault;
  // What was turned upright for the reading, but too far for a hand's slant.
  const Eigen::Matrix2d& map = matched.result.fit.linear;
  const double turn = std::atan2(map(1, 0) - map(0, 1), map(0, 0) + map(1, 1));
  if (drawn.size() < 2 || std::abs(turn) < judge_constants.max_turn) return std::nullopt;
  return WholeFault{StrokeRemarkKind::orientation,
                    turn < 0.0 ? WritingOrientation::turned_left : WritingOrientation::turned_right};
}

/// Whether the writing can be read as the character. Where it is farther from it than right writing ever is and no
/// remark says why, there must be a single stroke that is out of place, which is then remarked.
bool can_be_read(FormMatch& matched, std::span<const PenPath> paths) {
  const Farness farness = farness_of(matched.reading, *matched.outlines, matched.result.drawn);
  if (farness.is_all_over()) return false;
  if (matched.mistakes + matched.form_mistakes > 0 || !farness.is_beyond_right_writing()) return true;
  if (!farness.misplaced) return false;
  const auto [path, stroke, offset] = *farness.misplaced;
  const auto index = static_cast<int>(stroke);
  std::erase_if(matched.form, [&](const StrokeRemark& remark) { return remark.stroke == index; });
  matched.form.push_back({.kind = StrokeRemarkKind::place,
                          .path = static_cast<int>(path),
                          .path_count = 1,
                          .stroke = index,
                          .stroke_count = 1,
                          .place = halfway(paths[path]),
                          .evidence = farness.distance / judge_constants.max_unremarked_distance,
                          .amount = offset.norm(),
                          .offset = offset});
  return true;
}

/// Tells that a fault of form makes another character, if it is the only one: then whoever reads it learns how.
bool make_other(std::vector<StrokeRemark>& form, char32_t code) {
  const auto is_fault = [](const StrokeRemark& remark) { return remark.evidence >= sure_evidence; };
  if (std::count_if(form.begin(), form.end(), is_fault) != 1) return false;
  StrokeRemark& fault = *std::find_if(form.begin(), form.end(), is_fault);
  const bool can_make = fault.kind == StrokeRemarkKind::crossing || fault.kind == StrokeRemarkKind::no_crossing ||
                        fault.kind == StrokeRemarkKind::proportion;
  if (!can_make) return false;
  fault.other_character = code;
  fault.evidence = std::numeric_limits<double>::infinity();
  return true;
}

}  // namespace

void validate(const JudgeTolerances& tolerances) {
  require_above_zero("tolerances.evidence", tolerances.evidence, "");
}

int MatchResult::count(StrokeRemarkKind kind) const noexcept {
  return static_cast<int>(std::count_if(remarks.begin(), remarks.end(),
                                        [kind](const StrokeRemark& remark) { return remark.kind == kind; }));
}

MatchResult match_strokes(std::span<const Character> accepted, std::span<const PenPath> paths,
                          const JudgeTolerances& tolerances, const CharacterIndex* others) {
  require_valid(accepted);
  require_paths(paths);
  validate(tolerances);
  const double spacing = judge_constants.pen_spacing * shortening(paths);
  std::vector<PenPath> steady;
  for (const PenPath& path : paths) steady.push_back(without_jitter(path, spacing));
  std::vector<FormMatch> matched;
  for (const Character& character : accepted) matched.push_back(match_form(character, paths, steady));
  auto [best, best_of_same_count] = best_forms(matched, accepted, steady, tolerances);
  std::optional<OtherCharacter> other;
  // Writing of another character may resemble a form of fewer or more strokes slightly better than the one it can be
  // compared with; writing of the right character resembles its own form even with a mistake.
  const bool is_like_best = matched[best].price < judge_constants.unlike_price * static_cast<double>(steady.size());
  if (others && best_of_same_count && (best == *best_of_same_count || !is_like_best)) {
    const std::size_t compared = *best_of_same_count;
    other = other_character(others->features(), accepted[compared], steady, matched[compared].reading);
    if (other && other->is_clear) best = compared;
  }
  std::optional<WholeFault> whole;
  if (tolerances.form) {
    const std::size_t compared = best_of_same_count.value_or(best);
    whole = fault_of_whole(matched[compared], accepted[compared], steady);
    if (whole) {
      best = compared;
    } else if (!(other && other->is_clear) && !can_be_read(matched[best], paths)) {
      whole = WholeFault{StrokeRemarkKind::unreadable};
    }
  }
  FormMatch& chosen = matched[best];
  MatchResult result = std::move(chosen.result);
  result.accepted = static_cast<int>(best);
  result.character = accepted[best];
  if (whole) {
    result.remarks = {whole_remark(*whole, paths)};
    return result;
  }
  const bool is_makeable = other && other->is_twin && chosen.mistakes == 0 && best == best_of_same_count;
  if (other && ((is_makeable && make_other(chosen.form, other->code)) || !other->is_clear)) other.reset();
  result.remarks = remarks_on(accepted[best], paths, result.drawn, result.fit,
                              {chosen.reading.order_evidence, tolerances.evidence}, other);
  if (other && !other->is_lookalike) return result;
  for (const StrokeRemark& remark : chosen.form) {
    if (remark.evidence >= tolerances.evidence) result.remarks.push_back(remark);
  }
  return result;
}

MatchResult match_strokes(const Character& character, std::span<const PenPath> paths,
                          const JudgeTolerances& tolerances, const CharacterIndex* others) {
  return match_strokes({&character, 1}, paths, tolerances, others);
}

}  // namespace calligraphy
