// How typical strokes end; private to the model and the importers.
#pragma once

#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy {

inline bool ends_in_hook(const TypicalStroke& type) noexcept { return type.code.ends_with('G'); }

inline bool ends_in_na(const TypicalStroke& type) noexcept { return type.code.ends_with('N'); }

}  // namespace calligraphy
