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
constexpr double one_place = 0.25;     // distance within which relations of one stroke are one fault [em]
// Of right writing, many relations come within a quarter of their limits, few within a sixteenth: that is strict.
constexpr double steepness = 4.0;

/// The evidence of a fault by its size over the limit.
double evidence_of(double share) { return share >= sure ? share : 1.0 - steepness * (1.0 - share); }

bool is_shape(StrokeRemarkKind kind) {
  return kind == StrokeRemarkKind::straight || kind == StrokeRemarkKind::bent || kind == StrokeRemarkKind::wavy;
}

bool is_relation(StrokeRemarkKind kind) {
  return kind >= StrokeRemarkKind::crossing && kind <= StrokeRemarkKind::side;
}

/// Causes come before what follows from them: a shape before the crossings that it makes.
int rank(const FormFault& fault) {
  if (fault.strokes > 1) return 0;
  if (is_shape(fault.kind)) return 1;
  if (fault.kind == StrokeRemarkKind::overlap) return 2;
  if (fault.kind == StrokeRemarkKind::place) return fault.is_shift ? 3 : 6;
  if (fault.kind == StrokeRemarkKind::proportion) return 5;
  if (fault.kind == StrokeRemarkKind::length) return 6;
  return is_relation(fault.kind) ? 4 : 7;
}

bool is_about(const FormFault& fault, std::size_t stroke) {
  return (stroke >= fault.stroke && stroke < fault.stroke + fault.strokes) || fault.other == stroke;
}

/// Whether a fault shows what another one already says.
bool explains(const FormFault& cause, const FormFault& fault) {
  if (cause.strokes > 1) return is_shape(fault.kind) || is_relation(fault.kind);
  if (cause.other) {  // a relation
    const bool is_same_pair = is_about(fault, cause.stroke) && is_about(fault, *cause.other);
    if (is_same_pair) return true;
    if (cause.kind == StrokeRemarkKind::overlap || cause.kind == StrokeRemarkKind::side) {
      return is_about(fault, cause.stroke) || is_about(fault, *cause.other);
    }
    const bool shares_stroke = is_about(fault, cause.stroke) || is_about(fault, *cause.other);
    if (fault.other) return shares_stroke && (fault.place - cause.place).norm() < one_place;
    return fault.stroke == cause.stroke && !is_shape(fault.kind) && fault.kind != StrokeRemarkKind::hook;
  }
  return is_about(fault, cause.stroke) && fault.strokes == 1;  // a shape, a place or a length
}

/// One fault for each of those that are independent, with the evidence of all that it explains.
std::vector<FormFault> grouped(std::vector<FormFault> faults) {
  std::sort(faults.begin(), faults.end(), [](const FormFault& one, const FormFault& other) {
    const bool is_sure = one.evidence >= sure, is_other_sure = other.evidence >= sure;
    return std::tuple(!is_sure, is_sure ? rank(one) : 0, -one.evidence, one.stroke, one.other) <
           std::tuple(!is_other_sure, is_other_sure ? rank(other) : 0, -other.evidence, other.stroke, other.other);
  });
  std::vector<FormFault> leaders;
  for (const FormFault& fault : faults) {
    const auto cause = std::find_if(leaders.begin(), leaders.end(),
                                    [&](const FormFault& leader) { return explains(leader, fault); });
    if (cause == leaders.end()) {
      leaders.push_back(fault);
    } else {
      cause->evidence = std::max(cause->evidence, fault.evidence);
    }
  }
  return leaders;
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
  for (const FormFault& fault : grouped(form_faults(form, written, least_grouped))) {
    const double evidence = evidence_of(fault.evidence);
    if (evidence < least) continue;
    const bool is_all = fault.strokes > 1;
    remarks.push_back({.kind = fault.kind,
                       .path = is_all ? 0 : paths[fault.stroke],
                       .path_count = is_all ? static_cast<int>(drawn.size()) : 1,
                       .stroke = static_cast<int>(fault.stroke),
                       .stroke_count = static_cast<int>(fault.strokes),
                       .other_path = fault.other ? paths[*fault.other] : -1,
                       .other_stroke = fault.other ? static_cast<int>(*fault.other) : -1,
                       .place = back * (fault.place - map.offset),
                       .evidence = evidence,
                       .length = fault.length,
                       .end = fault.end,
                       .amount = fault.amount,
                       .offset = fault.offset});
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
