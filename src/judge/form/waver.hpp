// How much a pen goes to and fro across its course, as in a zigzag or with a tremor.
#pragma once

#include <span>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Length from which a stroke can be seen to waver [em].
inline constexpr double least_wavering_length = 0.25;

/// The mean square by which a path lies aside of its course, on both sides alike: twice the lesser of those to its left
/// and to its right, in the median over its length [em^2]. The course is a line of a quarter of an em, fitted about
/// each point; what goes to one side alone, as at a corner or in a bend, hardly counts. The path covers a stroke of
/// this `length` [em], at least least_wavering_length, by which its course is measured: it is longer itself the more it
/// wavers.
double waver(std::span<const Point> path, double length);

}  // namespace calligraphy
