// Stroke orders that are wrong at their source, from data/order_corrections.tsv.
#pragma once

#include <string>
#include <vector>

#include "drawing.hpp"

namespace calligraphy {

/// Puts the strokes of a character of Make Me a Hanzi into the right order if they are drawn in the one that is known to
/// be wrong. Returns why; empty if nothing was changed.
std::string correct_order(char32_t code, std::vector<SourceStroke>& strokes);

}  // namespace calligraphy
