#include "stroke_outlines.hpp"

#include <calligraphy/judge/pen_path.hpp>

namespace calligraphy {

StrokeOutlines::StrokeOutlines(const Character& character) {
  std::vector<std::vector<Point>> lines;
  for (const Stroke& stroke : strokes(character)) lines.push_back(middle_line(stroke, {Point::Zero(), 1.0}));
  for (std::size_t first = 0; first < lines.size(); ++first) {
    std::vector<Point> line;
    double length = 0.0;
    for (std::size_t count = 1; count <= max_joined && first + count <= lines.size(); ++count) {
      const std::vector<Point>& last = lines[first + count - 1];
      line.insert(line.end(), last.begin(), last.end());
      length += path_length(last);
      const Outline whole = outline(line);
      runs_[count - 1].push_back({whole, centred(whole), length, length_of(whole)});
    }
  }
}

}  // namespace calligraphy
