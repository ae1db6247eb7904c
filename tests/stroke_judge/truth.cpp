#include "truth.hpp"

#include <algorithm>

#include <calligraphy/base/text.hpp>

namespace calligraphy_test {

using namespace calligraphy;

namespace {

Due due_of(const StrokeRemark& remark) {
  return {remark.kind, remark.kind == StrokeRemarkKind::extra ? remark.path : remark.stroke};
}

/// Remarks other than of order and of form, in ascending order.
std::vector<Due> told(const MatchResult& match) {
  std::vector<Due> all;
  for (const StrokeRemark& remark : match.remarks) {
    if (remark.kind != StrokeRemarkKind::order && !is_of_form(remark.kind)) all.push_back(due_of(remark));
  }
  std::sort(all.begin(), all.end());
  return all;
}

bool same(const DrawnStroke& drawn, const Written& written) {
  if (written.stroke < 0) return drawn.stroke < 0;
  return drawn.stroke == written.stroke && drawn.stroke_count == written.stroke_count &&
         drawn.continues == written.continues && drawn.also == written.also;
}

std::string describe_strokes(int stroke, int count, int also, bool continues) {
  if (stroke < 0) return "x";
  std::string text = std::to_string(stroke + 1);
  for (int i = 1; i < count; ++i) text += "+" + std::to_string(stroke + i + 1);
  if (also >= 0) text += "+" + std::to_string(also + 1);
  return text + (continues ? "~" : "");
}

std::string describe(const Due& due) { return std::string(to_string(due.kind)) + " " + std::to_string(due.of + 1); }

}  // namespace

std::vector<Due> Truth::due() const {
  std::vector<Due> all;
  for (std::size_t path = 0; path < written.size(); ++path) {
    const Written& each = written[path];
    if (each.stroke < 0) all.push_back({StrokeRemarkKind::extra, static_cast<int>(path)});
    if (each.stroke_count > 1 || each.also >= 0) all.push_back({StrokeRemarkKind::joined, each.stroke});
    const bool is_last_part = path + 1 == written.size() || !written[path + 1].continues;
    if (each.continues && is_last_part) all.push_back({StrokeRemarkKind::broken, each.stroke});
    if (each.backwards) all.push_back({StrokeRemarkKind::direction, each.stroke});
    if (each.turned) all.push_back({StrokeRemarkKind::shape, each.stroke});
  }
  for (const int stroke : missing) all.push_back({StrokeRemarkKind::missing, stroke});
  std::sort(all.begin(), all.end());
  return all;
}

bool tells(const MatchResult& match, const Truth& truth) {
  if (!std::equal(match.drawn.begin(), match.drawn.end(), truth.written.begin(), truth.written.end(), same)) {
    return false;
  }
  if (told(match) != truth.due()) return false;
  if (match.count(StrokeRemarkKind::order) != (truth.is_moved() ? 1 : 0)) return false;
  return std::all_of(match.remarks.begin(), match.remarks.end(), [&](const StrokeRemark& remark) {
    return remark.kind != StrokeRemarkKind::order ||
           (truth.first_moved <= remark.stroke && remark.stroke <= truth.last_moved);
  });
}

bool is_silent_but_form(const MatchResult& match) {
  return std::all_of(match.remarks.begin(), match.remarks.end(),
                     [](const StrokeRemark& remark) { return is_of_form(remark.kind); });
}

bool is_form_remarked(const MatchResult& match) {
  return std::any_of(match.remarks.begin(), match.remarks.end(), [](const StrokeRemark& remark) {
    return is_of_form(remark.kind) && remark.kind != StrokeRemarkKind::hook;
  });
}

char32_t other_character(const MatchResult& match) {
  for (const StrokeRemark& remark : match.remarks) {
    if (remark.other_character != 0) return remark.other_character;
  }
  return 0;
}

std::string describe(const Truth& truth) {
  std::string text;
  for (const Written& each : truth.written) {
    text += (text.empty() ? "" : " ") + describe_strokes(each.stroke, each.stroke_count, each.also, each.continues);
  }
  for (const Due& due : truth.due()) text += ", " + describe(due);
  if (!truth.is_moved()) return text;
  return text + ", order " + std::to_string(truth.first_moved + 1) + ".." + std::to_string(truth.last_moved + 1);
}

std::string describe(const MatchResult& match) {
  std::string text;
  for (const DrawnStroke& each : match.drawn) {
    text += (text.empty() ? "" : " ") + describe_strokes(each.stroke, each.stroke_count, each.also, each.continues);
  }
  for (const StrokeRemark& remark : match.remarks) {
    const bool is_other = remark.other_character != 0;
    text += ", " + (is_other ? std::string(to_string(remark.kind)) + " " + encode_utf8(remark.other_character)
                             : describe(due_of(remark)));
  }
  return text;
}

}  // namespace calligraphy_test
