// What a hint to a pen on the paper says to people.
#pragma once

#include <string>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/render/haptic_tick.hpp>

namespace calligraphy {

/// The hint in words, with the distance and direction to the start [m, page; y up] if the pen should go there: "too far
/// from the start: 12 mm to the upper left", "at the stroke's end: the start is 30 mm to the left". Empty for `none`.
std::string hint_text(WritingHint hint, const Point& to_start, const Language& language = {});

/// A way on the page in words, by the nearest of eight directions [m; y up]: "12 mm to the upper left".
std::string way_text(const Point& way, const Language& language = {});

}  // namespace calligraphy
