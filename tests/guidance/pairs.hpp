// Pairs of strokes, with vision alone and with force, by a writer who does not know the mode: how far the pen was from
// the stroke that the writer intended.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

namespace calligraphy_test {

inline constexpr double settling = 0.1;            ///< of each contact, not judged [s]
inline constexpr double tolerated_excess = 0.002;  ///< of the largest error with force beyond that with vision [m]

/// A due stroke, from the first contact made for it until the first one made for the next.
struct StrokeRun {
  int contacts = 0;
  /// Largest distance of the tip from the stroke that the writer intended in that attempt, over all contact [m].
  double largest_error = 0.0;
  bool meant_at_first = false;  ///< the first contact was intended for this stroke, not for a later one
  bool at_once = false;         ///< and finished it
  bool finished = false;
};

struct CharacterRun {
  std::vector<StrokeRun> strokes;
  calligraphy::CharacterScore score;
  bool finished() const { return score.strokes_completed == score.stroke_count; }
};

/// Writes a page of one character as write_page() does.
CharacterRun write_character(const calligraphy::PracticePage& page, const calligraphy::SessionOptions& options);

/// One due stroke in both modes.
///
/// What is compared is the largest error over everything that the writer did for the stroke, in however many attempts:
/// a pen that is thrown makes further attempts necessary, and a mode that needs fewer must not look worse for it. More
/// attempts do not raise the largest error much by themselves, since the misbelief halves with each and the first is
/// drawn alike in both modes. A stroke that was never begun in one of the modes, because an earlier one was given up,
/// has no pair.
struct StrokePair {
  char32_t character = 0;
  std::uint64_t seed = 0;
  int stroke = 0;  ///< from 0
  StrokeRun vision, force;

  double excess() const { return force.largest_error - vision.largest_error; }
  bool fails() const { return excess() > tolerated_excess; }
};

/// A character in both modes.
struct CharacterPair {
  char32_t character = 0;
  std::uint64_t seed = 0;
  CharacterRun vision, force;

  std::vector<StrokePair> strokes() const;
};

struct PairOptions {
  calligraphy::Capabilities device;
  calligraphy::RendererOptions renderer;
  calligraphy::WriterSkill skill = calligraphy::WriterSkill::novice();
  double em = 0.04;  ///< [m]
  int threads = 0;
};

/// `count` characters in turn, each alone on its page and with a seed of its own, the first one with `first_seed`:
/// characters of one seed would share the writer's beliefs.
std::vector<CharacterPair> write_pairs(const std::vector<calligraphy::Character>& characters, std::uint64_t first_seed,
                                       int count, const PairOptions& options,
                                       const std::function<void(double)>& progress = nullptr);

}  // namespace calligraphy_test
