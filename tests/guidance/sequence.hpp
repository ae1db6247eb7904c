// What is taken for the stroke that is due: later strokes, parts of it, zigzags about it, and the stroke itself as
// people draw it.
#pragma once

#include <functional>
#include <string>
#include <vector>

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

/// One stroke that was taken although it must not be, or was not although it must.
struct Finding {
  char32_t character = 0;
  int stroke = 0;     ///< that was due, from 0
  int other = -1;     ///< what was drawn for it
  double figure = 0;  ///< how different it was, or how long the due stroke is [em]
};

struct SequenceResult {
  Share taken;                    ///< of the due strokes
  int not_finished_exactly = 0;   ///< due strokes that, drawn exactly, were not finished: the rest was not judged
  std::vector<Finding> findings;  ///< by character

  void add(const SequenceResult& other);
};

/// What is drawn for a due stroke before it is drawn exactly.
struct Attempt {
  StrokeLine line;
  Finding finding;
};
using Attempts = std::function<std::vector<Attempt>(const std::vector<StrokeLine>& lines, std::size_t due)>;

/// For each due stroke of each character, the strokes before it drawn exactly, draws the attempts until one of them is
/// taken for it (finishes it). Counts due strokes with at least one attempt.
SequenceResult judge_attempts(const std::vector<calligraphy::Character>& characters, const SequenceOptions& options,
                              const Attempts& attempts, const std::function<void(double)>& progress = nullptr);

/// Each later stroke that differs from the due one by more than `different` [em]: mean distance of the points that are
/// equally far along.
Attempts later_strokes(double em, double different = 0.05);

/// The part between two shares of the length.
Attempts part_of_stroke(double from, double to);

/// The stroke, displaced across the line from its start to its end; to the left if `distance` is above 0 [m].
Attempts displaced_sideways(double distance);

/// A wave of this amplitude about the stroke, on a wavelength, or the stroke's length if that is shorter: at least one
/// whole period. [em]
struct Zigzag {
  double amplitude = 0.1, wavelength = 0.2;
  bool sine = false;        ///< or else a triangle
  bool at_extreme = false;  ///< begins there, or else on the stroke
};
StrokeLine zigzag_about(const StrokeLine& line, const Zigzag& zigzag, double em);
Attempts zigzags(double em, const std::vector<Zigzag>& zigzags);

/// How people draw a character that they know.
enum class Noise {
  none,
  displacement,  ///< of each stroke, constant along it
  distortion     ///< smooth: constant, half and whole wave along the stroke, equally strong
};
struct PeopleDraw {
  double shift = 0.05;  ///< of the whole character, uniform in a disc of this radius [em]
  Noise noise = Noise::displacement;
  double noise_size = 0.02;  ///< RMS displacement of a point by noise [em]
  double scale = 0.0;        ///< each stroke about its start, uniform up to this share
};

/// Draws each character so, and counts the strokes that are finished at the first touch. One that is not is drawn
/// exactly, up to three times, to go on; if that fails, the rest of the character counts as not finished.
SequenceResult judge_people(const std::vector<calligraphy::Character>& characters, const SequenceOptions& options,
                            const PeopleDraw& people, const std::function<void(double)>& progress = nullptr);

}  // namespace calligraphy_test
