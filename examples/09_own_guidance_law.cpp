// Your own guidance law in the closed loop: a channel, in which the writer is free, beside the built-in spring.
#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <calligraphy/calligraphy.hpp>

using namespace calligraphy;

namespace {

/// No force up to 1 mm from where guidance leads, a spring beyond.
Point channel(const GuidanceInput& in) {
  const double beyond = in.way.norm() - 0.001;  // [m]
  if (beyond <= 0.0) return Point::Zero();
  return in.share * in.stiffness * beyond * in.way.normalized();
}

}  // namespace

int main() {
  const PracticePage page = lay_out({built_in_characters().at(U'永')}).front();
  SessionOptions options;
  options.device = device_profile("desktop");
  options.renderer = RendererOptions::for_device(options.device);
  options.skill = WriterSkill::novice();
  const double stiffness = options.renderer.guidance.stiffness;
  const std::array laws = {GuidanceFactory(linear_guidance),
                           GuidanceFactory(channel, {.name = "channel", .stiffness = stiffness})};

  std::vector<DrawnValue> changes;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    options.seed = seed;  // the same beliefs and mistakes with both laws: a fair pair, and a draw of its own
    double error[2] = {};
    for (std::size_t law = 0; law < laws.size(); ++law) {
      options.renderer.guidance.force = laws[law];
      error[law] = score_page(page, write_page(page, options)).front().rms_error;
    }
    changes.push_back({error[1] / error[0] - 1.0, seed});
  }
  const MeanInterval change = mean_interval(changes);
  std::printf("RMS lateral error in the channel, beside that with the spring: %+.1f %% +- %.1f %% (95 %% interval, %zu "
              "pairs)\n",
              100.0 * change.mean, 100.0 * change.half_width, change.draws);
  return change.mean > 0.0 ? 0 : 1;
}
