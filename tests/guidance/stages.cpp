#include "stages.hpp"

#include "base/parallel.hpp"
#include "stroke_line.hpp"

namespace calligraphy_test {

using namespace calligraphy;

std::vector<StagesRun> write_with_stages(const std::vector<Character>& characters, int times,
                                         const Capabilities& device, double em, int threads,
                                         const std::function<void(double)>& progress) {
  std::vector<StagesRun> runs(characters.size() * static_cast<std::size_t>(times));
  SessionOptions standard;
  standard.device = device;
  standard.skill = WriterSkill::novice();
  standard.renderer = RendererOptions::for_device(device);
  SessionOptions everything = standard, vision = standard;
  everything.renderer = RendererOptions::everything(device);
  vision.mode = FeedbackMode::vision;
  parallel_for(
      runs.size(), threads, progress ? progress : [](double) {},
      [&](std::size_t i) {
        StagesRun& run = runs[i];
        const Character& character = characters[i % characters.size()];
        run.character = character.code;
        run.seed = 1 + i;
        const PracticePage page = page_of(character, em);
        const auto write = [&](SessionOptions options) {
          options.seed = run.seed;
          return write_character(page, options);
        };
        run.vision = write(vision);
        run.standard = write(standard);
        run.everything = write(everything);
      });
  return runs;
}

}  // namespace calligraphy_test
