// Guidance laws whose functions are the program's.
#pragma once

#include <calligraphy/c/calligraphy.h>
#include <calligraphy/render/guidance_law.hpp>

namespace calligraphy::c {

/// Makes laws of these functions, which are copied. @throws Refusal if they or their `force` are null, or their size is
/// wrong
GuidanceFactory guidance_of(const calligraphy_guidance_functions* functions);

}  // namespace calligraphy::c
