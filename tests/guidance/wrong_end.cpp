#include "wrong_end.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "pens.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

/// Sees a stroke being drawn backwards, tick by tick.
class Resistance {
 public:
  explicit Resistance(WrongEnd& stroke) : stroke_(stroke) {}

  void see(const HapticTick& tick) {
    const Point tip = tick.pen_tip.head<2>(), moved = tip - last_;
    last_ = tip;
    if (tick.state == InteractionState::separation || !(moved.norm() > 0.0)) return;
    const Point springs = tick.page_force.head<2>() - tick.viscous.head<2>() - tick.friction;
    const double work = -springs.dot(moved);
    stroke_.work += work;
    if (tick.wrong_way.norm() > 0.0) stroke_.most = std::max(stroke_.most, work / moved.norm());
  }

 private:
  WrongEnd& stroke_;
  Point last_ = Point::Zero();
};

}  // namespace

std::vector<WrongEnd> draw_from_wrong_end(const std::vector<Character>& characters, const SequenceOptions& options,
                                          const std::function<void(double)>& progress) {
  std::vector<std::vector<WrongEnd>> drawn(characters.size());
  parallel_for(
      characters.size(), options.threads, progress ? progress : [](double) {},
      [&](std::size_t i) {
        const PracticePage page = page_of(characters[i], options.em);
        const std::vector<StrokeLine> lines = stroke_lines(page.characters.front());
        for (std::size_t due = 0; due < lines.size(); ++due) {
          KinematicPen pen(page, options.device, options.renderer);
          for (std::size_t before = 0; before < due; ++before) pen.draw(lines[before], options.em);
          WrongEnd& stroke = drawn[i].emplace_back();
          stroke.character = characters[i].code;
          stroke.stroke = static_cast<int>(due);
          stroke.length = lines[due].length() / options.em;
          Resistance resistance(stroke);
          pen.on_tick = [&](const HapticTick& tick) { resistance.see(tick); };
          stroke.taken = pen.draw(lines[due].reversed(), options.em).finished;
        }
      });
  std::vector<WrongEnd> all;
  for (const auto& of_character : drawn) all.insert(all.end(), of_character.begin(), of_character.end());
  return all;
}

std::vector<Character> with_strokes(const std::vector<Character>& characters, int strokes) {
  std::vector<Character> first;
  for (const Character& character : characters) {
    if (strokes <= 0) break;
    first.push_back(character);
    strokes -= character.stroke_count();
  }
  return first;
}

}  // namespace calligraphy_test
