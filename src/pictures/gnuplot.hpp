// Plots drawn by the program gnuplot.
#pragma once

#include <string>
#include <string_view>

#include <pugixml.hpp>

namespace calligraphy::gnuplot {

/// The beginning of a script: SVG of this size [px], on white.
std::string svg_terminal(int width, int height);

/// The text between quotes, of which gnuplot expands nothing; control characters become blanks.
std::string quoted(std::string_view text);

/// Runs a script and reads the picture that it draws. A script may contain only numbers and the program's own words, no
/// text from a caller.
/// @throws Error with gnuplot's message when it cannot be started or fails
void draw(const std::string& script, pugi::xml_document& picture);

}  // namespace calligraphy::gnuplot
