#include "simple_stroke.hpp"

#include <cstddef>

#include "direction_range.hpp"

namespace calligraphy::recognition {
namespace {

/// Direction from -220 to 140 degrees: no stroke runs to the upper left.
double unbroken(double degrees) {
  constexpr double gap = 140.0;
  const double turned = wrapped(degrees);
  return turned > gap ? turned - 360.0 : turned;
}

/// Turn of a stroke between its fifths, left positive [degree]. A dian, which is pressed at its end, turns right late;
/// a pie turns right early; a na turns left.
struct Turns {
  double early;   ///< first to third
  double middle;  ///< second to fifth
  double late;    ///< third to fifth
  double last;    ///< fourth to fifth
  double whole;   ///< first third to last third of the stroke
};

Turns turns_of(const SimpleShape& shape) {
  const auto& fifths = shape.fifths;
  return {wrapped(fifths[2] - fifths[0]), wrapped(fifths[4] - fifths[1]), wrapped(fifths[4] - fifths[2]),
          wrapped(fifths[4] - fifths[3]), wrapped(shape.arriving - shape.leaving)};
}

/// Pie, short pie or shu pie.
int kind_of_pie(const SimpleShape& shape) {
  constexpr double straight = 0.01;       // [em] from a line; a short pie is straight
  constexpr double upright = -113.0;      // [degree]; a shu pie is steeper than this
  constexpr double shu_pie_bulge = 0.02;  // [1]; and bends towards its end
  constexpr double flat = -148.0;         // [degree]; as on top of 千
  constexpr double short_length = 0.15;   // [em]
  constexpr double max_flat = 0.5;        // [em]
  if (shape.direction > upright && shape.bulge > shu_pie_bulge) return 3;
  const bool is_short = shape.length < short_length || (shape.direction < flat && shape.length < max_flat);
  return is_short && shape.line_error < straight ? 5 : 4;
}

/// Na or ping na.
int kind_of_na(const SimpleShape& shape) {
  constexpr double flattest_na = -24.0;  // [degree]
  return shape.direction > flattest_na ? 7 : 6;
}

/// Dian, chang dian or zuo dian.
int kind_of_dian(const SimpleShape& shape) {
  constexpr double steepest_dian = -80.0;  // [degree]; one that leans farther to the left is a zuo dian
  constexpr double straight = 0.012;       // [em] from a line
  constexpr double long_length = 0.24;     // [em]
  if (shape.direction < steepest_dian) return 9;
  return shape.line_error > straight || (shape.length > long_length && shape.bulge > 0.012) ? 38 : 8;
}

/// A wave that lies nearly flat is a ping na and not a heng.
bool is_flat_wave(const SimpleShape& shape) {
  return shape.length > 0.3 && shape.line_error > 0.02 && shape.direction < 5.0 && shape.direction > -11.0;
}

bool is_flat_line(const SimpleShape& shape) {
  return shape.direction > -11.0 && shape.length > 0.3 && shape.line_error < 0.02;
}

constexpr double level = -0.85;  // [degree]; hengs rise
constexpr int chang_dian = 38;

}  // namespace

SimpleShape simple_shape(const Path& path, const Piece& whole, const CleanPath& clean) {
  SimpleShape shape;
  shape.length = path_length(path);
  shape.direction = unbroken(whole.direction);
  shape.leaving = unbroken(whole.leaving);
  shape.arriving = unbroken(whole.arriving);
  // The path is simplified, which may remove the turns of a small stroke.
  const Path& whole_path = clean.points;
  const double length = path_length(whole_path);
  Point from = whole_path.front();
  for (std::size_t i = 0; i < shape.fifths.size(); ++i) {
    const Point to = point_after(whole_path, 0, 0.2 * static_cast<double>(i + 1) * length);
    shape.fifths[i] = unbroken(direction_of(to - from));
    from = to;
  }
  shape.bulge = whole.bulge;
  shape.line_error = whole.line_error;
  shape.first = unbroken(clean.first);
  shape.last = unbroken(clean.last);
  shape.entry = clean.had_entry;
  return shape;
}

int brush_stroke(const SimpleShape& shape) {
  const Turns turns = turns_of(shape);
  const double bend = shape.line_error / shape.length;
  if (is_flat_wave(shape)) return 7;
  if (shape.direction > level || is_flat_line(shape)) {
    // A ti rises to its end; a heng is less steep, or pressed at its end, which turns it upwards before.
    if (shape.fifths[3] > 22.0) return shape.last > 20.4 ? 10 : 1;
    return shape.last > 17.8 && turns.late < 7.2 ? 10 : 1;
  }
  constexpr Range leaning{-125.0, -97.0};
  const bool is_line = shape.line_error < 0.001;
  if (is_line && !shape.entry && contains(leaning, shape.direction) && shape.length < 0.3) return 9;
  if (shape.fifths[4] < -114.3) {
    // A pie tapers off to the lower left; a zuo dian is pressed, which turns its end down.
    if (shape.last > -111.0) return 9;
    const bool bent_shu = shape.last > -120.0 && turns.early > -2.7 && shape.direction > -114.0;
    return bent_shu ? 2 : kind_of_pie(shape);
  }
  if (!shape.entry) {
    // A stroke that starts thin is a na if its end is flat, a dian, or a shu without a visible entry.
    if (turns.late > 19.9 && bend > 0.04) return kind_of_na(shape);
    return shape.fifths[1] < -75.7 && turns.whole > -6.3 ? 2 : kind_of_dian(shape);
  }
  if (shape.fifths[1] < -108.2) {
    if (shape.last < -118.6) return kind_of_pie(shape);
    return shape.last < -106.0 ? 2 : 9;
  }
  if (bend > 0.028) return turns.middle > 24.5 ? kind_of_na(shape) : kind_of_pie(shape);
  if (turns.middle < -13.8) return 3;
  const bool dropped = shape.first < -88.0 || (shape.fifths[1] < -106.4 && shape.first < -68.0);
  return dropped ? kind_of_dian(shape) : 2;
}

int pen_stroke(const SimpleShape& shape) {
  constexpr int dian = 8;  // a left dian written with a pen is not distinguished from others
  constexpr int na = 6;
  const Turns turns = turns_of(shape);
  const double bend = shape.line_error / shape.length;
  const int dian_or_long = shape.line_error > 0.009 ? chang_dian : dian;
  if (is_flat_wave(shape)) return 7;
  const bool is_line = shape.direction > -11.0 && shape.line_error < 0.004;
  if (shape.direction > level || is_line) return shape.direction > 19.5 ? 10 : 1;
  if (shape.last < -114.9) {
    const bool dropped = shape.length < 0.174 && turns.early > -14.2 && shape.fifths[1] > -111.7;
    return dropped ? dian : kind_of_pie(shape);
  }
  if (turns.late < -4.4) {
    // A dian turns down at its end; so does a bent shu, a little, and a na that starts with a bow.
    if (bend < 0.0074) return turns.middle < -8.3 ? dian : 2;
    if (shape.bulge > 0.049) return turns.middle < -23.0 || shape.fifths[0] < -38.7 ? dian_or_long : na;
    if (shape.length > 0.307) return shape.last < -105.0 ? kind_of_pie(shape) : na;
    return turns.last > -2.5 && shape.fifths[0] > -46.8 ? na : dian_or_long;
  }
  if (shape.arriving < -69.7) {
    if (shape.fifths[4] < -110.4) return kind_of_pie(shape);
    if (shape.fifths[0] < -91.4) return turns.middle < -3.5 ? dian : 2;
    return turns.late < -3.9 && turns.middle < -5.6 && shape.bulge < 0.0164 ? dian : 2;
  }
  if (shape.bulge > 0.0036 && shape.length > 0.68) return 7;
  if (bend < 0.004 && shape.length < 0.3) return dian;
  return shape.bulge <= 0.0036 && shape.length < 0.15 ? dian : na;
}

}  // namespace calligraphy::recognition
