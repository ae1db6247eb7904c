// Fits the strokes of a drawing, where a label and the shape may disagree on the kind; private to the importers.
#pragma once

#include <vector>

#include <calligraphy/model/character.hpp>

#include "importers/check/imported_character.hpp"
#include "importers/read/drawing.hpp"

namespace calligraphy {

/// The fitted strokes, and what the report says about them.
struct LabelledFit {
  std::vector<StrokeInput> inputs;
  std::vector<ImportedStroke> strokes;
};

/// @throws FormatError naming the place and the stroke that cannot be fitted
LabelledFit fit_labelled(const std::vector<DrawnStroke>& drawn, const DrawingFile& file);

}  // namespace calligraphy
