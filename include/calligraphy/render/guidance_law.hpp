// How the pen is led along the stroke that is due: built-in laws, and the seam for others.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include <calligraphy/base/detail/returned.hpp>
#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

struct GuidanceOptions;

/// What a guidance law is told in a tick: where the pen is, page frame, and what is asked of the law.
struct GuidanceInput {
  Point tip = Point::Zero();       ///< of the pen [m]
  Point velocity = Point::Zero();  ///< of it, an estimate [m/s]
  /// Where guidance leads: the nearest point of the stroke; before that is begun, a point on the way to its start;
  /// beyond its end, the foot on the tangent there [m].
  Point target = Point::Zero();
  Point way = Point::Zero();      ///< from the tip to the target [m]
  Point tangent = Point::Zero();  ///< of the stroke at its nearest point, in writing direction; unit vector
  double stiffness = 0.0;   ///< GuidanceOptions::stiffness times `attraction`, as far as the device stands it [N/m]
  double damping = 0.0;     ///< GuidanceOptions::damping as it takes effect [N s/m]
  double attraction = 1.0;  ///< attraction factor there, eq. (8): 1 on most strokes
  double weight = 1.0;      ///< of the constraint space, 0 outside; 1 before the stroke is begun
  /// Factor on the force: that of the assist policy and, for a law that lets go, `weight` [1].
  double share = 1.0;
  double resistance = 0.0;  ///< where writing backwards is resisted: of the damping, along the stroke too [1]
  bool writing = false;     ///< the stroke; otherwise on the way to its start

  // For laws that see the stroke (GuidanceTraits):
  Point nearest = Point::Zero();   ///< point of the stroke; before it is begun, its start [m]
  double distance = 0.0;           ///< from the tip to `nearest` [m]
  double curvature = 0.0;          ///< of the stroke there, positive to the left [1/m]
  Point feature = Point::Zero();   ///< feature point that ends the element there [m]
  double arc = 0.0;                ///< length of the stroke up to `nearest` [m]
  double left = 0.0;               ///< length from there to its end [m]
  double backwards = 0.0;          ///< length by which the pen is behind the furthest point that it reached [m]
  Point to_start = Point::Zero();  ///< from the tip to the start of the stroke [m]
  double depth = 0.0;              ///< of the device below the paper [m]
  double em = 0.0;                 ///< edge of the character's square [m]
  double dt = 0.0;                 ///< period of the servo loop [s]
  double max_stiffness = 0.0;      ///< stable in any hand on the device, beside the other springs and `damping` [N/m]
};

/// What a law answers, on the pen, page axes.
struct GuidanceTerms {
  Point spring = Point::Zero();  ///< what depends on where the pen is [N]
  Point damper = Point::Zero();  ///< what depends on how it moves, so that an exhausted budget can keep it [N]
  double normal = 0.0;           ///< in addition to the paper's, out of the paper [N]
};

/// What is left of the damping where no spring acts, as long as the pen touches the paper: a pen that nobody holds does
/// not coast on [1].
inline constexpr double unguided_damping = 0.15;

/// The damper of the built-in laws: for this share of guidance all of `damping` across the way that is led, free along
/// the stroke, and `unguided_damping` of it elsewhere [N].
Point guidance_damper(const GuidanceInput& input, double share) noexcept;

/// What a renderer has to know of a law.
struct GuidanceTraits {
  std::string name = "own";  ///< with its parameters, for recordings: "saturating: 600 N/m, at most 2 N"
  /// By how much its force changes at most with the place of the pen, if it is a function of that alone and damped by
  /// guidance_damper(). A stiffer one than the device stands is refused, or scaled down (StiffnessCheck). NaN: not known,
  /// or a law that remembers; then the force follows the pen at the stiffness that the device stands, and there is a
  /// budget of energy, without which a real device is refused [N/m].
  double stiffness = std::numeric_limits<double>::quiet_NaN();
  double power = 0.0;       ///< at most 10, with which it may lead a pen on; added to the budget, which it needs [W]
  bool lets_go = true;      ///< of a pen that is far from the stroke, or that the hand pulls elsewhere
  bool sees_stroke = true;  ///< reads GuidanceInput from `nearest` on, which takes some 2 ns
};

/// Leads a pen along the strokes of one page, with what it remembers.
///
/// Around it, and whatever the law: it is asked while the pen is led, never in the air; it sets in and is withdrawn in
/// time (GuidanceOptions::fade_in, `fade_out`), beside the resistance to writing backwards; rate, peak, heat and energy
/// are limited. What throws, or is not finite, is no force and TickStatus::bad_law.
class GuidanceLaw {
 public:
  virtual ~GuidanceLaw() = default;
  /// Once, when the renderer is made.
  virtual GuidanceTraits traits() const { return {}; }
  /// Before the first force() of each attempt at a stroke, which lives as long as the renderer.
  virtual void begin(const ActiveStroke& stroke) { static_cast<void>(stroke); }
  /// In the servo loop: should neither allocate, lock nor log.
  virtual GuidanceTerms force(const GuidanceInput& input) = 0;
};

/// What is known when a renderer makes its law.
struct GuidanceSetup {
  const GuidanceOptions& options;  ///< as they take effect
  double stiffness;                ///< largest GuidanceInput::stiffness on the page [N/m]
  double max_stiffness;            ///< GuidanceInput::max_stiffness [N/m]
  double dt;                       ///< [s]
};

/// A spring to the stroke within the constraint space, eq. (8).
std::unique_ptr<GuidanceLaw> linear_guidance(const GuidanceSetup& setup);
/// The same spring near the stroke, which levels off towards GuidanceOptions::limit, anywhere in the character's box.
std::unique_ptr<GuidanceLaw> saturating_guidance(const GuidanceSetup& setup);
/// Eq. (8) as the paper has it: it never lets go. RendererOptions::wang2006() has it, without damping.
std::unique_ptr<GuidanceLaw> printed_guidance(const GuidanceSetup& setup);

/// Makes the law of each renderer: GuidanceOptions::force.
///
/// From a GuidanceLaw or a function of GuidanceInput, of which each renderer gets a copy; or from a function of a
/// GuidanceSetup that returns a `std::unique_ptr<GuidanceLaw>`. If a function of GuidanceInput returns a Point, that is
/// the spring, and guidance_damper() damps it; otherwise it returns GuidanceTerms.
class GuidanceFactory {
 public:
  /// A function such as linear_guidance.
  using Make = std::unique_ptr<GuidanceLaw>(const GuidanceSetup&);

  GuidanceFactory() : make_(linear_guidance) {}
  /// From a law, its force, or what makes it.
  template <class Law>
  requires(!std::is_same_v<Law, GuidanceFactory>)
  GuidanceFactory(Law law);
  /// From its force, with what a renderer has to know of it.
  template <class Force>
  GuidanceFactory(Force force, GuidanceTraits traits);

  /// The law of one renderer.
  std::unique_ptr<GuidanceLaw> operator()(const GuidanceSetup& setup) const { return make_(setup); }
  /// What makes the law, if it is of this type; otherwise null.
  template <class Type>
  const Type* target() const noexcept {
    return make_.target<Type>();
  }
  /// Whether it is this function, such as saturating_guidance.
  bool is(Make* make) const noexcept {
    Make* const* own = target<Make*>();
    return own && *own == make;
  }

 private:
  std::function<Make> make_;
};

/// A law that is a function of GuidanceInput.
template <class Force>
class FunctionLaw final : public GuidanceLaw {
 public:
  /// What the function returns.
  using Result = Returned<Force&, const GuidanceInput&>;
  static_assert(std::is_same_v<Result, Point> || std::is_same_v<Result, GuidanceTerms>,
                "a guidance law returns Point or GuidanceTerms: write -> Point after the lambda's parameters, since an "
                "Eigen expression refers to temporaries that are gone");

  /// From the function and what a renderer has to know of it.
  FunctionLaw(Force function, GuidanceTraits traits) : force_(std::move(function)), traits_(std::move(traits)) {}
  GuidanceTraits traits() const override { return traits_; }
  GuidanceTerms force(const GuidanceInput& input) override {
    if constexpr (std::is_same_v<Result, GuidanceTerms>) {
      return force_(input);
    } else {
      return {force_(input), guidance_damper(input, input.share)};
    }
  }

 private:
  Force force_;
  GuidanceTraits traits_;
};

template <class Law>
requires(!std::is_same_v<Law, GuidanceFactory>)
GuidanceFactory::GuidanceFactory(Law law) {
  if constexpr (std::is_base_of_v<GuidanceLaw, Law>) {
    make_ = [law = std::move(law)](const GuidanceSetup&) { return std::make_unique<Law>(law); };
  } else if constexpr (std::is_invocable_v<Law&, const GuidanceInput&>) {
    *this = GuidanceFactory(std::move(law), {});
  } else {
    static_assert(std::is_invocable_r_v<std::unique_ptr<GuidanceLaw>, Law&, const GuidanceSetup&>,
                  "a guidance law is a GuidanceLaw; or a function Point(const GuidanceInput&) or "
                  "GuidanceTerms(const GuidanceInput&); or a function of const GuidanceSetup& that makes a "
                  "std::unique_ptr<GuidanceLaw>");
    make_ = std::move(law);
  }
}

template <class Force>
GuidanceFactory::GuidanceFactory(Force force, GuidanceTraits traits)
    : make_([force = std::move(force), traits = std::move(traits)](const GuidanceSetup&) {
        return std::make_unique<FunctionLaw<Force>>(force, traits);
      }) {}

}  // namespace calligraphy
