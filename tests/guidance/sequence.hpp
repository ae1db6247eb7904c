// What is taken for the stroke that is due: the stroke itself as people draw it, and lines that are not it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "drawings.hpp"
#include "pens.hpp"
#include "statistics.hpp"

namespace calligraphy_test {

struct SequenceOptions {
  calligraphy::Capabilities device;
  calligraphy::RendererOptions renderer;
  double em = 0.04;        ///< [m]
  bool held = false;       ///< by a normal grip under force; or else the pen is where it is meant to be
  Arm arm = Arm::skilled;  ///< of a held pen
  bool feels = true;       ///< likewise
  std::uint64_t seed = 1;  ///< of what is drawn at random
  int threads = 0;
};

std::unique_ptr<Pen> pen_for(const calligraphy::PracticePage& page, const SequenceOptions& options);

/// How long a pen stays in the air after the last stroke of a page, which no other follows [s].
inline constexpr double final_rest = 1.2;

/// One stroke that was taken although it must not be, or was not although it must.
struct Finding {
  char32_t character = 0;
  int stroke = 0;     ///< that was due, from 0
  int attempt = -1;   ///< which one, from 0
  double figure = 0;  ///< how different it was, or how long the due stroke is [em]
};

struct SequenceResult {
  Share taken;                      ///< of the due strokes: by at least one attempt
  Share tries;                      ///< of the attempts
  std::vector<Share> by_character;  ///< `taken` of each character
  int not_finished_exactly = 0;     ///< due strokes that, drawn exactly, were not finished: the rest was not judged
  int taken_for_next = 0;           ///< due strokes that, drawn exactly after the attempts, were taken for the next one
  std::vector<Finding> findings;    ///< by character

  void add(const SequenceResult& other);
};

/// For each due stroke of each character, the strokes before it drawn exactly, draws each attempt. Counts due strokes
/// with at least one attempt. One that goes on is taken also if the due stroke is finished by the start of the exact
/// next one, or, if it is the last, while the pen rests in the air.
SequenceResult judge_attempts(const std::vector<calligraphy::Character>& characters, const SequenceOptions& options,
                              const Attempts& attempts, const std::function<void(double)>& progress = nullptr);

/// Draws each character as people do, and counts the strokes that are finished at the first touch. One that is not is
/// drawn exactly, up to three times, to go on; if that fails, the rest of the character counts as not finished.
SequenceResult judge_people(const std::vector<calligraphy::Character>& characters, const SequenceOptions& options,
                            const PeopleDraw& people, const std::function<void(double)>& progress = nullptr);

}  // namespace calligraphy_test
