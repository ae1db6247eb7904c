#include "named_constants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include <calligraphy/base/error.hpp>

#include "judge/judge_constants.hpp"

namespace calligraphy_test {
namespace {

using calligraphy::ValueError;
using calligraphy::detail::JudgeConstants;

struct NamedConstant {
  std::string_view name;
  double JudgeConstants::*member;
};

constexpr auto named_constants = std::to_array<NamedConstant>({
    {"pen_spacing", &JudgeConstants::pen_spacing},
    {"join_cost", &JudgeConstants::join_cost},
    {"break_cost", &JudgeConstants::break_cost},
    {"unlikely_count_cost", &JudgeConstants::unlikely_count_cost},
    {"max_substitute_cost", &JudgeConstants::max_substitute_cost},
    {"max_attempt_cost", &JudgeConstants::max_attempt_cost},
    {"max_attempt_share", &JudgeConstants::max_attempt_share},
    {"max_similar_price", &JudgeConstants::max_similar_price},
    {"max_right_price", &JudgeConstants::max_right_price},
    {"left_over_cost", &JudgeConstants::left_over_cost},
    {"turned_cost", &JudgeConstants::turned_cost},
    {"least_trust", &JudgeConstants::least_trust},
    {"trust_length", &JudgeConstants::trust_length},
    {"backwards_cost", &JudgeConstants::backwards_cost},
    {"max_dot_length", &JudgeConstants::max_dot_length},
    {"max_joined_or_broken_cost", &JudgeConstants::max_joined_or_broken_cost},
    {"min_joined_length", &JudgeConstants::min_joined_length},
    {"max_joined_share", &JudgeConstants::max_joined_share},
    {"max_joined_share_of_few", &JudgeConstants::max_joined_share_of_few},
    {"max_apart_gap", &JudgeConstants::max_apart_gap},
    {"max_apart_share", &JudgeConstants::max_apart_share},
    {"min_apart_saving", &JudgeConstants::min_apart_saving},
    {"max_broken_gap", &JudgeConstants::max_broken_gap},
    {"broken_doubt", &JudgeConstants::broken_doubt},
    {"box_flat_side", &JudgeConstants::box_flat_side},
    {"max_box_stretch", &JudgeConstants::max_box_stretch},
    {"fit_pull", &JudgeConstants::fit_pull},
    {"max_fitted_cost", &JudgeConstants::max_fitted_cost},
    {"max_fit_slant", &JudgeConstants::max_fit_slant},
    {"max_fit_scale", &JudgeConstants::max_fit_scale},
    {"max_refits", &JudgeConstants::max_refits},
    {"min_refit_gain", &JudgeConstants::min_refit_gain},
    {"doubtful_mean_cost", &JudgeConstants::doubtful_mean_cost},
    {"start_turn", &JudgeConstants::start_turn},
    {"forwards_angle", &JudgeConstants::forwards_angle},
    {"backwards_angle", &JudgeConstants::backwards_angle},
    {"untrusted_angle", &JudgeConstants::untrusted_angle},
    {"least_share", &JudgeConstants::least_share},
    {"sure_length", &JudgeConstants::sure_length},
    {"min_saving", &JudgeConstants::min_saving},
    {"saving_factor", &JudgeConstants::saving_factor},
    {"joined_evidence", &JudgeConstants::joined_evidence},
    {"sure_part", &JudgeConstants::sure_part},
    {"feature_deviation", &JudgeConstants::feature_deviation},
    {"min_deviation_share", &JudgeConstants::min_deviation_share},
    {"beyond_middle", &JudgeConstants::beyond_middle},
    {"carelessness", &JudgeConstants::carelessness},
    {"lookalike_distance", &JudgeConstants::lookalike_distance},
    {"drawn_alike_distance", &JudgeConstants::drawn_alike_distance},
    {"named_distance", &JudgeConstants::named_distance},
    {"twin_distance", &JudgeConstants::twin_distance},
    {"stranger_share", &JudgeConstants::stranger_share},
    {"twin_share", &JudgeConstants::twin_share},
    {"unlike_price", &JudgeConstants::unlike_price},
    {"max_turned_residual", &JudgeConstants::max_turned_residual},
    {"min_upright_residual", &JudgeConstants::min_upright_residual},
    {"upright_factor", &JudgeConstants::upright_factor},
    {"free_factor", &JudgeConstants::free_factor},
    {"free_margin", &JudgeConstants::free_margin},
    {"max_turn", &JudgeConstants::max_turn},
    {"max_part_residual", &JudgeConstants::max_part_residual},
    {"part_factor", &JudgeConstants::part_factor},
    {"max_one_of_several", &JudgeConstants::max_one_of_several},
    {"far_distance", &JudgeConstants::far_distance},
    {"max_unremarked_distance", &JudgeConstants::max_unremarked_distance},
    {"far_shape", &JudgeConstants::far_shape},
    {"unreadable_share", &JudgeConstants::unreadable_share},
    {"max_form_turn", &JudgeConstants::max_form_turn},
    {"max_form_noise", &JudgeConstants::max_form_noise},
    {"meeting_distance", &JudgeConstants::meeting_distance},
    {"loose_meeting_distance", &JudgeConstants::loose_meeting_distance},
    {"loose_gap", &JudgeConstants::loose_gap},
    {"min_hook_turn", &JudgeConstants::min_hook_turn},
    {"max_hook_share", &JudgeConstants::max_hook_share},
    {"max_hook_length", &JudgeConstants::max_hook_length},
    {"crossing_limit", &JudgeConstants::crossing_limit},
    {"crossing_noise", &JudgeConstants::crossing_noise},
    {"no_crossing_limit", &JudgeConstants::no_crossing_limit},
    {"no_crossing_noise", &JudgeConstants::no_crossing_noise},
    {"corner_limit", &JudgeConstants::corner_limit},
    {"corner_noise", &JudgeConstants::corner_noise},
    {"gap_limit", &JudgeConstants::gap_limit},
    {"gap_noise", &JudgeConstants::gap_noise},
    {"overlap_limit", &JudgeConstants::overlap_limit},
    {"overlap_noise", &JudgeConstants::overlap_noise},
    {"overlap_share", &JudgeConstants::overlap_share},
    {"side_limit", &JudgeConstants::side_limit},
    {"side_noise", &JudgeConstants::side_noise},
    {"straight_limit", &JudgeConstants::straight_limit},
    {"bent_limit", &JudgeConstants::bent_limit},
    {"wavy_limit", &JudgeConstants::wavy_limit},
    {"waver_limit", &JudgeConstants::waver_limit},
    {"hook_limit", &JudgeConstants::hook_limit},
    {"place_limit", &JudgeConstants::place_limit},
    {"place_noise", &JudgeConstants::place_noise},
    {"length_limit", &JudgeConstants::length_limit},
    {"proportion_limit", &JudgeConstants::proportion_limit},
    {"missing_cost", &JudgeConstants::missing_cost},
    {"extra_attempt_cost", &JudgeConstants::extra_attempt_cost},
    {"max_extra_cost", &JudgeConstants::max_extra_cost},
    {"other_remark_cost", &JudgeConstants::other_remark_cost},
});
static_assert(sizeof(JudgeConstants) == named_constants.size() * sizeof(double), "a constant has no name");

}  // namespace

void set_constant(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  const auto found = std::find_if(named_constants.begin(), named_constants.end(),
                                  [&name](const NamedConstant& each) { return each.name == name; });
  if (found == named_constants.end()) {
    std::string names;
    for (const NamedConstant& each : named_constants) names += "\n    " + std::string(each.name);
    throw ValueError("--constant " + assignment + ": expected NAME=VALUE with one of these names:" + names);
  }
  const std::string text = equals == std::string::npos ? "" : assignment.substr(equals + 1);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) {
    throw ValueError("--constant " + assignment + ": expected a finite number after '='");
  }
  calligraphy::detail::judge_constants.*found->member = value;
}

}  // namespace calligraphy_test
