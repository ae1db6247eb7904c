// Texts of data/profiles/, compiled in.
#pragma once

namespace calligraphy::built_in {

extern const char* const wire_profile_omni;
extern const char* const wire_profile_simulated;

}  // namespace calligraphy::built_in
