#include "form_remarks.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>

#include <Eigen/LU>

#include "judge/pens/pen_paths.hpp"

namespace calligraphy {
namespace {

constexpr double sure = 1.0;           // evidence from which a fault may explain more evident ones [1]
constexpr double least_grouped = 0.8;  // share of its limit from which a fault is evident at all [1]
constexpr double one_culprit = 2.0;    // distance of one stroke from its place, over that of any other [1]
constexpr double one_place = 0.25;     // distance within which relations of one stroke are one fault [em]
// Of right writing, many relations come within a quarter of their limits, few within a sixteenth: that is strict.
constexpr double steepness = 4.0;

/// The evidence of a fault by its size over the limit; a hook that is lacking is a note.
double evidence_of(const FormFault& fault) {
  if (fault.evidence >= sure || fault.kind == StrokeRemarkKind::hook) return fault.evidence;
  return 1.0 - steepness * (1.0 - fault.evidence);
}

bool is_shape(StrokeRemarkKind kind) {
  return kind == StrokeRemarkKind::straight || kind == StrokeRemarkKind::bent || kind == StrokeRemarkKind::wavy;
}

bool is_relation(StrokeRemarkKind kind) {
  return kind >= StrokeRemarkKind::crossing && kind <= StrokeRemarkKind::side;
}

/// Causes come before what follows from them: a shape before the crossings that it makes.
int rank(const FormFault& fault) {
  if (is_shape(fault.kind)) return fault.strokes.empty() ? 1 : 0;
  if (fault.kind == StrokeRemarkKind::overlap) return 2;
  if (fault.kind == StrokeRemarkKind::place) return fault.is_shift ? 3 : 6;
  if (fault.kind == StrokeRemarkKind::proportion) return 5;
  if (fault.kind == StrokeRemarkKind::length) return 6;
  return is_relation(fault.kind) ? 4 : 7;
}

/// Whether a fault may be the cause of more evident ones.
bool is_sure(const FormFault& fault) { return fault.evidence >= sure || is_shape(fault.kind); }

/// A fault, and everything that shows it.
struct FaultGroup {
  FormFault fault;
  std::vector<std::size_t> strokes;  ///< that are at fault

  bool has(std::size_t stroke) const { return std::find(strokes.begin(), strokes.end(), stroke) != strokes.end(); }
  bool is_about(const FormFault& other) const { return has(other.stroke) || (other.other && has(*other.other)); }
};

std::vector<std::size_t> strokes_of(const FormFault& fault) {
  if (!fault.strokes.empty()) return fault.strokes;
  if (fault.other) return {fault.stroke, *fault.other};
  return {fault.stroke};
}

/// Whether a fault shows what another one already says.
bool explains(const FaultGroup& cause, const FormFault& fault) {
  if (!cause.is_about(fault)) return false;
  if (!cause.fault.other) return fault.strokes.empty() || is_shape(cause.fault.kind);  // a shape, a place or a length
  if (cause.fault.kind == StrokeRemarkKind::overlap || cause.fault.kind == StrokeRemarkKind::side) return true;
  if (fault.other) {
    const bool is_same_pair = cause.has(fault.stroke) && cause.has(*fault.other);
    return is_same_pair || (fault.place - cause.fault.place).norm() < one_place;
  }
  return fault.stroke == cause.fault.stroke && !is_shape(fault.kind) && fault.kind != StrokeRemarkKind::hook;
}

/// One fault for each of those that are independent, with the evidence of all that it explains.
std::vector<FaultGroup> grouped(std::vector<FormFault> faults) {
  std::sort(faults.begin(), faults.end(), [](const FormFault& one, const FormFault& other) {
    const auto key = [](const FormFault& fault) {
      return std::tuple(!is_sure(fault), is_sure(fault) ? rank(fault) : 0, -fault.evidence, fault.stroke, fault.other);
    };
    return key(one) < key(other);
  });
  std::vector<FaultGroup> groups;
  for (const FormFault& fault : faults) {
    const auto cause = std::find_if(groups.begin(), groups.end(),
                                    [&](const FaultGroup& group) { return explains(group, fault); });
    if (cause == groups.end()) {
      groups.push_back({fault, strokes_of(fault)});
      continue;
    }
    cause->fault.evidence = std::max(cause->fault.evidence, fault.evidence);
    if (fault.kind != StrokeRemarkKind::overlap || cause->fault.kind != StrokeRemarkKind::overlap) continue;
    for (const std::size_t stroke : strokes_of(fault)) {
      if (!cause->has(stroke)) cause->strokes.push_back(stroke);
    }
  }
  return groups;
}

/// Whether one of several strokes on one another is much farther from its place than the others.
bool has_one_culprit(const FaultGroup& group, const CharacterForm& form, const WrittenForm& written) {
  std::vector<double> offsets;
  for (std::size_t k = 0; k < written.strokes.size(); ++k) {
    const std::size_t stroke = written.strokes[k];
    if (group.has(stroke)) offsets.push_back((written.laid.lines[k].centre() - form.strokes[stroke].centre()).norm());
  }
  std::sort(offsets.rbegin(), offsets.rend());
  return offsets.size() > 1 && offsets[0] > one_culprit * offsets[1];
}

}  // namespace

std::vector<StrokeRemark> form_remarks(const CharacterForm& form, const WrittenForm& written,
                                       std::span<const DrawnStroke> drawn, double least) {
  std::vector<StrokeRemark> remarks;
  if (written.strokes.empty()) return remarks;
  const AffineMap& map = written.laid.map;
  const Eigen::Matrix2d back = map.linear.inverse();
  std::vector<int> paths(form.count(), -1);
  for (std::size_t path = 0; path < drawn.size(); ++path) {
    if (drawn[path].stroke >= 0) paths[static_cast<std::size_t>(drawn[path].stroke)] = static_cast<int>(path);
  }
  for (FaultGroup& group : grouped(form_faults(form, written, least_grouped))) {
    const FormFault& fault = group.fault;
    const double evidence = evidence_of(fault);
    if (evidence < least) continue;
    StrokeRemark remark{.kind = fault.kind,
                        .path = paths[fault.stroke],
                        .path_count = 1,
                        .stroke = static_cast<int>(fault.stroke),
                        .stroke_count = 1,
                        .other_path = fault.other ? paths[*fault.other] : -1,
                        .other_stroke = fault.other ? static_cast<int>(*fault.other) : -1,
                        .place = back * (fault.place - map.offset),
                        .evidence = evidence,
                        .length = fault.length,
                        .end = fault.end,
                        .amount = fault.amount,
                        .offset = fault.offset};
    std::sort(group.strokes.begin(), group.strokes.end());
    const auto [first, last] = std::pair(group.strokes.front(), group.strokes.back());
    if (!fault.strokes.empty()) {
      remark.path = 0, remark.path_count = static_cast<int>(drawn.size());
      remark.stroke = 0, remark.stroke_count = static_cast<int>(form.count());
    } else if (fault.kind == StrokeRemarkKind::overlap && group.strokes.size() > 2 &&
               last - first + 1 == group.strokes.size() && !has_one_culprit(group, form, written)) {
      remark.stroke = static_cast<int>(first), remark.stroke_count = static_cast<int>(group.strokes.size());
      remark.path = paths[first];
      remark.other_stroke = remark.other_path = -1;
    }
    remarks.push_back(remark);
  }
  std::stable_sort(remarks.begin(), remarks.end(),
                   [](const StrokeRemark& one, const StrokeRemark& other) { return one.path < other.path; });
  return remarks;
}

StrokeRemark whole_remark(const WholeFault& fault, std::span<const PenPath> paths) {
  StrokeRemark remark{.kind = fault.kind,
                      .path = 0,
                      .path_count = static_cast<int>(paths.size()),
                      .place = box_of_all(paths).center(),
                      .orientation = fault.orientation};
  if (fault.kind == StrokeRemarkKind::parts) {
    remark.stroke = 0;
    remark.stroke_count = static_cast<int>(fault.first_part);
    remark.other_stroke = static_cast<int>(fault.first_part);
  }
  return remark;
}

}  // namespace calligraphy
