// Whether the optional stages are worth having: vision, the default and everything() on each device.
#pragma once

#include "pairs.hpp"

namespace calligraphy_test {

/// A character by the same writer in three modes.
struct StagesRun {
  char32_t character = 0;
  std::uint64_t seed = 0;
  CharacterRun vision, standard, everything;
};

/// The novice writes each character so many times, alone on its page, with a seed of its own each time.
std::vector<StagesRun> write_with_stages(const std::vector<calligraphy::Character>& characters, int times,
                                         const calligraphy::Capabilities& device, double em, int threads,
                                         const std::function<void(double)>& progress = nullptr);

}  // namespace calligraphy_test
