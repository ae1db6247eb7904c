// The files of data/profiles/, compiled into the library.
#pragma once

namespace calligraphy::built_in {

extern const char* const wire_profile_omni;
extern const char* const wire_profile_simulated;

}  // namespace calligraphy::built_in
