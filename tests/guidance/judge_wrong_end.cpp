// guidance_judge wrong_end: strokes that are drawn from their ends.
#include <cstdio>

#include <calligraphy/model/character_list.hpp>

#include "judge_program.hpp"
#include "wrong_end.hpp"

namespace calligraphy_test {

using namespace calligraphy;

int wrong_end(Arguments& arguments) {
  const std::string device_name = arguments.text("--device", "all");
  const std::string renderer = arguments.text("--renderer", "default");
  SequenceOptions options;
  options.em = 1e-3 * arguments.number("--em", 40.0);
  options.threads = static_cast<int>(arguments.number("--threads", 0));
  const int strokes = static_cast<int>(arguments.number("--strokes", 65));
  if (!arguments.understood()) return 2;
  const auto characters = with_strokes(built_in_characters().characters, strokes);
  for (const Capabilities& device : devices_of(device_name)) {
    options.device = device;
    options.renderer = renderer_of(renderer, device);
    Share resisted, taken;
    for (const WrongEnd& stroke : draw_from_wrong_end(characters, options, progress())) {
      resisted.add(stroke.resisted());
      taken.add(stroke.taken);
      if (stroke.resisted()) continue;
      std::printf("%s, stroke %d of %.2f em: at most %.2f N against the motion, %+.1f mJ in all\n",
                  name_of(stroke.character).c_str(), stroke.stroke + 1, stroke.length, stroke.most, 1e3 * stroke.work);
    }
    std::printf("%-12s resisted: %d of %d (%.1f %%), finishing a stroke: %d\n", device.name.c_str(), resisted.count,
                resisted.of, resisted.percent(), taken.count);
  }
  return 0;
}

}  // namespace calligraphy_test
