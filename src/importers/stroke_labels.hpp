// Which typical strokes the labels of others stand for.
#pragma once

#include <span>
#include <string_view>

namespace calligraphy {

/// Typical strokes that KanjiVG's kvg:type may mean, from data/kanjivg_labels.tsv; none for a label that is unknown.
std::span<const int> ids_of_kanjivg_label(std::string_view label);

/// Typical strokes that a stroke letter of cnchar-order may mean; none for what is no letter.
std::span<const int> ids_of_stroke_letter(char letter) noexcept;

}  // namespace calligraphy
