// The strokes of a character as a source draws and labels them; private to the importers.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/point.hpp>

#include "stroke_letters.hpp"

namespace calligraphy {

/// The character that a file draws, according to its name or to itself.
struct CharacterFile {
  SourceKind kind;
  char32_t code;
  std::string order;  ///< empty for the standard one
};

enum class DrawingForm { hanzi_writer, kanjivg, anim_cjk };

/// One file of a source, or one line of a file that has a character a line.
struct DrawingFile {
  CharacterFile character;
  DrawingForm form;
  std::string path;   ///< within the source, with the line if there are several
  std::string place;  ///< for messages: source and path
  std::string text;
};

struct SourceStroke {
  std::vector<Point> path;                  ///< the median of a brush stroke or the line of a pen [em]
  std::vector<std::vector<Point>> outline;  ///< of a brush stroke: polygons that are filled together; otherwise empty
  std::string label;                        ///< empty if there is none
  std::span<const int> label_ids;           ///< typical strokes that the label allows

  std::size_t point_count() const {
    std::size_t count = path.size();
    for (const std::vector<Point>& polygon : outline) count += polygon.size();
    return count;
  }
  bool allows(int id) const { return std::find(label_ids.begin(), label_ids.end(), id) != label_ids.end(); }
};

/// Of all strokes of a drawing; those of fonts have some thousand.
inline constexpr std::size_t max_drawing_points = 100'000;

struct Drawing {
  std::vector<SourceStroke> strokes;  ///< in writing order
  std::string notice;                ///< the file's own copyright notice
  std::string correction;            ///< why the order of the strokes was changed; empty: it was not
  bool letters_unused = false;       ///< there are letters for the character, but not one per stroke
};

inline std::string too_many_points() { return "more than " + std::to_string(max_drawing_points) + " points so far"; }

/// `corrections`: correct_order(). `letters` label the strokes of hanzi-writer-data.
/// @throws FormatError naming the place
Drawing parse_drawing(const DrawingFile& file, const StrokeLetters& letters, bool corrections);

}  // namespace calligraphy
