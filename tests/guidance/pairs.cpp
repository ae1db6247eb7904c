#include "pairs.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "stroke_line.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

/// Judges a session of one character, tick by tick.
class Observer {
 public:
  explicit Observer(const PlacedCharacter& placed) : lines_(stroke_lines(placed)), runs_(lines_.size()) {}

  void see(const HapticTick& tick, int intended) {
    if (has_event(tick.events, TickEvent::contact) && due_ < static_cast<int>(lines_.size())) {
      touched_ = tick.time;
      intended_ = static_cast<std::size_t>(intended);
      run_ = &runs_[static_cast<std::size_t>(due_)];
      if (++run_->contacts == 1) run_->meant_at_first = intended == due_;
    }
    if (has_event(tick.events, TickEvent::stroke_finished)) finish(tick, intended);
    if (run_ != nullptr) judge(tick);
    due_ = tick.character == 0 ? tick.stroke : static_cast<int>(lines_.size());
  }

  std::vector<StrokeRun> runs() const { return runs_; }

 private:
  /// The due stroke: at its end, in the air, or because this contact has begun the next one.
  void finish(const HapticTick& tick, int intended) {
    StrokeRun& written = runs_[static_cast<std::size_t>(due_)];
    if (has_event(tick.events, TickEvent::stroke_started)) {
      --written.contacts;
      run_ = &runs_[static_cast<std::size_t>(due_) + 1];
      run_->contacts = 1;
      run_->meant_at_first = intended == due_ + 1;
    }
    written.finished = true;
    written.at_once = written.contacts == 1 && written.meant_at_first;
  }

  void judge(const HapticTick& tick) {
    if (tick.state == InteractionState::separation) {
      run_ = nullptr;
    } else if (tick.time - touched_ > settling) {
      const double error = lines_[intended_].distance(tick.pen_tip.head<2>());
      run_->largest_error = std::max(run_->largest_error, error);
    }
  }

  std::vector<StrokeLine> lines_;
  std::vector<StrokeRun> runs_;
  int due_ = 0;               ///< as of the tick before: a lift may finish a stroke
  StrokeRun* run_ = nullptr;  ///< of the contact
  std::size_t intended_ = 0;  ///< at that contact
  double touched_ = 0.0;      ///< [s]
};

}  // namespace

CharacterRun write_character(const PracticePage& page, const SessionOptions& options) {
  Observer observer(page.characters.front());
  SimulatedWriter writer(page, options.skill, options.seed);
  const auto motion = [&](const HapticTick& tick, double seconds) -> std::optional<Intention> {
    observer.see(tick, writer.intended_stroke());
    const Intention next = writer.update(calligraphy::visual_feedback(tick), seconds);
    if (writer.done()) return std::nullopt;
    return next;
  };
  const Recording recording = run_session(page, options, motion);
  return {observer.runs(), score_page(page, recording).front()};
}

std::vector<StrokePair> CharacterPair::strokes() const {
  std::vector<StrokePair> pairs;
  for (std::size_t i = 0; i < vision.strokes.size(); ++i) {
    if (vision.strokes[i].contacts == 0 || force.strokes[i].contacts == 0) continue;
    pairs.push_back({character, seed, static_cast<int>(i), vision.strokes[i], force.strokes[i]});
  }
  return pairs;
}

std::vector<CharacterPair> write_pairs(const std::vector<Character>& characters, std::uint64_t first_seed, int count,
                                       const PairOptions& options, const std::function<void(double)>& progress) {
  std::vector<CharacterPair> pairs(static_cast<std::size_t>(count));
  parallel_for(
      pairs.size(), options.threads, progress ? progress : [](double) {},
      [&](std::size_t i) {
        const Character& character = characters[i % characters.size()];
        CharacterPair& pair = pairs[i];
        pair.character = character.code;
        pair.seed = first_seed + i;
        SessionOptions session;
        session.device = options.device;
        session.renderer = options.renderer;
        session.skill = options.skill;
        session.seed = pair.seed;
        const PracticePage page = page_of(character, options.em);
        session.mode = FeedbackMode::vision;
        pair.vision = write_character(page, session);
        session.mode = FeedbackMode::force;
        pair.force = write_character(page, session);
      });
  return pairs;
}

}  // namespace calligraphy_test
