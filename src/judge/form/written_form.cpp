#include "written_form.hpp"

#include <algorithm>
#include <utility>

namespace calligraphy {

WrittenForm written_form(const CharacterForm& form, std::span<const PenPath> paths,
                         std::span<const DrawnStroke> drawn) {
  std::vector<PenPath> points_of(form.count());  // by stroke
  for (std::size_t path = 0; path < paths.size(); ++path) {
    const DrawnStroke& each = drawn[path];
    const bool is_continued = path + 1 < paths.size() && drawn[path + 1].continues;
    const bool wrote_one = each.stroke >= 0 && each.stroke_count == 1 && each.also < 0;
    if (!wrote_one || each.continues || is_continued || each.tap) continue;
    if (each.direction == WritingDirection::neither) continue;
    PenPath points = paths[path];
    if (each.direction == WritingDirection::backwards) std::reverse(points.begin(), points.end());
    points_of[static_cast<std::size_t>(each.stroke)] = std::move(points);
  }
  WrittenForm written;
  std::vector<FormLine> wanted, found;
  for (std::size_t stroke = 0; stroke < points_of.size(); ++stroke) {
    if (points_of[stroke].empty()) continue;
    written.strokes.push_back(stroke);
    wanted.push_back(form.strokes[stroke]);
    found.push_back(form_line(points_of[stroke]));
    written.paths.push_back(std::move(points_of[stroke]));
  }
  if (!wanted.empty()) written.laid = lay_on(wanted, found);
  return written;
}

}  // namespace calligraphy
