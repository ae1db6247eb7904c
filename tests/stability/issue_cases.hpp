// Named cases in which the guidance once drove the pen, or refused to work at all.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/render/haptic_renderer.hpp>

#include "independent_hand.hpp"
#include "scene.hpp"

namespace calligraphy_test {

/// A hand on an upright page with one character; page axes.
struct HandRun {
  calligraphy::Capabilities device;
  calligraphy::RendererOptions options;
  char32_t character = U'一';
  double attraction = 1.0;  ///< multiplies the attraction factors
  GripImpedance grip;       ///< mass 0: nobody holds the pen
  Vector3d start = Vector3d::Zero();
  std::function<Vector3d(double time)> intention;  ///< empty: `start`; its velocity is its slope over 0.1 ms
  std::function<Vector3d(double time, const Vector3d& position)> force;  ///< beside the grip's; may be empty [N]
  double window = 0.0, end = 0.0;                                        ///< where motion and force are measured [s]
};

struct HandFigures {
  double motion = 0.0;     ///< peak to peak in the window, largest of the axes [m]
  double force = 0.0;      ///< the same of the force written [N]
  double peak = 0.0;       ///< largest force in the window [N]
  double frequency = 0.0;  ///< of the axis that moves most [Hz]
  int strokes = 0;         ///< finished
  int abandoned = 0;

  bool at_rest() const { return motion <= 0.5e-3 && force <= 0.2; }
};

/// Stiffnesses are clipped to what the library accepts. @throws calligraphy::Error
HandFigures run_hand(const HandRun& run);

/// The path of the first stroke of a character in the middle of the page.
StrokePath first_stroke(char32_t character);

/// The pen on 一, 40 % along it; from 1 s on the arm is elsewhere for `duration`. Motion is measured 1.5 to 2.5 s
/// later.
HandRun jogged(const std::string& profile, const GripImpedance& grip, double distance = 0.01, double duration = 0.04);

/// The pen touches down beside 一 and, half a second later, comes to the stroke in 50 ms.
HandRun returning(const GripImpedance& grip, double beside = 0.0057);

/// Nobody holds the pen, which falls on the paper from 0.1 mm under a constant force; it rests 15 mm below if the paper
/// gives way.
HandRun pressed(const std::string& profile, double force);

/// A light grip, (0.02, 0.3, 30), with the linear law, that presses with 1 N and is pulled aside for 40 ms.
HandRun pulled_aside(double force);

/// All strokes of a character at 0.8 em/s, 2.5 mm into the paper.
HandRun writing(const std::string& profile, char32_t character, const GripImpedance& grip);

/// Random grips between soft and firm after a jog of 10 mm for 20 to 60 ms: how many still swing.
int count_swinging(const std::string& profile, const std::function<void(calligraphy::RendererOptions&)>& change,
                   int count, int threads, bool everything = false, std::uint64_t seed = 1);

/// A line of the table.
struct IssueFigure {
  std::string name;
  std::string reported;  ///< by the issue, of the library before it was mended
  std::string measured;
  bool right;  ///< as it shall be
};

std::vector<IssueFigure> issue_figures(int threads, int grips = 150);

/// Prints the table; whether all are right.
bool print_issue_cases(int threads);

}  // namespace calligraphy_test
