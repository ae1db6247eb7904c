// What the parts of guidance_judge share.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <calligraphy/render/renderer_options.hpp>

#include "arguments.hpp"

namespace calligraphy_test {

/// Shows progress on a terminal, nowhere else.
std::function<void(double)> progress();

std::string name_of(char32_t code);
/// @throws ValueError for an unknown name
calligraphy::RendererOptions renderer_of(const std::string& name, const calligraphy::Capabilities& device);
/// @throws ValueError for an unknown name
calligraphy::StrokeTolerances tolerances_of(const std::string& name);
/// One profile, or "all".
std::vector<calligraphy::Capabilities> devices_of(const std::string& name);

/// guidance_judge sequence: returns 2 if the arguments are not understood.
int sequence(Arguments& arguments);
/// guidance_judge people: likewise.
int people(Arguments& arguments);
/// guidance_judge wrong_end: likewise.
int wrong_end(Arguments& arguments);

}  // namespace calligraphy_test
