// Real characters from hanzi-writer-data (Make Me a Hanzi): medians to typical strokes.
#pragma once

#include <span>
#include <string>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/character_set.hpp>

namespace calligraphy {

/// A stroke recognised and fitted by geometry alone.
struct FittedStroke {
  StrokeInput stroke;
  double error;  ///< largest distance between polyline and model, both ways [em]
};

/// Finds the typical stroke and its control points for a pen path, a polyline in em, y up.
/// Brush entry and end droop of medians are removed first.
/// @throws ValueError when there is no point or a point is not finite
FittedStroke fit_stroke(std::span<const Point> median);

/// Reads one character from the unpacked npm package hanzi-writer-data: `directory`/北.json.
/// 1024 units to the em, baseline at -124: mapped to the unit square, y up.
/// @throws FileError when there is no such file, FormatError naming the file and the place
Character read_hanzi_writer(const std::string& directory, char32_t code);

}  // namespace calligraphy
