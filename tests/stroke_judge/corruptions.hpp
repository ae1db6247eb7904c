// Faults and deviations put into pens that wrote a character right, with the truth about what came out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "right_pens.hpp"
#include "truth.hpp"

namespace calligraphy_test {

/// What may have been drawn: `truths` are the ones that may be told, in general one.
struct Corrupted {
  std::vector<calligraphy::PenPath> paths;
  std::vector<Truth> truths;
};

/// Classes of strokes that are easily confused.
enum class StrokeClass {
  any,
  dots,     ///< dian and zuodian
  hooks,    ///< whose names end in gou
  parallel  ///< hengs with another heng beside which they lie: their x ranges overlap, their centres are within 0.25 em
};

/// "any", "dots", "hooks", "parallel".
const char* to_string(StrokeClass stroke_class);
/// @throws ValueError for an unknown name
StrokeClass class_named(const std::string& name);

/// Whether each stroke of a character is of a class.
std::vector<bool> members(const calligraphy::Character& character, StrokeClass stroke_class);

/// What is done to one stroke or a few, or to none.
enum class Fault {
  none,
  swap,          ///< two strokes change their places in the order of writing
  adjacent,      ///< two neighbours do
  reverse,       ///< a pen-down whose chord is at least half of its length, and which is no tap, is drawn from its end
  drop,          ///< one is not written
  split,         ///< one of at least 0.2 em is lifted at 35 to 65 % of its length
  join,          ///< the pen is not lifted between two neighbours
  extra,         ///< a straight line of 0.2 to 0.5 em, anywhere in the square, in any direction, anywhere in the order
  twice,         ///< one is written again at once, displaced by 3 % of the em; either may be told as extra
  turned,        ///< one of at least 0.2 em is turned by a right angle about its centre
  block,         ///< 2 or 3 strokes in a row are written earlier or later
  turned_short,  ///< one of 0.1 to 0.2 em is turned so: people's own directions differ by as much
  join_apart,    ///< the pen is not lifted from one to another that is not the next, and begins within 0.1 em of its end
  split_three    ///< one of at least 0.3 em is lifted twice, at 28 to 38 and at 62 to 72 % of its length
};

/// What is then done to all pen-downs: about the centre of the square, or at random.
struct Deviation {
  double shift = 0.0;      ///< of everything, in a random direction [em]
  double scale = 1.0;      ///< [1]
  double rotation = 0.0;   ///< anticlockwise [degrees]
  double shear = 0.0;      ///< x by y [degrees]
  double jitter = 0.0;     ///< standard deviation of x and y of every point [em]
  double displaced = 0.0;  ///< standard deviation of x and y of every pen-down [em]

  bool operator==(const Deviation&) const = default;
  bool is_random() const { return shift > 0.0 || jitter > 0.0 || displaced > 0.0; }
};

/// One row of the table.
struct Corruption {
  std::string name;  ///< one word
  Fault fault = Fault::none;
  Deviation deviation = {};

  /// Nothing is wrong, so that no remark is due.
  bool is_clean() const { return fault == Fault::none; }
  bool is_random() const { return !is_clean() || deviation.is_random(); }
  /// The fault is one of strokes that can be of a class. Of two that are swapped it is one, and they are neighbours.
  bool has_classes() const {
    return !is_clean() && fault != Fault::swap && fault != Fault::extra && fault != Fault::block &&
           fault != Fault::join_apart;
  }
};

/// All rows, in the order of the table. A row keeps its index, of which its seeds are made.
const std::vector<Corruption>& corruptions();
/// @throws ValueError for an unknown name
const Corruption& corruption_named(const std::string& name);

/// The pen with this fault, of a stroke of this class, and deviation; std::nullopt if it has no such stroke.
/// Deterministic per seed.
std::optional<Corrupted> corrupt(const RightPen& pen, const Corruption& corruption, std::uint64_t seed,
                                 StrokeClass stroke_class = StrokeClass::any);

}  // namespace calligraphy_test
