// Reproduces the paper's result (Wang 2006, Table 5, Figs. 37 and 38) with a writer that does not know the mode.
#include <cmath>
#include <cstdio>

#include <calligraphy/practice/score.hpp>

#include "../catch.hpp"
#include "pages.hpp"

using namespace calligraphy;
using calligraphy_test::session;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int seeds = 2;  // sanitizer builds check memory only; the claim is tested with 20
constexpr const char* text = "北永书";
#else
constexpr int seeds = 20;
constexpr const char* text = "北京航空天大学永和年中国书法一木美家我女";
#endif

struct Sums {
  int count = 0;
  double sum = 0.0, square = 0.0;
  void add(double value) { ++count, sum += value, square += value * value; }
  double mean() const { return sum / count; }
  /// Half width of the 95 % confidence interval of the mean, by the normal quantile: there are hundreds of pairs.
  double half_width() const { return 1.96 * std::sqrt((square - sum * sum / count) / (count - 1.0) / count); }
};

}  // namespace

TEST_CASE("force reduces an unskilled writer's mean error and time on every character", "[practice]") {
  Sums error_reduction, time_reduction;
  for (const Character& character : calligraphy_test::characters(text)) {
    const PracticePage page = lay_out(std::span(&character, 1)).front();
    Sums error[2], time[2];
    for (int seed = 1; seed <= seeds; ++seed) {
      CharacterScore result[2];
      for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
        const auto i = static_cast<std::size_t>(mode);
        result[i] =
            score_page(page, write_page(page, session(WriterSkill::novice(), mode, static_cast<std::uint64_t>(seed))))
                .front();
        CHECK(result[i].strokes_completed == result[i].stroke_count);
        error[i].add(result[i].rms_error);
        time[i].add(result[i].time);
      }
      error_reduction.add(1.0 - result[1].rms_error / result[0].rms_error);
      time_reduction.add(1.0 - result[1].time / result[0].time);
    }
    CAPTURE(encode_utf8(character.code));
#if !defined(__SANITIZE_ADDRESS__)
    CHECK(error[1].mean() < error[0].mean());
    CHECK(time[1].mean() < time[0].mean());
#endif
  }
  std::printf("%d pairs: RMS error smaller by %.1f +- %.1f %%, time by %.1f +- %.1f %% (mean, 95 %% interval)\n",
              error_reduction.count, 100.0 * error_reduction.mean(), 100.0 * error_reduction.half_width(),
              100.0 * time_reduction.mean(), 100.0 * time_reduction.half_width());
#if !defined(__SANITIZE_ADDRESS__)
  CHECK(error_reduction.mean() > error_reduction.half_width());
  CHECK(time_reduction.mean() > time_reduction.half_width());
#endif
}
