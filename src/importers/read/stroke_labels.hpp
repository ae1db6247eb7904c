// The typical strokes that labels of other collections stand for.
#pragma once

#include <span>
#include <string_view>

namespace calligraphy {

/// Typical strokes that KanjiVG's kvg:type may mean, from data/kanjivg_labels.tsv; empty for an unknown label.
std::span<const int> ids_of_kanjivg_label(std::string_view label);

/// Typical strokes that a stroke letter of cnchar-order may mean; empty for other characters.
std::span<const int> ids_of_stroke_letter(char letter) noexcept;

}  // namespace calligraphy
