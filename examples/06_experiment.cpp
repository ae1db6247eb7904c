// An experiment: how much does guidance help a novice? Every seed writes the same page twice, with and without force.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <calligraphy/calligraphy.hpp>

int main() {
  using namespace calligraphy;
  const PracticePage page = lay_out(std::vector{built_in_characters().at(U'永')}).front();
  SessionOptions options;
  options.device = device_profile("desktop");
  options.renderer = RendererOptions::for_device(options.device);
  options.skill = WriterSkill::novice();

  constexpr int pairs = 20;
  double sum = 0.0, squares = 0.0;
  for (int seed = 1; seed <= pairs; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);  // the same beliefs and mistakes in both modes: a fair pair
    double error[2] = {};
    for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
      options.mode = mode;
      error[mode == FeedbackMode::force] = score_page(page, write_page(page, options)).front().rms_error;
    }
    const double change = error[1] / error[0] - 1.0;
    sum += change;
    squares += change * change;
  }
  const double mean = sum / pairs;
  const double deviation = std::sqrt((squares - pairs * mean * mean) / (pairs - 1));
  constexpr double student_t = 2.093;  // 95 %, 19 degrees of freedom
  std::printf("RMS lateral error with force: %+.1f %% +- %.1f %% (95 %% interval, %d pairs)\n", 100.0 * mean,
              100.0 * student_t * deviation / std::sqrt(double{pairs}), pairs);
  return mean < 0.0 ? 0 : 1;
}
