// Figs. 25 to 28 of Wang 2006 on strokes of the built-in set.
#include <calligraphy/experiments/force_field.hpp>

#include <array>
#include <cstddef>
#include <utility>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {
namespace {

/// One case of sec. 6 and where to look at it [em].
struct Case {
  const char* name;
  const char* title;
  char32_t character;
  int stroke;       ///< the active one, by index
  bool alone;       ///< the other strokes of the character are left out
  double progress;  ///< share of the stroke's length
  Point corner;     ///< lower left of the square
  double edge;
};

PlacedCharacter placed_character(const Case& shown) {
  const Character& character = *built_in_characters().find(shown.character);
  if (!shown.alone) return {character, {}};
  const StrokeInput input = input_of(strokes(character)[static_cast<std::size_t>(shown.stroke)]);
  return {make_character(character.code, std::span(&input, 1), character.curve_degree), {}};
}

Point middle_line(const PlacedCharacter& placed, int stroke, double progress) {
  ActiveStroke active;
  active.load(strokes(placed.character)[static_cast<std::size_t>(stroke)], placed.placement);
  return active.at(progress * active.length()).point;
}

}  // namespace

std::vector<ForceFieldFigure> ambiguity_figures(int columns) {
  const std::array cases = {
      Case{"bend", "Strong bend (Fig. 25): the curve of \u4E59", U'\u4E59', 0, true, 0.62, {0.06, 0.02}, 0.86},
      Case{"corner", "Corner (Fig. 26): the second stroke of \u53E3", U'\u53E3', 1, true, 0.45, {0.16, 0.1}, 0.86},
      Case{"parallel",
           "Parallel strokes (Fig. 27): the second stroke of \u4E09",
           U'\u4E09',
           1,
           false,
           0.5,
           {0.02, 0.02},
           0.96},
      Case{"crossed",
           "Crossed strokes (Fig. 28): the second stroke of \u5341",
           U'\u5341',
           1,
           false,
           0.3,
           {0.02, 0.02},
           0.96},
  };
  std::vector<ForceFieldFigure> figures;
  for (const Case& shown : cases) {
    ForceFieldFigure figure;
    figure.name = shown.name;
    figure.title = shown.title;
    figure.placed = placed_character(shown);
    figure.stroke = shown.alone ? 0 : shown.stroke;
    figure.progress = shown.progress;
    figure.pen = middle_line(figure.placed, figure.stroke, shown.progress);
    ForceFieldOptions options;
    options.columns = columns;
    options.stiffness = RendererOptions().guidance.stiffness;
    const auto add = [&](std::string name, const RendererOptions& renderer) {
      options.stroke = {renderer.nearest, renderer.guidance.space, renderer.rules};
      const Placement& placement = figure.placed.placement;
      figure.panels.push_back({std::move(name), renderer.guidance.fade_in > 0.0,
                               guidance_field(figure.placed, figure.stroke, figure.progress,
                                              placement.to_page(shown.corner), placement.em * shown.edge, options)});
    };
    options.attractor = Attractor::nearest_stroke;
    add("no active stroke: the nearest attracts", {});
    options.attractor = Attractor::active_stroke;
    add("wang2006: active stroke, as printed", RendererOptions::wang2006());
    add("default", {});
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace calligraphy
