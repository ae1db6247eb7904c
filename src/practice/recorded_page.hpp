// Which page a recording was made on, as far as its samples show.
#pragma once

#include <cstddef>

#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// A stroke of a page, by indices.
struct StrokeIndex {
  std::size_t character, stroke;
};

/// The stroke finished in this tick, whose sample already names the next one. The recording must be of the page.
StrokeIndex finished_stroke(const PracticePage& page, const RecordedSample& sample);

/// @throws ValueError if the recording names another page, contains characters or strokes that this one lacks, or
/// finished strokes that lie elsewhere on this one; also if its time runs backwards
void require_same_page(const PracticePage& page, const Recording& recording);

}  // namespace calligraphy
