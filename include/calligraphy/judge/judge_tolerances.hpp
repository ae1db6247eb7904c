// How sure or how grave a remark on somebody's writing must be.
#pragma once

namespace calligraphy {

/// Tolerances of match_strokes(). The default is normal().
struct JudgeTolerances {
  /// Minimum StrokeRemark::evidence of a remark. It does not affect how the writing is read, so a lower value gives the
  /// same remarks and more [1].
  double evidence = 1.0;
  /// Whether form is judged too: otherwise there are no remarks of form (is_of_form()), which saves half of the time.
  bool form = true;

  /// Whether all tolerances are equal.
  bool operator==(const JudgeTolerances&) const = default;

  /// For beginners: only what is clearly wrong.
  static constexpr JudgeTolerances lenient() noexcept { return {1.3}; }
  /// The default.
  static constexpr JudgeTolerances normal() noexcept { return {}; }
  /// For examinations.
  static constexpr JudgeTolerances strict() noexcept { return {0.75}; }
};

/// @throws ValueError naming the tolerance and its value when it is not above 0 and finite
void validate(const JudgeTolerances& tolerances);

}  // namespace calligraphy
