#include "form_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "judge/judge_constants.hpp"
#include "waver.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;
using FaultKind = StrokeRemarkKind;

// Places along two strokes, as shares, up to which a crossing is one that the character has [1].
constexpr double same_crossing = 0.35;
constexpr double touching_depth = 0.05, least_added_depth = 0.03;  // of crossings [em]
constexpr double stub = 0.03;                                      // depth up to which a crossing is none [em]
constexpr double least_depth = 0.08;                               // of a crossing that must not be lacking [em]
constexpr double met_distance = 0.06;                              // of an end that still lies on a stroke [em]
constexpr double at_corner = 0.03, off_corner = 0.05, in_course = 0.08, longest_corner = 0.2;  // tails [em]
constexpr double closer = 0.6;  // gap, over that of the character, below which strokes may be too close [1]
constexpr double least_bow = 0.05, kept_bend = 0.3;   // bow of a bent stroke [em], and share of it that is enough [1]
constexpr double least_lacking = 0.03;                // bow of a stroke that counts as straight with the others [em]
constexpr double most_bent = 0.2, free_bow = 0.08;    // bows over lengths [1]
constexpr double least_motion = 0.4, least_tail = 0.05;  // of an end: over its tail [1], and of a tail [em]
constexpr double ring = 0.3;            // distance of the ends of a ring, over its length [1]
constexpr double least_left_out = 0.1;  // length of a stroke of which only a part was drawn [em]
constexpr double most_evident = 10.0;   // evidence of a bend: the chord of a ring has no length [1]
constexpr double one_sided = 0.4;  // mean distance from the chord, over the largest, of a bend rather than waves [1]
constexpr double shortest_shaped = 0.12, shortest_drawn = 0.1;  // strokes that have a shape [em]
constexpr double full_bend_length = 0.3, full_wave_length = 0.4;  // lengths from which they count in full [em]
constexpr double least_length_change = 0.3, least_length_difference = 0.2;  // logarithm [1], and [em]
constexpr double shifted_alike = 0.7;  // difference of the offsets of both ends, over that of the stroke [1]
constexpr double least_longer = 0.1;                                         // of the wrong stroke [em]
constexpr double own_waver = 2.0;   // mean square to either side that a hand may have, over that of the stroke [1]
constexpr double most_waver = 0.5;  // share of the strokes that waver, above which it is the hand [1]

/// Whether a stroke ends about where it begins, as 〇 does: then it has no bow.
bool is_ring(const FormLine& stroke) { return stroke.chord().norm() < ring * stroke.length(); }

/// The bow of the character's stroke that the drawn one lacks [em].
double lacking_bow(const FormLine& drawn, const FormLine& stroke) {
  const double wanted = bow(stroke);
  if (std::abs(wanted) < least_bow || is_ring(stroke)) return 0.0;
  const double share = bow(drawn) / std::max(drawn.length(), 1e-6) / (wanted / std::max(stroke.length(), 1e-6));
  return share >= kept_bend ? 0.0 : (1.0 - std::max(share, 0.0)) * std::abs(wanted);
}

struct Bend {
  double evidence = 0.0;
  double amount = 0.0;  ///< bow that is too much [em]
  bool is_wavy = false;
};

/// Evidence that a stroke is bent or wavy where it should not be.
Bend bend(const FormLine& drawn, const FormLine& stroke) {
  const double length = drawn.length();
  if (is_ring(stroke)) return {};
  const double has = bow(drawn) / std::max(length, 1e-6), wanted = bow(stroke) / std::max(stroke.length(), 1e-6);
  if (std::abs(wanted) >= most_bent) return {};
  const bool is_bowed = std::abs(wanted) >= least_bow;
  const double more = is_bowed ? std::abs(has - wanted) - free_bow : std::abs(has) - std::abs(wanted);
  const double detour = length / std::max(drawn.chord().norm(), 1e-6) /
                            (stroke.length() / std::max(stroke.chord().norm(), 1e-6)) - 1.0;
  const double share = std::min(1.0, length / full_bend_length), wave_share = length / full_wave_length;
  const double bowed = share * more / judge_constants.bent_limit;
  const double waved = std::min(1.0, wave_share * wave_share) * detour / judge_constants.wavy_limit;
  const bool is_one_sided = std::abs(mean_offset(drawn)) > one_sided * std::abs(bow(drawn));
  const bool is_wavy = waved > bowed && !(bowed >= 1.0 && is_one_sided);
  return {std::min(std::max(bowed, waved), most_evident), is_wavy ? std::abs(bow(drawn)) : more * length, is_wavy};
}

/// The strokes that waver.
struct Wavering {
  std::vector<std::size_t> strokes;
  std::size_t judged = 0, sure = 0;  ///< number of strokes that could waver, and of those that surely do
  Bend most;

  void add(std::size_t stroke, const Bend& bent, double least) {
    ++judged;
    if (!bent.is_wavy || bent.evidence < least) return;
    strokes.push_back(stroke);
    sure += bent.evidence >= 1.0;
    if (bent.evidence > most.evidence) most = bent;
  }
  /// Whether so many do that it is the hand, not a stroke.
  bool is_all() const {
    return sure >= 2 && static_cast<double>(sure) > most_waver * static_cast<double>(judged);
  }
};

/// The direction in which a stroke goes on beyond an end.
Point outwards(const FormLine& line, StrokeEnd end) {
  constexpr std::size_t back = form_points / 4;
  const Point way = end == StrokeEnd::start ? Point(line.points.front() - line.points[back])
                                            : Point(line.points.back() - line.points[form_points - 1 - back]);
  return way / std::max(way.norm(), 1e-9);
}

/// The part of a stroke that was drawn, if it begins late or ends early: no more of its bend can be expected.
std::optional<FormLine> part_drawn(const FormLine& drawn, const FormLine& stroke) {
  const double left_out = stroke.length() - drawn.length();
  if (left_out < least_left_out) return std::nullopt;
  const auto kept = static_cast<std::size_t>(std::lround(drawn.length() / stroke.length() * (form_points - 1))) + 1;
  const std::span<const Point> points(stroke.points);
  for (const auto& [part, is_first] : {std::pair(points.first(kept), true), std::pair(points.last(kept), false)}) {
    const Point end = is_first ? drawn.points.back() : drawn.points.front();
    const double from_part = (end - (is_first ? part.back() : part.front())).norm();
    const double from_whole = (end - (is_first ? points.back() : points.front())).norm();
    if (from_whole > least_left_out && from_part < 0.5 * from_whole) return form_line(part);
  }
  return std::nullopt;
}

class FormFaults {
 public:
  FormFaults(const CharacterForm& form, const WrittenForm& written, double least)
      : form_(form), written_(written), laid_(written.laid), least_(least), index_(form.count()) {
    for (std::size_t k = 0; k < written.strokes.size(); ++k) {
      index_[written.strokes[k]] = k;
      const std::size_t stroke = written.strokes[k];
      bodies_.push_back(form.hooks[stroke] ? without_hook(laid_.lines[k]) : laid_.lines[k]);
    }
    strokes_ = written.strokes;
    noise_ = std::min(laid_.median_residual(), judge_constants.max_form_noise);
  }

  std::vector<FormFault> run() {
    find_crossings();
    find_crossings_lacking();
    find_gaps();
    find_corners();
    find_overlaps();
    find_shapes();
    find_places();
    find_proportions();
    return std::move(faults_);
  }

 private:
  bool has(std::size_t stroke) const { return index_[stroke].has_value(); }
  const FormLine& body(std::size_t stroke) const { return bodies_[*index_[stroke]]; }
  const FormLine& line(std::size_t stroke) const { return laid_.lines[*index_[stroke]]; }
  double limit(double em, double noise) const { return std::max(em, noise * noise_); }

  /// What more is allowed of an end that does not quite meet the other stroke in the character either [em].
  static double loose(const Meeting& meeting) {
    return judge_constants.loose_gap * std::max(0.0, meeting.distance - judge_constants.meeting_distance);
  }

  void add(FormFault fault) {
    if (fault.evidence < least_ && fault.kind != FaultKind::hook) return;
    if (fault.other && fault.end != StrokeEnd::none) {
      const FormLine& other = body(*fault.other);
      fault.offset = fault.place - nearest_place(fault.place, other).point;
    }
    faults_.push_back(std::move(fault));
  }

  const std::vector<DeepCrossing>& crossings_of(std::size_t one, std::size_t other) const {
    return crossings_[one * form_.count() + other];
  }

  /// An end of one of two strokes that made or lost a crossing.
  struct GuiltyEnd {
    std::size_t stroke, other;
    StrokeEnd end;
  };

  /// Which of the four ends moved so far outwards (way: 1) or inwards (-1) from its place that it made or lost a
  /// crossing: the one whose motion is the greatest share of its tail; if none moved clearly, that of the shortest.
  GuiltyEnd end_that_moved(std::size_t one, std::size_t other, const DeepCrossing& crossing, double way) const {
    GuiltyEnd guilty = crossing.is_of_one ? GuiltyEnd{one, other, crossing.end} : GuiltyEnd{other, one, crossing.end};
    double most = least_motion;
    for (const auto& [stroke, than, share] :
         {std::tuple(one, other, crossing.share_one), std::tuple(other, one, crossing.share_other)}) {
      const double length = way > 0.0 ? body(stroke).length() : form_.bodies[stroke].length();
      for (const auto& [end, tail] :
           {std::pair(StrokeEnd::start, share * length), std::pair(StrokeEnd::end, (1.0 - share) * length)}) {
        const Point motion = end_of(body(stroke), end) - end_of(form_.bodies[stroke], end);
        const double moved = way * motion.dot(outwards(form_.bodies[stroke], end)) / std::max(tail, least_tail);
        if (moved <= most) continue;
        most = moved;
        guilty = {stroke, than, end};
      }
    }
    return guilty;
  }

  void find_crossings() {
    const std::size_t n = form_.count();
    crossings_.resize(n * n);
    for (const std::size_t i : strokes_) {
      for (const std::size_t j : strokes_) {
        if (i >= j) continue;
        crossings_[i * n + j] = deep_crossings(body(i), body(j));
        for (const DeepCrossing& each : crossings_of(i, j)) {
          double wanted = 0.0;
          for (const DeepCrossing& other : form_.crossings_of(i, j)) {
            const bool is_same = std::abs(other.share_one - each.share_one) < same_crossing &&
                                 std::abs(other.share_other - each.share_other) < same_crossing;
            if (is_same) wanted = std::max(wanted, other.depth);
          }
          const double beyond = each.depth - wanted;
          if (wanted > touching_depth || beyond <= least_added_depth) continue;
          const GuiltyEnd guilty = end_that_moved(i, j, each, 1.0);
          add({.kind = FaultKind::crossing,
               .stroke = guilty.stroke,
               .other = guilty.other,
               .end = guilty.end,
               .amount = beyond,
               .evidence = beyond / limit(judge_constants.crossing_limit, judge_constants.crossing_noise),
               .place = end_of(body(guilty.stroke), guilty.end)});
        }
      }
    }
  }

  void find_crossings_lacking() {
    for (const std::size_t i : strokes_) {
      for (const std::size_t j : strokes_) {
        if (i >= j || form_.crossings_of(i, j).empty()) continue;
        double left = 0.0;  // a stub is no crossing
        for (const DeepCrossing& each : crossings_of(i, j)) left = std::max(left, each.depth);
        if (left > stub) continue;
        const std::vector<DeepCrossing>& wanted = form_.crossings_of(i, j);
        const DeepCrossing& deepest = *std::max_element(
            wanted.begin(), wanted.end(), [](const auto& one, const auto& other) { return one.depth < other.depth; });
        if (deepest.depth < least_depth) continue;
        const double apart = crossings_of(i, j).empty()
                                 ? std::min(least_distance(body(i), body(j)), least_distance(body(j), body(i)))
                                 : 0.0;
        const GuiltyEnd guilty = end_that_moved(i, j, deepest, -1.0);
        add({.kind = FaultKind::no_crossing,
             .stroke = guilty.stroke,
             .other = guilty.other,
             .end = guilty.end,
             .amount = deepest.depth + apart - left,
             .evidence = (deepest.depth + apart - left) /
                         limit(judge_constants.no_crossing_limit, judge_constants.no_crossing_noise),
             .place = end_of(body(guilty.stroke), guilty.end)});
      }
    }
  }

  void find_gaps() {
    for (const Meeting& each : form_.meetings) {
      if (!has(each.stroke) || !has(each.other)) continue;
      if (!crossings_of(std::min(each.stroke, each.other), std::max(each.stroke, each.other)).empty()) continue;
      const Point& end = end_of(body(each.stroke), each.end);
      const double apart = nearest_place(end, body(each.other)).distance - each.distance;
      add({.kind = FaultKind::gap,
           .stroke = each.stroke,
           .other = each.other,
           .end = each.end,
           .amount = apart,
           .evidence = apart / (limit(judge_constants.gap_limit, judge_constants.gap_noise) + loose(each)),
           .place = end});
    }
  }

  /// Ends that met another stroke at its end and now lie in its course, or the other way round.
  void find_corners() {
    for (const Meeting& each : form_.meetings) {
      if (!has(each.stroke) || !has(each.other) || each.distance > judge_constants.meeting_distance) continue;
      if (std::min(each.before, each.after) > longest_corner) continue;
      const FormLine& other = body(each.other);
      const NearestPlace foot = nearest_place(end_of(body(each.stroke), each.end), other);
      if (foot.distance > met_distance) continue;
      const bool is_before = each.before <= each.after;
      const double wanted = std::min(each.before, each.after);
      const double has_now = is_before ? foot.along : other.length() - foot.along;
      const bool passes = wanted <= at_corner && has_now > off_corner;
      const bool stops = wanted >= in_course && has_now < at_corner;
      if (!passes && !stops) continue;
      const double change = std::abs(has_now - wanted);
      const StrokeEnd end = is_before ? StrokeEnd::start : StrokeEnd::end;
      add({.kind = passes ? FaultKind::crossing : FaultKind::no_crossing,
           .stroke = each.other,
           .other = each.stroke,
           .end = end,
           .amount = change,
           .evidence = change / limit(judge_constants.corner_limit, judge_constants.corner_noise),
           .place = end_of(other, end)});
    }
  }

  void find_overlaps() {
    for (const Neighbours& each : form_.neighbours) {
      if (!has(each.stroke) || !has(each.other)) continue;
      const Beside now = beside(body(each.stroke), body(each.other), each.beside.points);
      if (static_cast<double>(now.count) < 0.35 * static_cast<double>(each.beside.count)) continue;
      const double gap = each.beside.gap;
      if (now.gap < closer * gap) {
        const double share = judge_constants.overlap_share * gap / std::max(now.gap, 1e-6);
        add_overlap(each.stroke, each.other, gap - now.gap, share);
      } else if (now.signed_gap * each.beside.signed_gap < 0.0 && now.parallel > 0.8 &&
                 std::abs(now.signed_gap) > 0.9 * now.gap && std::max(gap, now.gap) < 0.3) {
        const double across = now.gap + gap;
        add({.kind = FaultKind::side,
             .stroke = each.stroke,
             .other = each.other,
             .amount = across,
             .evidence = across / limit(judge_constants.side_limit, judge_constants.side_noise),
             .place = body(each.stroke).centre()});
      }
    }
  }

  void add_overlap(std::size_t stroke, std::size_t other, double closer_by, double evidence_of_share) {
    const double evidence = closer_by / limit(judge_constants.overlap_limit, judge_constants.overlap_noise);
    if (offset_of(other).norm() > offset_of(stroke).norm()) std::swap(stroke, other);
    add({.kind = FaultKind::overlap,
         .stroke = stroke,
         .other = other,
         .amount = closer_by,
         .evidence = std::min(evidence, evidence_of_share),
         .place = body(stroke).centre()});
  }

  /// Shapes: of the readings with and without a final hook, of the drawn stroke and of the character's, the one that is
  /// least at fault counts.
  void find_shapes() {
    double lacking = 0.0;
    std::vector<std::size_t> straight;
    Wavering wavering;
    for (const std::size_t i : strokes_) {
      const FormLine& drawn = line(i);
      if (drawn.length() < shortest_drawn || form_.bodies[i].length() < shortest_shaped) continue;
      const bool has_hook = hook_of(drawn).has_value();
      std::vector<FormLine> drawn_ways = {drawn};
      if (has_hook) drawn_ways.push_back(without_hook(drawn));
      double lacks = std::numeric_limits<double>::infinity();
      Bend bent{std::numeric_limits<double>::infinity()};
      std::vector<FormLine> stroke_ways = {form_.strokes[i]};
      if (form_.hooks[i]) stroke_ways.push_back(form_.bodies[i]);
      if (const auto part = part_drawn(drawn, form_.bodies[i])) stroke_ways.push_back(*part);
      for (const FormLine& way : drawn_ways) {
        for (const FormLine& stroke : stroke_ways) {
          lacks = std::min(lacks, lacking_bow(way, stroke));
          const Bend found = bend(way, stroke);
          if (found.evidence < bent.evidence) bent = found;
        }
      }
      if (wavering_length(i) >= least_wavering_length) {
        const Bend wavy = waver_of(i);
        if (wavy.evidence > bent.evidence) bent = wavy;
        wavering.add(i, bent, least_);
      }
      const Point middle = drawn.points[form_points / 2];
      lacking += lacks * lacks;
      if (lacks > least_lacking) straight.push_back(i);
      add({.kind = FaultKind::straight,
           .stroke = i,
           .amount = lacks,
           .evidence = lacks / judge_constants.straight_limit,
           .place = middle});
      add({.kind = bent.is_wavy ? FaultKind::wavy : FaultKind::bent,
           .stroke = i,
           .amount = bent.amount,
           .evidence = bent.evidence,
           .place = middle});
      if (form_.hooks[i] && !has_hook) {
        const FormLine& stroke = form_.strokes[i];
        const double hook = stroke.length() - stroke.along[*form_.hooks[i]];
        add({.kind = FaultKind::hook,
             .stroke = i,
             .amount = hook,
             .evidence = hook / judge_constants.hook_limit,
             .place = drawn.points.back()});
      }
    }
    const Point centre = box_of_lines(laid_.lines).center();
    if (straight.size() >= 2) {
      add({.kind = FaultKind::straight,
           .stroke = 0,
           .amount = std::sqrt(lacking),
           .evidence = std::sqrt(lacking) / judge_constants.straight_limit,
           .place = centre,
           .strokes = std::move(straight)});
    }
    if (wavering.is_all()) {
      std::erase_if(faults_, [this](const FormFault& fault) {  // too short to tell waves from a bend
        const bool is_bend = fault.kind == FaultKind::bent || fault.kind == FaultKind::wavy;
        return is_bend && wavering_length(fault.stroke) < least_wavering_length;
      });
      add({.kind = FaultKind::wavy,
           .stroke = 0,
           .amount = wavering.most.amount,
           .evidence = wavering.most.evidence,
           .place = centre,
           .strokes = std::move(wavering.strokes)});
    }
  }

  /// The length over which a stroke may waver: the character's, or less if not all of it was drawn [em].
  double wavering_length(std::size_t stroke) const {
    return std::min(line(stroke).length(), form_.strokes[stroke].length());
  }

  /// Evidence that the pen went to and fro across the course of a stroke that is long enough to tell, by the mean
  /// square.
  Bend waver_of(std::size_t stroke) const {
    const double length = wavering_length(stroke), limit = judge_constants.waver_limit * judge_constants.waver_limit;
    PenPath path = written_.paths[*index_[stroke]];
    for (Point& point : path) point = laid_.map(point);
    const double square = waver(path, length);
    if (square < least_ * limit) return {};  // saves the time for the character's stroke
    const double beyond = square - own_waver * waver(form_.strokes[stroke].points, length);
    return {std::min(beyond / limit, most_evident), std::sqrt(2.0 * square), true};
  }

  void find_places() {
    if (strokes_.size() < 2) return;
    std::vector<double> ratios;
    for (const std::size_t i : strokes_) ratios.push_back(body(i).length() / std::max(form_.bodies[i].length(), 0.02));
    const double middle = std::max(median_of(ratios), 1e-3);
    for (std::size_t k = 0; k < strokes_.size(); ++k) {
      const std::size_t i = strokes_[k];
      std::vector<double> others = laid_.residuals;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      const Point offset = offset_of(i);
      const double noise = judge_constants.place_noise * std::min(median_of(others), judge_constants.max_form_noise);
      add({.kind = FaultKind::place,
           .stroke = i,
           .amount = offset.norm(),
           .evidence = offset.norm() / std::max(judge_constants.place_limit, noise),
           .place = line(i).points[form_points / 2],
           .offset = offset,
           .is_shift = difference_of_ends(i) < shifted_alike * offset.norm()});
      const double change = std::log(std::max(ratios[k], 1e-3) / middle);
      const double difference = std::abs(ratios[k] - middle) * form_.bodies[i].length();
      if (std::abs(change) <= least_length_change || difference <= least_length_difference) continue;
      add({.kind = FaultKind::length,
           .stroke = i,
           .amount = difference,
           .evidence = std::abs(change) / std::log(judge_constants.length_limit),
           .place = line(i).points[form_points / 2],
           .length = ratios[k] / middle});
    }
  }

  /// From the place of a stroke to where it is.
  Point offset_of(std::size_t stroke) const { return line(stroke).centre() - form_.strokes[stroke].centre(); }

  /// By how much the offset of one end of a stroke from its place differs from that of the other end [em].
  double difference_of_ends(std::size_t stroke) const {
    return (body(stroke).chord() - form_.bodies[stroke].chord()).norm();
  }

  void find_proportions() {
    for (const Parallels& each : form_.parallels) {
      if (!has(each.stroke) || !has(each.other)) continue;
      const double longer_by = body(each.stroke).length() - body(each.other).length();
      if (longer_by * each.longer_by >= 0.0) continue;
      const double both = std::abs(longer_by) + std::abs(each.longer_by);
      const auto [longer, shorter] = each.longer_by > 0.0 ? std::pair(each.stroke, each.other)
                                                           : std::pair(each.other, each.stroke);
      add({.kind = FaultKind::proportion,
           .stroke = longer,
           .other = shorter,
           .amount = std::abs(longer_by),
           .evidence = both / judge_constants.proportion_limit * std::min(1.0, std::abs(longer_by) / least_longer),
           .place = body(longer).points.back()});
    }
  }

  const CharacterForm& form_;
  const WrittenForm& written_;
  const LaidWriting& laid_;
  const double least_;
  std::vector<std::size_t> strokes_;
  std::vector<std::optional<std::size_t>> index_;    ///< in `laid_`, by stroke
  std::vector<FormLine> bodies_;                     ///< by index in `laid_`
  std::vector<std::vector<DeepCrossing>> crossings_;  ///< of the writing, as CharacterForm::crossings
  double noise_ = 0.0;
  std::vector<FormFault> faults_;
};

}  // namespace

std::vector<FormFault> form_faults(const CharacterForm& form, const WrittenForm& written, double least) {
  return FormFaults(form, written, least).run();
}

}  // namespace calligraphy
