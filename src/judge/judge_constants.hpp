// The numbers by which writing is judged, in one table.
#pragma once

#include <numbers>

namespace calligraphy::detail {

/// Where a line names no other source, chosen with stroke_judge on the half of the characters that `--half choosing`
/// takes (docs/practice.md, "How often the remarks are right"). All are doubles: one table of names reaches them.
struct JudgeConstants {
  // Reading: which pen-downs wrote which strokes.
  double pen_spacing = 0.005;        ///< of the points of a pen-down: above a resting pen's noise (CHANGELOG.md) [em]
  double join_cost = 0.02;           ///< of each lift of the pen too few [em]
  double break_cost = 0.03;          ///< of a lift too many [em]
  double unlikely_count_cost = 0.1;  ///< of either, besides, where the number of pen-downs speaks against it [em]
  double max_substitute_cost = 0.7;  ///< of a pen-down in a stroke's place, that is told as this stroke [em]
  double max_attempt_cost = 0.08;    ///< of a pen-down as a stroke at which the one beside it was an attempt too [em]
  double max_attempt_share = 0.25;   ///< of its cost as the stroke in whose place it is [1]
  double max_similar_price = 1.25;   ///< of accepted forms, over the least: mistakes decide; on 74 traces of people [1]

  // Costs: of a pen-down as a stroke, as several, or as a part of one.
  double left_over_cost = 0.2;              ///< of a pen-down or a stroke without a partner [em]
  double turned_cost = 0.08;                ///< of a quarter turn, where direction tells most; of a half, twice [em]
  double least_trust = 0.25;                ///< in the direction of a stroke without length; the most is 1 [1]
  double trust_length = 0.3;                ///< of a stroke, for which that trust is greater by 1 [em]
  double backwards_cost = 0.02;             ///< by which a stroke must fit better backwards [em]
  double max_dot_length = 0.3;              ///< of a stroke that a tap may be [em]
  double max_joined_or_broken_cost = 0.15;  ///< of strokes that are read as joined, or of one as broken [em]
  double min_joined_length = 0.68;          ///< of a pen-down, over what a pen draws that joins these strokes [1]
  double max_joined_share = 0.75;           ///< of the cost as one of these strokes alone, at most [1]
  double max_joined_share_of_few = 0.9;     ///< the same where there are fewer pen-downs than strokes [1]
  double max_broken_gap = 0.25;             ///< between the parts of a broken stroke, of its length [1]
  double broken_doubt = 0.04;               ///< by which one of the parts alone may fit better [em]

  // Fit: how the writing lies on the character.
  double box_flat_side = 0.15;       ///< of a flat box, at most; older than stroke_judge [em, or of the longer side]
  double max_box_stretch = 1.5;      ///< of one axis against the other, from box to box; older than stroke_judge [1]
  double fit_pull = 0.01;            ///< to the start, as a variance of every point [em^2]
  double max_fitted_cost = 0.2;      ///< of a pair that counts [em]
  double max_fit_slant = 0.6;        ///< from the start, without the size: 33 degrees of a turn or of shear [1]
  double max_fit_scale = 1.8;        ///< against the start, either way [1]
  double max_refits = 5.0;           ///< of the writing to what was read [1]
  double min_refit_gain = 5e-4;      ///< of cost, without which a refit is the last one [em]
  double doubtful_mean_cost = 0.06;  ///< of a reading, from which it also begins with the writing turned [em]
  double start_turn = 16.0;          ///< of the writing then, either way [degrees]

  // Direction: along a stroke, against it or neither, and whether it was all of it.
  double forwards_angle = std::numbers::pi / 3.0;            ///< within which it runs forwards: the renderer's [rad]
  double backwards_angle = 55.0 * std::numbers::pi / 180.0;  ///< within which of its reverse it runs backwards [rad]
  double untrusted_angle = std::numbers::pi / 3.0;           ///< besides, where no direction is trusted [rad]
  double least_share = 0.35;                                 ///< of its length: a part is shorter [1]
  double sure_length = 0.2;                                  ///< of what is missing of such a part, at least [em]

  // Order: what must speak for another one.
  double min_saving = 0.03;    ///< of another order, or of the writing as it is and not from its box [em]
  double saving_factor = 2.0;  ///< mean costs of this hand that it must save, and by which it must cost less [1]

  // Remarks.
  double sure_part = 0.2;  ///< of a broken stroke: where the shorter part is longer, the evidence is above 1 [1]

  // Other characters.
  double feature_deviation = 0.25;     ///< standard deviation of the points of a feature, each way [em]
  double min_deviation_share = 0.25;   ///< of the larger deviation before, that the smaller one counts as at least [1]
  double beyond_middle = 0.2;          ///< of the way from the middle to the other character, from which it is told [1]
  double carelessness = 0.3;           ///< of the distance from that one, of a single stroke, farther still [1]
  double lookalike_distance = 0.06;    ///< below which two characters hardly differ: 125 of 4.3 million pairs [em]
  double drawn_alike_distance = 0.01;  ///< below which they do not differ: two of these pairs [em]
  double unlike_price = 0.085;         ///< of a pen-down, from which the best form is like none; on 46 strangers [em]

  // Unfinished characters: what there is to remark, as a distance; on sessions of simulated novices, cut off.
  double missing_cost = 0.05;        ///< of a stroke [em]
  double extra_attempt_cost = 0.05;  ///< of an extra pen-down, beside its distance from a stroke [em]
  double max_extra_cost = 0.2;       ///< of one that is far from all strokes [em]
  double other_remark_cost = 0.05;   ///< of any other remark [em]
};

/// Read by the judge, without a lock. Only tests/stroke_judge writes it (`--constant NAME=VALUE`), before it judges.
inline constinit JudgeConstants judge_constants;

}  // namespace calligraphy::detail
