#include "writing_hand.hpp"

#include <stdexcept>
#include <vector>

#include <calligraphy/base/text.hpp>

namespace calligraphy_test {
namespace {

using namespace calligraphy;

/// Where a session of the library lets its pen wait [m].
constexpr double resting_height = 0.02;

}  // namespace

PracticePage page_to_write(const std::string& text, const CharacterSet& set, const Capabilities& capabilities) {
  std::vector<Character> characters;
  for (const char32_t code : decode_utf8(text)) {
    const auto found = set.find(code);
    if (!found) throw std::runtime_error("a character of \"" + text + "\" is in no set");
    characters.push_back(found->character());
  }
  PageLayout layout;
  layout.width = capabilities.workspace.x();
  layout.height = capabilities.workspace.y();
  const std::vector<PracticePage> pages = lay_out(characters, layout);
  if (pages.size() != 1) throw std::runtime_error("\"" + text + "\" is not one page");
  return pages.front();
}

WritingHand::WritingHand(const PracticePage& page, const Capabilities& capabilities, const WriterSkill& skill,
                         std::uint64_t seed)
    : page_(page),
      mapping_(upright_page(page.width, page.height)),
      eyes_(page.characters, mapping_, capabilities, RendererOptions::for_device(capabilities)),
      writer_(page, skill, seed) {
  last_.position = start();
}

Eigen::Vector3d WritingHand::start() const {
  return mapping_.to_device({0.5 * page_.width, 0.5 * page_.height, resting_height});
}

Intention WritingHand::next(const Eigen::Vector3d& tip, double seconds) {
  DeviceState seen;
  seen.time = time_;
  seen.position = tip;
  time_ += seconds;
  const HapticTick& tick = eyes_.update(seen);
  if (writer_.done()) return {last_.position, Eigen::Vector3d::Zero()};
  const Intention page = writer_.update(visual_feedback(tick), seconds);
  last_ = {mapping_.to_device(page.position), mapping_.rotation.transpose() * page.velocity / mapping_.scale};
  return last_;
}

}  // namespace calligraphy_test
