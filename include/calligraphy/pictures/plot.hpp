// Plots of a recording (Wang 2006, Figs. 32 to 36), drawn by gnuplot.
#pragma once

#include <string>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// Whether gnuplot can be started.
bool gnuplot_available();

/// SVG plot of the in-plane force (components and magnitude) and the normal force over the time since the first sample,
/// for the samples in which `character` (index) is active; shaded bands mark the writing state of each stroke. The
/// language is that of all words but the title.
/// @throws ValueError when there is no such sample, FormatError when the title is not UTF-8, Error with gnuplot's
/// message when it cannot be started or fails
std::string force_plot(const Recording& recording, int character, const std::string& title,
                       const Language& language = {});

}  // namespace calligraphy
