// An experiment: how much does guidance help a novice? Every seed writes the same page twice, with and without force.
#include <cstdint>
#include <cstdio>
#include <vector>

#include <calligraphy/calligraphy.hpp>

int main() {
  using namespace calligraphy;
  const PracticePage page = lay_out({built_in_characters().at(U'永')}).front();
  SessionOptions options;
  options.device = device_profile("desktop");
  options.renderer = RendererOptions::for_device(options.device);
  options.skill = WriterSkill::novice();

  std::vector<DrawnValue> changes;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    options.seed = seed;  // the same beliefs and mistakes in both modes: a fair pair, and a draw of its own
    double error[2] = {};
    for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
      options.mode = mode;
      error[mode == FeedbackMode::force] = score_page(page, write_page(page, options)).front().rms_error;
    }
    changes.push_back({error[1] / error[0] - 1.0, seed});
  }
  const MeanInterval change = mean_interval(changes);
  std::printf("RMS lateral error with force: %+.1f %% +- %.1f %% (95 %% interval, %zu pairs)\n", 100.0 * change.mean,
              100.0 * change.half_width, change.draws);
  return change.mean < 0.0 ? 0 : 1;
}
