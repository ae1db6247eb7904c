// The field of the guidance force on a resting pen, over part of the page (Wang 2006, sec. 6, Figs. 25 to 28).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/model/placed_character.hpp>

namespace calligraphy {

/// What attracts the pen.
enum class Attractor {
  active_stroke,  ///< the active stroke alone, from its current progress on
  nearest_stroke  ///< the nearest stroke of the character: the ambiguity that active strokes are meant to remove
};

/// Rules and resolution of a force field.
struct ForceFieldOptions {
  Attractor attractor = Attractor::active_stroke;  ///< what attracts the pen
  StrokeOptions stroke;      ///< how the stroke is followed; with nearest_stroke, feature planes do not count
  double stiffness = 600.0;  ///< guidance stiffness where the attraction factor is 1 [N/m]
  int columns = 96;          ///< cells per edge of the square
  double min_jump = 0.1;     ///< smaller jumps of the force are omitted [N]
  /// Called from time to time with the share completed. An exception thrown by it ends the computation.
  std::function<void(double)> progress = nullptr;
};

/// A segment of a line across which the force jumps.
struct ForceJump {
  Point begin;          ///< one end [m, page]
  Point end;            ///< the other end [m, page]
  double size;          ///< magnitude of the change in force [N]
  double from_stroke;   ///< distance from the active stroke [m]
  bool passes_feature;  ///< a feature point is passed on one side of it, so it is crossed only once, in order
};

/// The force on a pen at rest in each cell of a square.
struct ForceField {
  Point corner = Point::Zero();  ///< lower left corner of the square [m, page]
  double edge = 0.0;             ///< edge length of the square [m]
  int columns = 0;               ///< number of columns, and of rows
  std::vector<Point> forces;     ///< row by row, bottom row first [N, page]
  std::vector<ForceJump> jumps;  ///< where the force jumps, as line segments

  /// Centre of a cell, where its force is evaluated [m, page].
  Point place(int column, int row) const noexcept;
  /// Force in a cell [N, page].
  const Point& force(int column, int row) const noexcept;
  double max_force() const noexcept;  ///< largest magnitude in a cell [N]
};

/// Computes, for each cell of the square, the attraction of eq. (8) on a pen there that has written `stroke` (index)
/// along its middle line up to `progress`, a share of its length: without fade-in and without limits on the force and
/// its rate. Jumps are located to a thousandth of a cell.
/// @throws ValueError when there is no such stroke, or the progress, the square or an option is out of its domain
ForceField guidance_field(const PlacedCharacter& placed, int stroke, double progress, const Point& corner, double edge,
                          const ForceFieldOptions& options = {});

/// One case of ambiguity on a real stroke: the same pen under different rules.
struct ForceFieldFigure {
  /// The force field under one set of rules.
  struct Panel {
    std::string name;  ///< name of the rules
    bool fades_in;     ///< the guidance fades in where a feature point is passed
    ForceField field;  ///< the field under these rules
  };
  std::string name;           ///< "bend", "corner", "parallel", "crossed"
  std::string title;          ///< for people
  PlacedCharacter placed;     ///< the character on which it occurs
  int stroke = 0;             ///< index of the active stroke
  double progress = 0.0;      ///< share of its length
  Point pen;                  ///< the stroke's point at `progress` [m, page]
  std::vector<Panel> panels;  ///< one for each set of rules
};

/// Figs. 25 to 28 with built-in characters, each with the nearest stroke, the rules as printed and the default.
/// @param columns cells per edge of each square
std::vector<ForceFieldFigure> ambiguity_figures(int columns = 96);

/// SVG picture of a figure: the magnitude of the force as colour, its direction as arrows, its jumps as lines.
std::string force_field_picture(const ForceFieldFigure& figure);

}  // namespace calligraphy
