#include "stroke_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace calligraphy::recognition {
namespace {

constexpr Range heng{-18.0, 30.0};
constexpr Range shu{-112.0, -68.0};
constexpr Range ti{22.0, 80.0};
constexpr Range hook_left{105.0, 205.0};
constexpr Range hook_up{55.0, 150.0};
constexpr Range quarter{0.21, 0.24};
constexpr Range hook_share{0.0, 0.34};

}  // namespace

const std::vector<CompoundRule>& compound_rules() {
  static const std::vector<CompoundRule> rules = {
      // heng gou: the second limb is a short straight hook; if longer or curved, it is a heng pie (17).
      {11, {{heng}, {{-165.0, -117.5}, {0.0, 0.55}}}},
      {12, {{{-112.0, -72.0}}, {hook_left, hook_share}}},
      // wan gou bows to the right, xie gou and wo gou to the lower left.
      {13, {{{-110.0, -55.0}, any_share, {-85.0, -5.0}, {-150.0, -70.0}, {0.035, 0.4}}, {hook_left, hook_share}}},
      {14, {{{-88.0, -36.0}, any_share, {-100.0, -45.0}, {-70.0, 5.0}, {-0.14, -0.01}}, {{45.0, 135.0}, hook_share}}},
      {15, {{{-42.0, 20.0}, any_share, {-82.0, -20.0}, {-15.0, 60.0}, {-0.6, -0.08}}, {{60.0, 180.0}, hook_share}}},
      {16, {{heng}, {{-117.5, -68.0}}}},
      {17, {{heng}, {{-165.0, -98.0}, {0.34, 1.0}, any_direction, any_direction, {-0.01, 0.4}}}},
      {18, {{heng}, {{-128.0, -72.0}}, {{120.0, 215.0}, hook_share}}},
      {19, {{heng}, {shu}, {ti, {0.0, 0.45}}}},
      {20, {{heng}, {{-125.0, -72.0}}, {{-85.0, -15.0}}, {{-18.0, 30.0}}, {hook_up, hook_share}}},
      {21,
       {{heng},
        {{-82.0, -35.0}, {0.3, 1.0}, {-110.0, -65.0}, {-75.0, 25.0}, {-0.4, -0.05}},
        {{50.0, 130.0}, hook_share}}},
      {22,
       {{heng},
        {{-160.0, -105.0}, {0.1, 1.0}},
        {{-50.0, 15.0}, {0.2, 1.0}, {-140.0, -40.0}, {-20.0, 60.0}, {-0.8, -0.12}},
        {hook_up, hook_share}}},
      {23, {{heng}, {{-130.0, -75.0}}, {{-60.0, 10.0}, any_share, {-120.0, -25.0}, {-15.0, 30.0}, {-0.5, -0.03}}}},
      {24, {{heng}, {shu}, {{-18.0, 22.0}}}},
      {25, {{heng}, {shu}, {heng}, {shu}}},
      {26,
       {{heng},
        {{-150.0, -85.0}},
        {{-75.0, 25.0}, {0.0, 0.35}},
        {{-160.0, -65.0}, any_share, {-130.0, -20.0}, {-170.0, -65.0}, {-0.02, 0.5}}}},
      {27,
       {{heng},
        {{-140.0, -90.0}},
        {{-15.0, 25.0}, {0.12, 1.0}},
        {{-130.0, -75.0}, any_share, {-120.0, -60.0}, {-150.0, -80.0}, {-0.05, 0.5}},
        {{120.0, 215.0}, hook_share}}},
      {28,
       {{heng},
        {{-155.0, -90.0}},
        {{-120.0, -50.0}, any_share, {-85.0, 10.0}, {-180.0, -80.0}, {0.05, 0.8}},
        {hook_left, hook_share}}},
      {29, {{shu}, {ti, {0.0, 0.6}}}},
      // shu wan turns in a round bend, shu zhe (32) in a corner.
      {30, {{shu}, {{-75.0, -15.0}, {0.08, 0.4}, {-110.0, -45.0}, {-40.0, 20.0}, {-0.5, -0.05}}, {{-15.0, 22.0}}}},
      {31, {{{-125.0, -68.0}}, {{-80.0, -10.0}}, {{-20.0, 25.0}}, {hook_up, hook_share}}},
      {32, {{shu}, {{-15.0, 21.0}}}},
      {33, {{{-125.0, -70.0}}, {heng}, {{-165.0, -98.0}, any_share, any_direction, any_direction, {-0.02, 0.4}}}},
      {34, {{shu}, {heng}, {shu}}},
      {35,
       {{{-125.0, -70.0}},
        {heng, {0.12, 1.0}},
        {{-125.0, -78.0}, any_share, {-115.0, -65.0}, {-160.0, -80.0}, {-0.03, 0.5}},
        {{120.0, 215.0}, hook_share}}},
      {36, {{{-165.0, -108.0}}, {{-16.0, 45.0}}}},
      {37, {{{-155.0, -98.0}, any_share, {-140.0, -85.0}, {-170.0, -85.0}, {-0.05, 0.4}}, {{-75.0, -16.0}}}},
      // four quarters of a circle: the chord of each is 0.225 of its length
      {39, {{any_direction, quarter}, {any_direction, quarter}, {any_direction, quarter}, {any_direction, quarter}}},
  };
  return rules;
}

namespace {

/// Maximum length of the second limb of a heng gou [em].
constexpr double max_heng_gou_hook = 0.25;
/// Maximum length of a hook written with a pen [em].
constexpr double max_pen_hook = 0.17;

/// Costs of deviations, in em.
constexpr double price_of_degree_outside = 0.0009;
constexpr double price_of_bulge = 0.25;     // per unit of offset over chord
constexpr double price_of_share = 0.25;     // per unit of the stroke's length
constexpr double price_of_corner = 0.0012;  // per degree of a sharp turn inside an element
constexpr double price_of_line = 0.005;
constexpr double price_of_curve = 0.009;

/// An element contains no corner: a turn by more than this within a few per cent of the em is one.
double corner_cost(const Piece& piece) { return price_of_corner * std::max(0.0, piece.sharpest - 40.0); }

/// Cost of an element for its control points; lower in a small stroke, where all deviations are small.
double price_of(char kind, double stroke_length) {
  return (kind == 'L' ? price_of_line : price_of_curve) * std::clamp(stroke_length / 0.5, 0.35, 1.0);
}

}  // namespace

double cost_of(const ElementRule& rule, char kind, const Piece& piece, double stroke_length) {
  const double direction = kind == 'L' ? piece.line_direction : piece.direction;
  const double misplaced = price_of_degree_outside * outside(rule.direction, direction) +
                           price_of_share * stroke_length * beyond(rule.share, piece.length / stroke_length);
  const double price = price_of(kind, stroke_length);
  if (kind == 'L') return price + piece.line_error + corner_cost(piece) + misplaced;
  return price + piece.cubic_error + corner_cost(piece) + misplaced +
         price_of_degree_outside * (outside(rule.leaving, piece.leaving) + outside(rule.arriving, piece.arriving)) +
         price_of_bulge * stroke_length * beyond(rule.bulge, piece.bulge);
}

double simple_cost(const Piece& piece, char kind, double stroke_length) {
  const double error = kind == 'L' ? piece.line_error : piece.cubic_error;
  return price_of(kind, stroke_length) + error + corner_cost(piece) +
         0.5 * price_of_bulge * beyond({-0.25, 0.25}, piece.bulge);
}

int sibling_of(int id, const Path& path, std::span<const std::size_t> splits, bool brush) {
  const auto element = [&](std::size_t index) {
    return std::span(path).subspan(splits[index], splits[index + 1] - splits[index] + 1);
  };
  const auto leaving = [&](std::size_t index) {
    return direction_of(point_after(element(index), 0, 0.12) - element(index).front());
  };
  const auto chord = [&](std::size_t index) { return Point(element(index).back() - element(index).front()); };
  switch (id) {
    case 11:  // the hook of heng gou is short; a long straight limb is a heng pie
      return path_length(element(1)) > max_heng_gou_hook ? 17 : 11;
    case 15:  // wo gou starts on a slant, shu wan gou upright
      return leaving(0) < -78.0 ? 31 : 15;
    case 13: {  // a shu gou may bow slightly and leans to the left; a wan gou swings back under its start
      const double bow = bulge_of(element(0), chord(0).norm());
      return brush && bow < 0.075 && direction_of(chord(0)) < -92.0 ? 12 : 13;
    }
    case 16: {  // the second limb of heng pie leans farther; a long one written with a pen need not lean as far
      const double direction = direction_of(chord(1));
      const double length = path_length(element(1));
      const bool leans = !brush && length > max_pen_hook ? contains({-180.0, -109.0}, direction)
                                                         : contains({-180.0, -118.0}, direction);
      if (!leans) return 16;
      return length > max_heng_gou_hook ? 17 : 11;
    }
    case 21: {  // heng xie gou descends all the way to its hook, heng zhe wan gou ends level
      const std::span<const Point> curve = element(1);
      if (leaving(1) < -112.0) return 22;
      return direction_of(curve.back() - curve[curve.size() - 1 - curve.size() / 3]) > -8.0 ? 20 : 21;
    }
    case 20:
    case 22:  // the second limb of heng xie wan gou is a pie, that of heng zhe wan gou a shu
      return direction_of(chord(1)) > -113.0 ? 20 : 22;
    case 28:  // the ear of heng pie wan gou swings out to the right; heng zhe gou only leans
      return leaving(2) < -80.0 ? 18 : 28;
    case 32:  // the first limb of pie zhe leans, that of shu zhe stands
      return direction_of(chord(0)) < -102.0 ? 36 : 32;
    case 37:  // a pen ends a pie dian in a long fall; after a pie zhe the second limb is short and flatter
      return !brush && chord(1).norm() < 0.14 && direction_of(chord(1)) > -37.0 ? 36 : 37;
    default:
      return id;
  }
}

}  // namespace calligraphy::recognition
