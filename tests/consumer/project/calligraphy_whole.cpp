// Writes one character with everything.
#include <cstdio>
#include <vector>

#include <calligraphy/calligraphy.hpp>

int main() {
  using namespace calligraphy;
  const std::vector<Character> text = {*built_in_characters().find(U'十')};
  const PracticePage page = lay_out(text).at(0);
  SessionOptions options;
  options.device = device_profile("desktop");
  options.renderer = RendererOptions::for_device(options.device);
  options.skill = WriterSkill::skilled();
  const CharacterScore result = score_page(page, write_page(page, options)).at(0);
  std::printf("%d of %d strokes, %.3f mm\n", result.strokes_completed, result.stroke_count, 1e3 * result.rms_error);
  return result.strokes_completed == result.stroke_count ? 0 : 1;
}
