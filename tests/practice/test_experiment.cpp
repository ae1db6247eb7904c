// Reproduces the paper's result (Wang 2006, Table 5, Figs. 37 and 38) with a writer that does not know the mode.
#include <cstdio>
#include <numeric>
#include <vector>

#include <calligraphy/practice/mean_interval.hpp>
#include <calligraphy/practice/score.hpp>

#include "../catch.hpp"
#include "pages.hpp"

using namespace calligraphy;
using calligraphy_test::session;

namespace {

constexpr int seeds = 20;
constexpr const char* text = "北京航空天大学永和年中国书法一木美家我女";

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("force reduces an unskilled writer's mean error and time on every character", "[practice]") {
  // Each character is alone on its page, so each pair of character and seed is a draw of its own (SimulatedWriter).
  std::vector<DrawnValue> errors, times;
  for (const Character& character : calligraphy_test::characters(text)) {
    const PracticePage page = lay_out(std::span(&character, 1)).front();
    std::vector<double> error[2], time[2];
    for (int seed = 1; seed <= seeds; ++seed) {
      CharacterScore result[2];
      for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
        const auto i = static_cast<std::size_t>(mode);
        result[i] =
            score_page(page, write_page(page, session(WriterSkill::novice(), mode, static_cast<std::uint64_t>(seed))))
                .front();
        CHECK(result[i].strokes_completed == result[i].stroke_count);
        error[i].push_back(result[i].rms_error);
        time[i].push_back(result[i].time);
      }
      errors.push_back({1.0 - result[1].rms_error / result[0].rms_error, errors.size()});
      times.push_back({1.0 - result[1].time / result[0].time, times.size()});
    }
    CAPTURE(encode_utf8(character.code));
    CHECK(mean(error[1]) < mean(error[0]));
    CHECK(mean(time[1]) < mean(time[0]));
  }
  const MeanInterval error = mean_interval(errors), time = mean_interval(times);
  std::printf("%zu pairs: RMS error smaller by %.1f +- %.1f %%, time by %.1f +- %.1f %% (mean, 95 %% interval)\n",
              error.draws, 100.0 * error.mean, 100.0 * error.half_width, 100.0 * time.mean, 100.0 * time.half_width);
  CHECK(error.mean > error.half_width);
  CHECK(time.mean > time.half_width);
}
