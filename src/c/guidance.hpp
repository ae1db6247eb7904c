// Guidance laws whose functions the program provides.
#pragma once

#include <calligraphy/c/calligraphy.h>
#include <calligraphy/render/guidance_law.hpp>

namespace calligraphy::c {

/// Makes laws from copies of these functions. @throws Refusal if they or their `force` are null, or their size is wrong
GuidanceFactory guidance_of(const calligraphy_guidance_functions* functions);

}  // namespace calligraphy::c
