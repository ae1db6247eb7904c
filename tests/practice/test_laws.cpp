// Laws of others in sessions, replay and live writing.
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <calligraphy/practice/live_session.hpp>
#include <calligraphy/practice/score.hpp>

#include "../catch.hpp"
#include "pages.hpp"

using namespace calligraphy;
using calligraphy_test::page_of;
using calligraphy_test::same;
using calligraphy_test::session;

namespace {

GuidanceTerms failing(const GuidanceInput&) { throw std::runtime_error("out of ideas"); }

}  // namespace

TEST_CASE("a law for the whole force acts in a session, as vision if it is none and as a renderer if it is one",
          "[practice]") {
  const PracticePage page = page_of("永");
  SessionOptions options = session(WriterSkill::novice(), FeedbackMode::force, 3);
  const Recording felt = write_page(page, options);
  HapticRenderer other(page.characters, upright_page(page.width, page.height), options.device, options.renderer);
  options.law = other;
  CHECK(same(write_page(page, options), felt));
  options.law = [](const DeviceState& state) -> Eigen::Vector3d { return 0.0 * state.velocity; };
  options.law.name = "nothing";
  const Recording nothing = write_page(page, options);
  CHECK(nothing.law == "nothing");
  options.law = {};
  options.mode = FeedbackMode::vision;
  CHECK(same(write_page(page, options), nothing));
}

TEST_CASE("a law for the whole force is limited to the device's peak, keeping its direction", "[practice]") {
  SessionOptions options = session(WriterSkill::skilled(), FeedbackMode::force);
  options.law = [](const DeviceState&) -> Eigen::Vector3d { return {0.0, 300.0, 400.0}; };
  const Recording recording = write_page(page_of("一"), options);
  const Eigen::Vector3d expected = options.device.peak_force * Eigen::Vector3d(0.0, 0.6, 0.8);
  CHECK(recording.samples.back().force.isApprox(expected));
}

TEST_CASE("a session ends with what its law throws, and where its force is not finite", "[practice]") {
  const PracticePage page = page_of("一");
  SessionOptions options = session(WriterSkill::skilled(), FeedbackMode::force);
  options.law = [](const DeviceState&) -> Eigen::Vector3d { throw std::runtime_error("no force"); };
  CHECK_THROWS_WITH(write_page(page, options), "no force");
  options.law = [](const DeviceState&) -> Eigen::Vector3d { return Eigen::Vector3d::Constant(NAN); };
  CHECK_THROWS_WITH(write_page(page, options), "force law \"own\": its force is not finite");
  options.law = {};
  options.renderer.guidance.force = {[](const GuidanceInput& in) -> Point { return in.way / 0.0; }, {.name = "thin"}};
  CHECK_THROWS_WITH(write_page(page, options), "guidance law \"thin, within 0.1 J\": its force is not finite");
  options.renderer.guidance.force = failing;
  CHECK_THROWS_WITH(write_page(page, options), "out of ideas");
}

TEST_CASE("recordings name the law and its parameters", "[practice]") {
  const PracticePage page = page_of("一");
  SessionOptions options = session(WriterSkill::skilled(), FeedbackMode::force);
  options.renderer = RendererOptions::everything(options.device);
  const Recording recording = write_page(page, options);
  const GuidanceOptions& guidance = options.renderer.guidance;
  std::ostringstream expected;
  expected << "saturating: " << guidance.stiffness << " N/m, at most " << guidance.limit << " N";
  CHECK(recording.law == expected.str());
}
