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

/// Input of a guidance law for one tick: where the pen is, in the page frame, and what the law is asked to do.
struct GuidanceInput {
  Point tip = Point::Zero();       ///< pen tip [m]
  Point velocity = Point::Zero();  ///< estimated velocity of the tip [m/s]
  /// Where guidance leads: the nearest point of the stroke; before it is begun, a point on the way to its start; beyond
  /// its end, the foot of the perpendicular on the tangent there [m].
  Point target = Point::Zero();
  Point way = Point::Zero();      ///< from the tip to the target [m]
  Point tangent = Point::Zero();  ///< tangent of the stroke at its nearest point, in writing direction; unit vector
  double stiffness = 0.0;   ///< GuidanceOptions::stiffness times `attraction`, limited to what the device permits [N/m]
  double damping = 0.0;     ///< effective GuidanceOptions::damping [N s/m]
  double attraction = 1.0;  ///< attraction factor there, eq. (8): 1 on most strokes
  double weight = 1.0;      ///< weight of the constraint space: 0 outside it; 1 before the stroke is begun
  /// Factor on the force: that of the assist policy, times `weight` for a law that lets go [1].
  double share = 1.0;
  double resistance = 0.0;  ///< where writing backwards is resisted: share of `damping` along the stroke too [1]
  bool writing = false;     ///< the stroke is being written; otherwise the pen is on the way to its start

  // For laws that see the stroke (GuidanceTraits):
  Point nearest = Point::Zero();   ///< nearest point of the stroke; before it is begun, its start [m]
  double distance = 0.0;           ///< from the tip to `nearest` [m]
  double curvature = 0.0;          ///< curvature of the stroke there, positive to the left [1/m]
  Point feature = Point::Zero();   ///< feature point that ends the element there [m]
  double arc = 0.0;                ///< length of the stroke up to `nearest` [m]
  double left = 0.0;               ///< length from there to its end [m]
  double backwards = 0.0;          ///< length by which the pen is behind the furthest point that it reached [m]
  Point to_start = Point::Zero();  ///< from the tip to the start of the stroke [m]
  double depth = 0.0;              ///< depth of the device below the paper [m]
  double em = 0.0;                 ///< edge of the character's square [m]
  double dt = 0.0;                 ///< period of the servo loop [s]
  double max_stiffness = 0.0;      ///< maximum stable in any hand, next to the other springs and `damping` [N/m]
};

/// Output of a guidance law: its force on the pen, in page axes.
struct GuidanceTerms {
  Point spring = Point::Zero();  ///< part that depends on where the pen is [N]
  Point damper = Point::Zero();  ///< part that depends on how the pen moves, which an exhausted budget can keep [N]
  double normal = 0.0;           ///< normal force in addition to the paper's, out of the paper [N]
};

/// Share of the damping that remains where no spring acts while the pen touches the paper, so that a pen that nobody
/// holds does not coast on [1].
inline constexpr double unguided_damping = 0.15;

/// Force of the built-in laws' damper [N]: for this share of guidance, all of `damping` in the direction that guidance
/// leads, across the stroke; `unguided_damping` of it on the rest of the motion.
Point guidance_damper(const GuidanceInput& input, double share) noexcept;

/// What a renderer must know about a guidance law.
struct GuidanceTraits {
  std::string name = "own";  ///< name with its parameters, for recordings: "saturating: 600 N/m, at most 2 N"
  /// Maximum change of the force with the position of the pen, for a law that depends on nothing else and is damped by
  /// guidance_damper(). A law stiffer than the device permits is refused or scaled down (StiffnessCheck). NaN: unknown,
  /// or the law has memory; then the force follows the pen at the stiffness that the device permits, within an energy
  /// budget, without which a real device is refused [N/m].
  double stiffness = std::numeric_limits<double>::quiet_NaN();
  double power = 0.0;       ///< power to lead a pen on, at most 10; added to the energy budget, which it needs [W]
  bool lets_go = true;      ///< it lets go of a pen that is far from the stroke or that the hand pulls elsewhere
  bool sees_stroke = true;  ///< it reads the fields of GuidanceInput from `nearest` on, which takes about 2 ns
};

/// Leads a pen along the strokes of one page. It may have memory.
///
/// The renderer does the rest for every law: it asks for a force only while the pen is led, never in the air; fades it
/// in and out (GuidanceOptions::fade_in, `fade_out`); adds the resistance to writing backwards; and limits rate, peak,
/// heat and energy. A law that throws, or a force that is not finite, gives no force and TickStatus::bad_law.
class GuidanceLaw {
 public:
  virtual ~GuidanceLaw() = default;
  /// The traits of the law. Called once, when the renderer is made.
  virtual GuidanceTraits traits() const { return {}; }
  /// Called before the first force() of each attempt at a stroke. The stroke lives as long as the renderer.
  virtual void begin(const ActiveStroke& stroke) { static_cast<void>(stroke); }
  /// The force for one tick. Called in the servo loop: it should neither allocate, lock nor log.
  virtual GuidanceTerms force(const GuidanceInput& input) = 0;
};

/// What is known when a renderer makes its law.
struct GuidanceSetup {
  const GuidanceOptions& options;  ///< effective options
  double stiffness;                ///< largest GuidanceInput::stiffness on the page [N/m]
  double max_stiffness;            ///< GuidanceInput::max_stiffness [N/m]
  double dt;                       ///< GuidanceInput::dt [s]
};

/// A spring to the stroke within the constraint space, eq. (8).
std::unique_ptr<GuidanceLaw> linear_guidance(const GuidanceSetup& setup);
/// The same spring near the stroke, levelling off towards GuidanceOptions::limit, anywhere in the character's box.
std::unique_ptr<GuidanceLaw> saturating_guidance(const GuidanceSetup& setup);
/// Eq. (8) as printed, which never lets go. RendererOptions::wang2006() uses it, without damping.
std::unique_ptr<GuidanceLaw> printed_guidance(const GuidanceSetup& setup);

/// Makes the law of each renderer: GuidanceOptions::force.
///
/// It is made from a GuidanceLaw or a function of GuidanceInput, of which each renderer gets a copy, or from a function
/// of GuidanceSetup that returns a `std::unique_ptr<GuidanceLaw>`. A function of GuidanceInput returns either
/// GuidanceTerms or a Point; a Point is the spring, and guidance_damper() damps it.
class GuidanceFactory {
 public:
  /// A function such as linear_guidance.
  using Make = std::unique_ptr<GuidanceLaw>(const GuidanceSetup&);

  GuidanceFactory() : make_(linear_guidance) {}
  /// From a law, a function that gives its force, or a function that makes it.
  template <class Law>
  requires(!std::is_same_v<Law, GuidanceFactory>)
  GuidanceFactory(Law law);
  /// From a function that gives its force, and the traits of the law.
  template <class Force>
  GuidanceFactory(Force force, GuidanceTraits traits);

  /// The law of one renderer.
  std::unique_ptr<GuidanceLaw> operator()(const GuidanceSetup& setup) const { return make_(setup); }
  /// The object that makes the law, if it is of this type; otherwise null.
  template <class Type>
  const Type* target() const noexcept {
    return make_.target<Type>();
  }
  /// Whether this function makes the law, such as saturating_guidance.
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
  using Result = detail::Returned<Force&, const GuidanceInput&>;
  static_assert(std::is_same_v<Result, Point> || std::is_same_v<Result, GuidanceTerms>,
                "a guidance law returns Point or GuidanceTerms: write -> Point after the lambda's parameters, since an "
                "Eigen expression refers to temporaries that are gone");

  /// From the function and the traits of the law.
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
