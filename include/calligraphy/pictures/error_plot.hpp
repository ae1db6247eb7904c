// Plot of what force changes: the errors of characters without and with it, drawn by gnuplot.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/practice/mean_interval.hpp>

namespace calligraphy {

/// RMS errors (CharacterScore::rms_error) of what was written in pairs, once without and once with force [m].
struct PairedErrors {
  char32_t character = 0;  ///< 0: all of them
  MeanInterval vision;     ///< without force
  MeanInterval force;      ///< with force
  MeanInterval reduction;  ///< how much less it is with force, in each pair
};

/// The same for each character, and for all together.
struct ErrorsByCharacter {
  std::vector<PairedErrors> characters;  ///< in the order of the text
  PairedErrors all;  ///< over all pairs, whose `character` is 0
};

/// SVG plot with a row per character and, of several, one for all: means with their 95 % intervals without force (open
/// circles), with force (filled) and of the difference, and the number of independent pairs, n. Means of fewer than two
/// stand without interval. The language is that of all words but the title.
/// @throws ValueError when there is no pair, FormatError when the title is not UTF-8, Error with gnuplot's message when
/// it cannot be started or fails
std::string error_plot(const ErrorsByCharacter& errors, const std::string& title, const Language& language = {});

}  // namespace calligraphy
