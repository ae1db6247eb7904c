// Which way the y axis of pen traces points, told from how people write.
#pragma once

#include <optional>
#include <span>

#include <calligraphy/judge/pen_trace.hpp>

namespace calligraphy {

/// Direction of the y axis in which places of a pen are given.
enum class YAxis {
  down,  ///< as on screens, and in the text format of pen traces
  up     ///< as in mathematics, and on many tablets
};

/// "down", "up".
const char* to_string(YAxis axis) noexcept;

/// The y axis of a file, from its traces as they are when it is read as one that points down. It needs no templates:
/// strokes and the moves between them go where people's go. A mirrored page must explain them better than one that is
/// turned by a quarter or upside down, or than strokes written backwards. Several traces of a character count as one: what
/// somebody does wrong in it is then done wrong again. Empty if there is too little evidence, as in 一 alone, or if
/// another explanation is the best.
std::optional<YAxis> recognise_y_axis(std::span<const PenTrace> traces);

/// Reads a trace again, with the y axis the other way round: y becomes 1 - y, in the air too. What the pen senses
/// remains.
void turn_over(PenTrace& trace) noexcept;

}  // namespace calligraphy
