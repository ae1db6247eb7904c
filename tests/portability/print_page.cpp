// print_page: two characters in closed loop by a novice and a skilled writer, with vision and with force: scores and the
// whole trace, one number a line, which agree to 1e-9 wherever they are computed.
#include <cstdio>
#include <vector>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

using namespace calligraphy;

int main() {
  const PracticePage page =
      lay_out(std::vector{*built_in_characters().find(U'永'), *built_in_characters().find(U'北')}).at(0);
  for (const WriterSkill& skill : {WriterSkill::novice(), WriterSkill::skilled()}) {
    for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
      SessionOptions options;
      options.device = device_profile("desktop");
      options.renderer = RendererOptions::for_device(options.device);
      options.skill = skill;
      options.mode = mode;
      const Recording recording = write_page(page, options);
      for (const CharacterScore& score : score_page(page, recording)) {
        std::printf("%.17g\n%.17g\n%.17g\n", score.rms_error, score.fidelity, score.time);
        std::fprintf(stderr, "%s: %.9f mm RMS, fidelity %.9f, %.3f s, %zu samples\n",
                     mode == FeedbackMode::force ? "force" : "vision", 1e3 * score.rms_error, score.fidelity,
                     score.time, recording.samples.size());
      }
      for (const RecordedSample& sample : recording.samples) {
        for (const double value : sample.pen_tip) std::printf("%.17g\n", value);
        for (const double value : sample.force) std::printf("%.17g\n", value);
      }
    }
  }
}
