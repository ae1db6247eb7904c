// The page that a recording was made on, as far as its samples tell.
#pragma once

#include <cstddef>

#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// A stroke of a page, by indices.
struct StrokeIndex {
  std::size_t character, stroke;
};

/// The stroke that was finished in this tick, which already names the next one. The recording must be of the page.
StrokeIndex finished_stroke(const PracticePage& page, const RecordedSample& sample);

/// @throws ValueError if the recording is known to be of another page, or was on characters or strokes that this one
/// lacks, or finished strokes that lie elsewhere on this one; and if its time runs backwards
void require_same_page(const PracticePage& page, const Recording& recording);

}  // namespace calligraphy
