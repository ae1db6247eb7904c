// Pages of built-in characters for tests.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/session.hpp>

#include "../characters.hpp"

namespace calligraphy_test {

inline calligraphy::PracticePage page_of(std::string_view text) {
  return calligraphy::lay_out(characters(text)).front();
}

inline calligraphy::SessionOptions session(const calligraphy::WriterSkill& skill, calligraphy::FeedbackMode mode,
                                           std::uint64_t seed = 1) {
  calligraphy::SessionOptions options;
  options.device = calligraphy::device_profile("desktop");
  options.renderer = calligraphy::RendererOptions::for_device(options.device);
  options.skill = skill;
  options.mode = mode;
  options.seed = seed;
  return options;
}

/// Identical to the last digit, except for measured times.
inline bool same(const calligraphy::Recording& a, const calligraphy::Recording& b) {
  return std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(),
                    [](const calligraphy::RecordedSample& x, const calligraphy::RecordedSample& y) {
                      return x.time == y.time && x.device_point == y.device_point && x.pen_tip == y.pen_tip &&
                             x.force == y.force && x.state == y.state && x.events == y.events && x.status == y.status &&
                             x.character == y.character && x.stroke == y.stroke;
                    });
}

}  // namespace calligraphy_test
