#include "guidance.hpp"

#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "conversions.hpp"
#include "objects.hpp"
#include "structs.hpp"

namespace calligraphy::c {
namespace {

calligraphy_guidance_input to_c(const GuidanceInput& from) noexcept {
  calligraphy_guidance_input result = {};
  result.size = sizeof result;
  result.writing = from.writing;
  to_array(from.tip, result.tip);
  to_array(from.velocity, result.velocity);
  to_array(from.target, result.target);
  to_array(from.way, result.way);
  to_array(from.tangent, result.tangent);
  result.stiffness = from.stiffness;
  result.damping = from.damping;
  result.attraction = from.attraction;
  result.weight = from.weight;
  result.share = from.share;
  result.resistance = from.resistance;
  to_array(from.nearest, result.nearest);
  result.distance = from.distance;
  result.curvature = from.curvature;
  to_array(from.feature, result.feature);
  result.arc = from.arc;
  result.left = from.left;
  result.backwards = from.backwards;
  to_array(from.to_start, result.to_start);
  result.depth = from.depth;
  result.em = from.em;
  result.dt = from.dt;
  result.max_stiffness = from.max_stiffness;
  return result;
}

class OwnGuidance final : public GuidanceLaw {
 public:
  OwnGuidance(const calligraphy_guidance_functions& functions, GuidanceTraits traits)
      : functions_(functions),
        traits_(std::move(traits)),
        stroke_(std::make_shared<StrokeObject>()),
        handle_(add_handle(Kind::stroke, stroke_)) {}
  ~OwnGuidance() override { remove_handle(handle_); }
  OwnGuidance(const OwnGuidance&) = delete;
  OwnGuidance& operator=(const OwnGuidance&) = delete;

  GuidanceTraits traits() const override { return traits_; }
  void begin(const ActiveStroke& stroke) override {
    stroke_->stroke = &stroke;
    if (functions_.begin) functions_.begin(functions_.user, static_cast<calligraphy_active_stroke*>(handle_));
  }
  GuidanceTerms force(const GuidanceInput& input) override {
    const calligraphy_guidance_input in_c = to_c(input);
    calligraphy_guidance_terms terms = {};
    terms.size = sizeof terms;
    to_array(guidance_damper(input, input.share), terms.damper);
    if (functions_.force(functions_.user, &in_c, &terms) != 0) {
      return {Point::Constant(std::numeric_limits<double>::quiet_NaN())};  // unlike an exception, NaN does not allocate
    }
    return {{terms.spring[0], terms.spring[1]}, {terms.damper[0], terms.damper[1]}, terms.normal};
  }

 private:
  calligraphy_guidance_functions functions_;
  GuidanceTraits traits_;
  std::shared_ptr<StrokeObject> stroke_;
  void* handle_;
};

}  // namespace

GuidanceFactory guidance_of(const calligraphy_guidance_functions* given) {
  const calligraphy_guidance_functions functions = read_struct(given, "calligraphy_guidance_functions");
  if (!functions.force) throw_null("calligraphy_guidance_functions: force");
  GuidanceTraits traits;
  if (functions.name) traits.name = functions.name;
  if (functions.stiffness != 0.0) traits.stiffness = functions.stiffness;
  traits.power = functions.power;
  traits.lets_go = functions.never_lets_go == 0;
  return [functions, traits](const GuidanceSetup&) -> std::unique_ptr<GuidanceLaw> {
    return std::make_unique<OwnGuidance>(functions, traits);
  };
}

}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_active_stroke_at(const calligraphy_active_stroke* stroke, double arc,
                                                calligraphy_stroke_place* place) {
  const auto* const found = find<StrokeObject>(stroke);
  if (!found) return refuse_handle(Kind::stroke, stroke);
  if (const calligraphy_status status = check_size(place, "calligraphy_stroke_place")) return status;
  const StrokePlace there = found->stroke->at(arc);
  calligraphy_stroke_place result = {};
  to_array(there.point, result.point);
  to_array(there.tangent, result.tangent);
  result.curvature = there.curvature;
  result.length = found->stroke->length();
  put_struct(place, result);
  return CALLIGRAPHY_OK;
}
