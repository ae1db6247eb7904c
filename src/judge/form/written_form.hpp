// The strokes of a character that were read, ready to be judged by their form.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <calligraphy/judge/drawn_stroke.hpp>
#include <calligraphy/judge/pen_path.hpp>

#include "character_form.hpp"
#include "laid_writing.hpp"

namespace calligraphy {

/// The strokes of a character that were written, each by a pen-down of its own and in its direction, laid on it.
struct WrittenForm {
  std::vector<std::size_t> strokes;  ///< in ascending order
  std::vector<PenPath> paths;        ///< as they were written, each in the direction of its stroke
  LaidWriting laid;                  ///< by index in `strokes`, as `paths`
};

/// `drawn` says what each of the paths wrote. Joined and broken strokes are left out, and those of another shape.
WrittenForm written_form(const CharacterForm& form, std::span<const PenPath> paths,
                         std::span<const DrawnStroke> drawn);

}  // namespace calligraphy
