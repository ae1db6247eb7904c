#include <calligraphy/render/guidance_law.hpp>

#include <algorithm>
#include <cmath>

#include <calligraphy/render/force_terms.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

/// A pen this far from the normal of its closest point is beyond an end: as a share of the distance, plus a slack [m].
constexpr double oblique_share = 0.2, oblique_slack = 1e-5;

/// The part of a velocity that guidance along `way` [m] damps: across the stroke. Along it the pen is free, except
/// where guidance leads that way too: before the start and at a corner that is not passed.
Point damped_part(const Point& velocity, const Point& way, const Point& tangent) noexcept {
  const double along = std::abs(way.dot(tangent));
  const double oblique = std::min(1.0, along / (oblique_share * way.norm() + oblique_slack));
  return velocity - (1.0 - oblique) * velocity.dot(tangent) * tangent;
}

[[gnu::always_inline]] inline Point damper_of(const GuidanceInput& input, double share) noexcept {
  // Resistance to writing backwards is not weakened by assistance, nor is its damper.
  const Point guided = input.resistance > 0.0
                           ? Point(std::max(share, input.resistance) * input.velocity)
                           : Point(share * damped_part(input.velocity, input.way, input.tangent));
  return -input.damping * (guided + unguided_damping * (input.velocity - guided));
}

/// The spring of a stroke that attracts less is damped less in proportion.
double damped_share(const GuidanceInput& input, double share) noexcept {
  return input.attraction < 1.0 ? share * input.attraction : share;
}

std::string with_stiffness(const char* name, const GuidanceSetup& setup) {
  return std::string(name) + ": " + number_text(setup.stiffness) + " N/m";
}

class LinearGuidance final : public GuidanceLaw {
 public:
  explicit LinearGuidance(const GuidanceSetup& setup)
      : traits_{with_stiffness("linear", setup), setup.stiffness, 0.0, true, false} {}
  GuidanceTraits traits() const override { return traits_; }
  GuidanceTerms force(const GuidanceInput& input) override {
    return {attraction_force(input.stiffness * input.share, input.tip, input.target),
            damper_of(input, damped_share(input, input.share))};
  }

 private:
  GuidanceTraits traits_;
};

class SaturatingGuidance final : public GuidanceLaw {
 public:
  explicit SaturatingGuidance(const GuidanceSetup& setup)
      : limit_(setup.options.limit),
        traits_{with_stiffness("saturating", setup) + ", at most " + number_text(limit_) + " N", setup.stiffness, 0.0,
                false, false} {}
  GuidanceTraits traits() const override { return traits_; }
  GuidanceTerms force(const GuidanceInput& input) override {
    const Point spring = attraction_force(input.stiffness * input.share, input.tip, input.target);
    const Point saturated = saturated_force(spring, limit_);
    const double linear = spring.norm();
    double share = damped_share(input, input.share);
    // Across the stroke the stiffness falls by the square of this factor.
    if (linear > 0.0) share *= std::sqrt(saturated.norm() / linear);
    return {saturated, damper_of(input, share)};
  }

 private:
  double limit_;  ///< [N]
  GuidanceTraits traits_;
};

class PrintedGuidance final : public GuidanceLaw {
 public:
  explicit PrintedGuidance(const GuidanceSetup& setup)
      : traits_{with_stiffness("wang2006", setup), setup.stiffness, 0.0, false, false} {}
  GuidanceTraits traits() const override { return traits_; }
  GuidanceTerms force(const GuidanceInput& input) override {
    const double share = input.share * input.weight;
    return {attraction_force(input.stiffness * share, input.tip, input.target),
            damper_of(input, damped_share(input, share))};
  }

 private:
  GuidanceTraits traits_;
};

}  // namespace

Point guidance_damper(const GuidanceInput& input, double share) noexcept { return damper_of(input, share); }

std::unique_ptr<GuidanceLaw> linear_guidance(const GuidanceSetup& setup) {
  return std::make_unique<LinearGuidance>(setup);
}

std::unique_ptr<GuidanceLaw> saturating_guidance(const GuidanceSetup& setup) {
  return std::make_unique<SaturatingGuidance>(setup);
}

std::unique_ptr<GuidanceLaw> printed_guidance(const GuidanceSetup& setup) {
  return std::make_unique<PrintedGuidance>(setup);
}

}  // namespace calligraphy
