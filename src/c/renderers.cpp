#include <cstring>
#include <string_view>

#include <calligraphy/practice/hint_text.hpp>

#include "ticks.hpp"

namespace calligraphy::c {
namespace {

RendererOptions preset_of(std::int32_t preset, const Capabilities& capabilities, double scale) {
  switch (enumeration("preset", preset, CALLIGRAPHY_PRESET_WANG2006)) {
    case CALLIGRAPHY_PRESET_EVERYTHING:
      return RendererOptions::everything(capabilities, scale);
    case CALLIGRAPHY_PRESET_WANG2006:
      return RendererOptions::wang2006();
    default:
      return RendererOptions::for_device(capabilities, scale);
  }
}

}  // namespace

RendererObject::RendererObject(const PracticePage& page, const MotionMapping& mapping, const Capabilities& capabilities,
                               const RendererOptions& options)
    : renderer(page.characters, mapping, capabilities, options) {
  for (const std::string& line : renderer.clipped()) clipped += line + "\n";
  for (const PlacedCharacter& placed : page.characters) {
    first.push_back(starts.size());
    for (const Stroke& stroke : strokes(placed.character)) starts.push_back(start_of(stroke, placed.placement));
    starts.emplace_back();
  }
  first.push_back(starts.size());
  starts.emplace_back();
}

}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_renderer_options_for(const calligraphy_capabilities* capabilities, int32_t preset,
                                                    double scale, int32_t tolerance,
                                                    calligraphy_renderer_options* options) {
  return guarded([&] {
    RendererOptions result = preset_of(preset, capabilities_of(capabilities), scale);
    const auto tolerances = tolerances_of<StrokeTolerances>(tolerance);
    if (preset != CALLIGRAPHY_PRESET_WANG2006 || tolerance != CALLIGRAPHY_TOLERANCE_NORMAL)
      result.tolerances = tolerances;
    write_struct(options, "calligraphy_renderer_options", to_c(result));
  });
}

calligraphy_status calligraphy_renderer_create(const calligraphy_page* page, const calligraphy_mapping* mapping,
                                               const calligraphy_capabilities* capabilities,
                                               const calligraphy_renderer_options* options,
                                               calligraphy_renderer** renderer) {
  return guarded([&] {
    target(renderer, "renderer");
    const PracticePage& written = object<PracticePage>(page);
    const MotionMapping used = mapping ? mapping_of(mapping) : upright_page(written.width, written.height);
    const Capabilities device = capabilities_of(capabilities);
    const RendererOptions chosen = options ? options_of(options) : RendererOptions::for_device(device, used.scale);
    hand_out(renderer, std::make_shared<RendererObject>(written, used, device, chosen));
  });
}

calligraphy_status calligraphy_renderer_effective_options(const calligraphy_renderer* renderer,
                                                          calligraphy_renderer_options* options) {
  return guarded([&] {
    write_struct(options, "calligraphy_renderer_options", to_c(object<RendererObject>(renderer).renderer.options()));
  });
}

calligraphy_status calligraphy_renderer_clipped(const calligraphy_renderer* renderer, const char** lines) {
  return guarded([&] { target(lines, "lines") = object<RendererObject>(renderer).clipped.c_str(); });
}

calligraphy_status calligraphy_renderer_update(calligraphy_renderer* renderer, const calligraphy_device_state* state,
                                               calligraphy_tick* tick) {
  if (const calligraphy_status status = check_tick(tick)) return status;
  auto* const found = find<RendererObject>(renderer);
  if (!found) return without_force(tick, refuse_handle(Kind::renderer, renderer));
  if (const calligraphy_status status = check_given(state, "calligraphy_device_state")) {
    return without_force(tick, status);
  }
  found->renderer.update(state_of(state));
  write_tick(*found, tick);
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_renderer_restart(calligraphy_renderer* renderer) {
  auto* const found = find<RendererObject>(renderer);
  if (!found) return refuse_handle(Kind::renderer, renderer);
  found->renderer.restart();
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_renderer_skip_stroke(calligraphy_renderer* renderer, int32_t* skipped) {
  auto* const found = find<RendererObject>(renderer);
  if (!found) return refuse_handle(Kind::renderer, renderer);
  const bool is_skipped = found->renderer.skip_stroke();
  if (skipped) *skipped = is_skipped;
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_hint_text(const calligraphy_tick* tick, const char* language, char* text,
                                         size_t capacity) {
  return guarded([&] {
    const calligraphy_tick given = read_struct(tick, "calligraphy_tick");
    target(text, "text");
    const auto hint = enumeration("hint", given.hint, WritingHint::lifted_early);
    const Language chosen = language ? Language(language) : Language();
    const std::string words = hint_text(hint, {given.to_start[0], given.to_start[1]}, chosen);
    if (words.size() >= capacity) {
      throw Refusal(CALLIGRAPHY_TOO_SMALL, "capacity = " + std::to_string(capacity) + ", but the text has " +
                                               std::to_string(words.size() + 1) + " bytes with its zero");
    }
    std::memcpy(text, words.c_str(), words.size() + 1);
  });
}
