// The guidance force on a resting pen over a part of the page (Wang 2006, sec. 6, Figs. 25 to 28).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/collision/placed_character.hpp>

namespace calligraphy {

/// What attracts the pen.
enum class Attractor {
  active_stroke,  ///< the active stroke alone, from where it has been written to
  nearest_stroke  ///< whichever stroke of the character is nearest: the ambiguity that active strokes are to remove
};

struct ForceFieldOptions {
  Attractor attractor = Attractor::active_stroke;
  StrokeRules rules;  ///< with nearest_stroke, those for the nearest point, the constraint space and the attraction
  double stiffness = 600.0;  ///< guidance, where the attraction factor is 1 [N/m]
  int columns = 96;          ///< places per edge of the square
  double least_jump = 0.1;   ///< smaller jumps of the force are left out [N]
  /// Called now and then with the share that is done. What it throws ends the field.
  std::function<void(double)> progress = nullptr;
};

/// A piece of a line across which the force jumps.
struct ForceJump {
  Point begin, end;     ///< [m, page]
  double size;          ///< length of the change of the force [N]
  double from_stroke;   ///< distance from the active stroke [m]
  bool passes_feature;  ///< on one side of it a feature point is passed: it is crossed once, in order
};

struct ForceField {
  Point corner = Point::Zero();  ///< lower left, of the square [m, page]
  double edge = 0.0;             ///< [m]
  int columns = 0;               ///< and as many rows
  std::vector<Point> forces;     ///< row by row from below [N, page]
  std::vector<ForceJump> jumps;

  /// The middle of a cell, where its force was taken.
  Point place(int column, int row) const noexcept;
  const Point& force(int column, int row) const noexcept;
  double largest_force() const noexcept;  ///< [N]
};

/// The attraction of eq. (8) that a tick gives to a pen that has written `stroke` (by index) along its middle line up
/// to `progress`, a share of its length, and is now at each place of the square: no fade-in, no limit of the force or
/// of its rate. Jumps are located to a thousandth of a cell.
/// @throws ValueError when there is no such stroke, or progress, square or options are out of their domain
ForceField guidance_field(const PlacedCharacter& placed, int stroke, double progress, const Point& corner, double edge,
                          const ForceFieldOptions& options = {});

/// One case of ambiguity on a real stroke: the same pen under several rules.
struct ForceFieldFigure {
  struct Panel {
    std::string name;
    bool fades_in;  ///< guidance comes in gradually where a feature point is passed
    ForceField field;
  };
  std::string name;   ///< "bend", "corner", "parallel", "crossed"
  std::string title;  ///< for a person
  PlacedCharacter placed;
  int stroke = 0;         ///< the active one, by index
  double progress = 0.0;  ///< share of its length
  Point pen;              ///< the stroke's point at `progress` [m, page]
  std::vector<Panel> panels;
};

/// Figs. 25 to 28 on built-in characters: the nearest stroke, the rules as printed, the default.
/// @param columns places per edge of each square
std::vector<ForceFieldFigure> ambiguity_figures(int columns = 96);

/// SVG of a figure: the size of the force as colour, its direction as arrows, its jumps as lines.
std::string force_field_picture(const ForceFieldFigure& figure);

}  // namespace calligraphy
