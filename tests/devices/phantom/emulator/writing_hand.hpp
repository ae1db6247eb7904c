// A hand that writes a page, as the library's simulated writer does.
#pragma once

#include <calligraphy/model/character_set.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/writer.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "hand_motion.hpp"

namespace calligraphy_test {

/// The page that `calligraphy write` lays out for a device.
/// @throws std::runtime_error when a character is not in the set, or the text is more than one page
calligraphy::PracticePage page_to_write(const std::string& text, const calligraphy::CharacterSet& set,
                                        const calligraphy::Capabilities& capabilities);

/// It sees its own renderer at the true position of the tip, since the display of the program under test is not visible
/// here; both use the same strokes.
class WritingHand final : public HandMotion {
 public:
  WritingHand(const calligraphy::PracticePage& page, const calligraphy::Capabilities& capabilities,
              const calligraphy::WriterSkill& skill, std::uint64_t seed);

  Eigen::Vector3d start() const override;
  calligraphy::Intention next(const Eigen::Vector3d& tip, double seconds) override;

 private:
  calligraphy::PracticePage page_;
  calligraphy::MotionMapping mapping_;
  calligraphy::HapticRenderer eyes_;
  calligraphy::SimulatedWriter writer_;
  calligraphy::Intention last_;
  double time_ = 0.0;
};

}  // namespace calligraphy_test
