// The numbers by which writing is judged, in one table.
#pragma once

#include <numbers>

namespace calligraphy::detail {

/// Unless a line names another source, a value was chosen with stroke_judge on the half of the characters that `--half
/// choosing` takes (docs/practice.md, "How often the remarks are right"). All are doubles, so that one table of names
/// covers them. Elsewhere are sizes of arrays, the public tap_length and JudgeTolerances, and in judge/form what makes
/// a relation, a bend or a ring at all.
struct JudgeConstants {
  // Reading: which pen-downs wrote which strokes.
  double pen_spacing = 0.005;        ///< least spacing of points kept, above a resting pen's noise (CHANGELOG.md) [em]
  double join_cost = 0.02;           ///< cost of each missing pen lift [em]
  double break_cost = 0.03;          ///< cost of each superfluous pen lift [em]
  double unlikely_count_cost = 0.1;  ///< extra cost of a join or break that the number of pen-downs speaks against [em]
  double max_substitute_cost = 0.7;  ///< highest cost of a pen-down read as the missing stroke in its place [em]
  double max_attempt_cost = 0.08;    ///< highest cost of a pen-down as the stroke that was attempted beside it [em]
  double max_attempt_share = 0.25;   ///< highest cost as an attempted stroke, over that as the stroke in its place [1]
  double max_similar_price = 1.25;   ///< price ratio of forms up to which mistakes decide; on 74 traces of people [1]
  double max_right_price = 1.75;            ///< the same of one with as many strokes and no mistake; on 阝 [1]

  // Costs of a pen-down as a stroke, as several strokes, or as a part of one.
  double left_over_cost = 0.2;              ///< cost of a pen-down or a stroke without a partner [em]
  double turned_cost = 0.08;                ///< cost of a quarter turn where direction counts most; a half: twice [em]
  double least_trust = 0.25;                ///< trust in the direction of a stroke without length; the most is 1 [1]
  double trust_length = 0.3;                ///< increase in stroke length that raises trust in its direction by 1 [em]
  double backwards_cost = 0.02;             ///< margin by which a stroke must fit better backwards [em]
  double max_dot_length = 0.3;              ///< greatest length of a stroke that a tap may be [em]
  double max_joined_or_broken_cost = 0.15;  ///< limit on the cost of joined strokes, or of a broken one [em]
  double min_joined_length = 0.68;          ///< least length of a pen-down, over that of the strokes as one line [1]
  double max_joined_share = 0.75;           ///< limit on the cost of joined strokes, over that of the best alone [1]
  double max_joined_share_of_few = 0.9;     ///< max_joined_share where there are fewer pen-downs than strokes [1]
  double max_apart_gap = 0.25;              ///< greatest way between strokes joined out of turn, and to their ends [em]
  double max_apart_share = 0.75;            ///< max_joined_share of strokes joined out of turn [1]
  double min_apart_saving = 0.13;           ///< least saving for which strokes are believed to be joined so [em]
  double max_broken_gap = 0.25;             ///< greatest gap between the parts of a broken stroke, over its length [1]
  double broken_doubt = 0.04;               ///< margin by which one of the parts alone may fit better [em]

  // Fit: how the writing lies on the character. The two numbers of the box are older than stroke_judge.
  double box_flat_side = 0.15;       ///< side below which a box is flat [em, or share of the longer side]
  double max_box_stretch = 1.5;      ///< greatest stretch of one axis against the other, from box to box [1]
  double fit_pull = 0.01;            ///< pull of the fit towards the start, as a variance of every point [em^2]
  double max_fitted_cost = 0.2;      ///< highest cost of a pair that counts for the fit [em]
  double max_fit_slant = 0.6;        ///< greatest slant from the start, size aside: 33 degrees of turn or shear [1]
  double max_fit_scale = 1.8;        ///< greatest scale against the start, either way [1]
  double max_refits = 5.0;           ///< greatest number of refits to what was read [1]
  double min_refit_gain = 5e-4;      ///< least gain in cost for which refitting goes on [em]
  double doubtful_mean_cost = 0.06;  ///< mean cost of a reading from which turned writing is tried too [em]
  double start_turn = 16.0;          ///< turn of the writing tried for a doubtful reading, either way [degrees]

  // Direction: whether a path runs along its stroke, against it or neither way, and whether it is all of it.
  double forwards_angle = std::numbers::pi / 3.0;            ///< largest angle of a forwards path: the renderer's [rad]
  double backwards_angle = 55.0 * std::numbers::pi / 180.0;  ///< largest angle to the reverse of a backwards path [rad]
  double untrusted_angle = std::numbers::pi / 3.0;           ///< additional angle where no direction is trusted [rad]
  double least_share = 0.35;                                 ///< share of the length below which it is only a part [1]
  double sure_length = 0.2;                                  ///< length that must be missing from a part [em]

  // Order: what must speak for another than the right one.
  double min_saving = 0.03;    ///< least saving of another order, or of writing taken as it is, not from its box [em]
  double saving_factor = 2.0;  ///< mean costs that another order must save, or factor by which it must cost less [1]

  // Remarks.
  double joined_evidence = 0.5;  ///< evidence of a remark on joined strokes, for each of them [1]
  double sure_part = 0.2;  ///< share of a broken stroke beside its longest part above which the evidence exceeds 1 [1]

  // Other characters.
  double feature_deviation = 0.25;     ///< standard deviation of the points of a feature along each axis [em]
  double min_deviation_share = 0.25;   ///< least value of the smaller deviation before scaling, over the larger [1]
  double beyond_middle = 0.2;          ///< distance past the middle to report another character, over half the way [1]
  double carelessness = 0.3;           ///< further distance for a single stroke, over that from the other character [1]
  double lookalike_distance = 0.06;    ///< distance below which characters hardly differ: 125 of 4.3 million pairs [em]
  double drawn_alike_distance = 0.01;  ///< distance below which characters do not differ: two of those pairs [em]
  double named_distance = 0.1;  ///< greatest distance from another character that is named: own ones of people [em]
  double twin_distance = 0.14;    ///< distance below which one fault of form may make one character of another [em]
  double stranger_share = 0.65;   ///< greatest distance from any other character, over that from the one asked for [1]
  double twin_share = 0.8;        ///< greatest distance from a lookalike, over that from the character asked for [1]
  double unlike_price = 0.085;         ///< price per pen-down from which the best form is unlike; on 46 strangers [em]

  // The whole: residuals are of writing that fills the box of the character.
  double max_turned_residual = 0.16;   ///< greatest residual of writing that is turned or mirrored [em]
  double min_upright_residual = 0.18;  ///< least residual of the same as if it were upright [em]
  double upright_factor = 1.5;         ///< least ratio of the two [1]
  double free_factor = 1.25;           ///< least ratio if strokes may be in any order and direction [1]
  double free_margin = 0.03;           ///< least difference from that residual [em]
  double max_turn = 40.0 * std::numbers::pi / 180.0;  ///< greatest turn of a hand; of right pens, 18 [rad]
  double max_part_residual = 0.09;     ///< greatest residual of parts in each other's place [em]
  double part_factor = 1.6;            ///< least ratio of the residual of the whole to theirs [1]
  double max_one_of_several = 0.19;    ///< greatest residual of a character beside which there is more [em]

  double far_distance = 0.1;           ///< mean distance of pen-downs from which they cannot be read [em]
  double max_unremarked_distance = 0.09;  ///< mean distance that needs a remark: of 1413 right pens, 0.083 at most [em]
  double far_shape = 0.05;             ///< the same once both have the same centre: below, it is only misplaced [em]
  double unreadable_share = 0.4;       ///< least share of pen-downs that are farther than that [1]

  // Form. Of each pair, the first is a limit in em and the second one in multiples of this hand's noise, which is the
  // median residual of the strokes; the larger counts. Chosen on people's pens of four corpora (docs/practice.md).
  double max_form_turn = std::numbers::pi / 6.0;  ///< greatest turn of the writing onto the character [rad]
  double max_form_noise = 0.06;            ///< greatest noise that counts: a fault must not excuse itself [em]
  double meeting_distance = 0.04;          ///< distance up to which an end of a stroke meets another stroke [em]
  double loose_meeting_distance = 0.08;    ///< the same where only a wide gap is a fault: a brush stops before [em]
  double loose_gap = 4.0;                  ///< how much wider than that for each em from there [1]
  double min_hook_turn = std::numbers::pi / 3.0;  ///< least turn into a final hook [rad]
  double max_hook_share = 0.35;            ///< greatest length of a hook, over that of its stroke [1]
  double max_hook_length = 0.2;            ///< greatest length of a hook [em]
  double crossing_limit = 0.095;           ///< depth of a crossing that should not be [em]
  double crossing_noise = 1.7;             ///< the same [1]
  double no_crossing_limit = 0.11;         ///< depth that a crossing lacks [em]
  double no_crossing_noise = 2.5;          ///< the same [1]
  double corner_limit = 0.12;              ///< length by which an end slides off or onto the end of a stroke [em]
  double corner_noise = 3.0;               ///< the same [1]
  double gap_limit = 0.13;                 ///< distance from the stroke that should be met [em]
  double gap_noise = 3.3;                  ///< the same [1]
  double overlap_limit = 0.06;             ///< gap between strokes that is lacking [em]
  double overlap_noise = 1.3;              ///< the same [1]
  double overlap_share = 0.45;             ///< share of the gap between strokes that is left [1]
  double side_limit = 0.2;                 ///< gap between strokes on the one side and the other, together [em]
  double side_noise = 4.0;                 ///< the same [1]
  double straight_limit = 0.13;            ///< bow that a stroke lacks, or root of the sum of squares of all [em]
  double bent_limit = 0.17;                ///< bow of a straight stroke, over its length [1]
  double wavy_limit = 0.35;                ///< its length over its chord, beyond 1 [1]
  double waver_limit = 0.018;              ///< root mean square to either side of the course of the pen [em]
  double hook_limit = 0.25;                ///< length of a hook that is lacking [em]
  double place_limit = 0.155;               ///< distance of a stroke from its place [em]
  double place_noise = 3.9;                ///< the same [1]
  double length_limit = 3.2;               ///< factor between the length of a stroke and those of the others [1]
  double proportion_limit = 0.40;          ///< by how much the wrong stroke is the longer, and should be shorter [em]

  // Unfinished characters: remarks as distances; chosen on sessions of simulated novices that were cut off.
  double missing_cost = 0.05;        ///< cost of a missing stroke [em]
  double extra_attempt_cost = 0.05;  ///< cost of an extra pen-down, besides its distance from a stroke [em]
  double max_extra_cost = 0.2;       ///< cost of an extra pen-down far from all strokes [em]
  double other_remark_cost = 0.05;   ///< cost of any other remark [em]
};

/// Read by the judge, without a lock. Only tests/stroke_judge writes it (`--constant NAME=VALUE`), before it judges.
inline constinit JudgeConstants judge_constants;

}  // namespace calligraphy::detail
