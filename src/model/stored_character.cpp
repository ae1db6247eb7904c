// Decodes the strokes of a character (docs/set-file.md).
#include <bit>
#include <cmath>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_set.hpp>

#include "base/bit_cast.hpp"
#include "code_point_name.hpp"
#include "little_endian.hpp"
#include "set_file.hpp"
#include "set_format.hpp"

namespace calligraphy {
namespace {

using namespace set_format;

double load_double(std::span<const std::byte> bytes, std::uint64_t at) noexcept {
  const std::uint64_t low = load_bits(bytes, at, 32);
  return bit_cast<double>(low | std::uint64_t{load_bits(bytes, at + 32, 32)} << 32);
}

/// Reads a sequence of coordinates.
class PointReader {
 public:
  PointReader(std::span<const std::byte> bytes, const CoordinateEncoding& coding, std::uint64_t at) noexcept
      : bytes_(bytes), coding_(coding), at_(at) {}

  Point next() noexcept {
    const double x = coordinate(coding_.x_bits, coding_.x_origin);
    return {x, coordinate(coding_.y_bits, coding_.y_origin)};
  }

 private:
  double coordinate(int bits, std::int32_t origin) noexcept {
    const std::uint64_t at = at_;
    at_ += static_cast<std::uint64_t>(bits);
    if (coding_.steps_per_em == 0) return load_double(bytes_, at);
    return (static_cast<double>(origin) + load_bits(bytes_, at, bits)) / coding_.steps_per_em;
  }

  std::span<const std::byte> bytes_;
  CoordinateEncoding coding_;
  std::uint64_t at_;
};

/// Reads the kinds of a sequence of strokes.
class KindReader {
 public:
  KindReader(const SetFile& file, std::uint64_t at) noexcept
      : bytes_(file.bytes()), kinds_(file.kinds()), first_(at), at_(at) {}

  void restart() noexcept { at_ = first_; }

  /// Null if the rank is invalid.
  const StrokeKind* next() noexcept {
    const std::uint32_t bits = load_bits(bytes_, at_, max_rank_bits);
    const int ones = std::countr_one(bits);
    std::size_t rank;
    if (ones < escape_ones) {
      rank = 2 * static_cast<std::size_t>(ones) + ((bits >> (ones + 1)) & 1);
      at_ += static_cast<std::uint64_t>(ones + 2);
    } else {
      rank = bits >> escape_ones;
      at_ += max_rank_bits;
    }
    return rank < kinds_.size() ? &kinds_[rank] : nullptr;
  }
  std::uint64_t at() const noexcept { return at_; }

 private:
  std::span<const std::byte> bytes_;
  std::span<const StrokeKind> kinds_;
  std::uint64_t first_;
  std::uint64_t at_;
};

bool in_domain(const Point& point) noexcept {
  return std::abs(point.x()) <= max_coordinate && std::abs(point.y()) <= max_coordinate;  // false for NaN
}

/// Reads a sequence of inks.
class InkReader {
 public:
  InkReader(const SetFile& file, std::uint64_t at) noexcept
      : bytes_(file.bytes()), kinds_(file.kinds()), code_(file.ink_code()), at_(at) {}

  /// Reads the ink of a stroke of this kind. Returns false if a value is outside its domain.
  bool next(const StrokeKind& kind, StrokeInk& ink) noexcept {
    const InkRow* const row =
        code_.steps_per_em == 0 ? nullptr : &code_.row_of(static_cast<std::size_t>(&kind - kinds_.data()));
    bool is_sound = true;
    off_ = 0;
    ink = {};
    for_ink_places(kind.ink, code_.has_offsets, [&](std::size_t place) {
      const double length = row == nullptr ? exact() : coded(*row, place);
      is_sound = is_sound && length >= (may_be_negative(place) ? -max_ink_length : 0.0) && length <= max_ink_length;
      value_at(ink, place) = length;
    });
    return is_sound;
  }
  std::uint64_t at() const noexcept { return at_; }

 private:
  static bool may_be_negative(std::size_t place) noexcept {
    return place >= first_offset || (place >= first_shift && place < first_half_width);
  }

  static double& value_at(StrokeInk& ink, std::size_t place) noexcept {
    if (place < first_shift) return place == 0 ? ink.start : ink.end;
    if (place < first_half_width) return ink.shifts[place - first_shift];
    return place < first_offset ? ink.half_widths[place - first_half_width] : ink.offsets[place - first_offset];
  }

  double exact() noexcept {
    const std::uint64_t at = at_;
    at_ += 64;
    return load_double(bytes_, at);
  }

  double coded(const InkRow& row, std::size_t place) noexcept {
    const std::uint32_t number = rice_number(row.parameters[place]);
    const auto half = static_cast<std::int32_t>(number >> 1);
    const std::int32_t step = expected_ink(row.usual, place, off_) + ((number & 1) != 0 ? -half - 1 : half);
    off_ = step - row.usual[place];
    return static_cast<double>(step) / code_.steps_per_em;
  }

  std::uint32_t rice_number(int parameter) noexcept {
    const int ones = std::min(std::countr_one(load_bits(bytes_, at_, ink_escape_ones)), ink_escape_ones);
    const bool is_escaped = ones == ink_escape_ones;
    at_ += static_cast<std::uint64_t>(is_escaped ? ones : ones + 1);
    const int width = is_escaped ? ink_escaped_bits : parameter;
    const std::uint32_t low = load_bits(bytes_, at_, width);
    at_ += static_cast<std::uint64_t>(width);
    return is_escaped ? low : (static_cast<std::uint32_t>(ones) << parameter) | low;
  }

  std::span<const std::byte> bytes_;
  std::span<const StrokeKind> kinds_;
  const InkCode& code_;
  std::uint64_t at_;
  std::int32_t off_ = 0;  ///< difference of the last value from the usual one [step]
};

}  // namespace

const Provenance& StoredCharacter::provenance() const noexcept {
  static const Provenance none;
  return file_ ? file_->provenance() : none;
}

int StoredCharacter::stroke_id(int index) const noexcept {
  if (index < 0 || index >= stroke_count_) return 0;
  KindReader kinds(*file_, first_bit_);
  for (int i = 0; i < index; ++i) kinds.next();
  const StrokeKind* const kind = kinds.next();
  return kind != nullptr && kinds.at() <= end_bit_ ? kind->id : 0;
}

std::optional<StoredStroke> StoredCharacter::stroke(int index) const noexcept {
  std::optional<StoredStroke> result(std::in_place);  // decoded in place, as it takes hundreds of bytes
  if (!decode(index, *result)) result.reset();
  return result;
}

bool StoredCharacter::decode(int index, StoredStroke& stroke) const noexcept {
  if (index < 0 || index >= stroke_count_) return false;
  const auto degree = static_cast<std::size_t>(curve_degree_ - 3);
  KindReader kinds(*file_, first_bit_);
  const StrokeKind* own = nullptr;
  std::uint64_t points_before = 0, points = 0, features_before = 0;
  for (int i = 0; i < stroke_count_; ++i) {
    const StrokeKind* const kind = kinds.next();
    if (kind == nullptr) return false;
    if (i == index) {
      own = kind;
      points_before = points;
    }
    if (i < index) features_before += kind->elements.size() + 1;
    points += kind->points[degree];
  }
  const std::uint64_t point_bits = coding_.x_bits + std::uint64_t{coding_.y_bits};
  const std::uint64_t first_factor = kinds.at() + points * point_bits;

  stroke.type = &typical_strokes()[static_cast<std::size_t>(own->id - 1)];
  stroke.elements = own->elements.elements();
  stroke.curve_degree = curve_degree_;
  stroke.point_count = own->points[degree];
  if (first_factor > end_bit_) return false;
  PointReader reader(file_->bytes(), coding_, kinds.at() + points_before * point_bits);
  for (std::size_t i = 0; i < stroke.point_count; ++i) {
    stroke.points[i] = reader.next();
    if (!in_domain(stroke.points[i])) return false;
  }
  stroke.factors.fill(1.0);
  if (has_factors_) {
    const std::uint64_t first = first_factor + 64 * features_before;
    const std::size_t features = own->elements.size() + 1;
    if (first + 64 * features > end_bit_) return false;
    for (std::size_t i = 0; i < features; ++i) {
      stroke.factors[i] = load_double(file_->bytes(), first + 64 * i);
      if (!(stroke.factors[i] >= 0.0) || std::isinf(stroke.factors[i])) return false;
    }
  }
  return true;
}

std::optional<StrokeInk> StoredCharacter::ink(int index) const noexcept {
  if (!has_ink_ || index < 0 || index >= stroke_count_) return std::nullopt;
  const auto degree = static_cast<std::size_t>(curve_degree_ - 3);
  KindReader kinds(*file_, first_bit_);
  std::uint64_t points = 0, features = 0;
  for (int i = 0; i < stroke_count_; ++i) {
    const StrokeKind* const kind = kinds.next();
    if (kind == nullptr) return std::nullopt;
    points += kind->points[degree];
    features += kind->elements.size() + 1;
  }
  const std::uint64_t point_bits = coding_.x_bits + std::uint64_t{coding_.y_bits};
  InkReader inks(*file_, kinds.at() + points * point_bits + (has_factors_ ? 64 * features : 0));
  StrokeInk ink;
  bool is_sound = true;
  kinds.restart();
  for (int i = 0; i <= index && is_sound; ++i) is_sound = inks.next(*kinds.next(), ink);
  return is_sound && inks.at() <= end_bit_ ? std::optional(ink) : std::nullopt;
}

Character StoredCharacter::character() const {
  const auto fail = [&](const std::string& what) {
    throw FormatError((file_ ? file_->name() : "no set") + ": character " + code_point_name(code_) +
                      " is damaged: " + what);
  };
  if (stroke_count_ == 0) fail("the checksum or the numbers of its record are wrong");
  const auto degree = static_cast<std::size_t>(curve_degree_ - 3);
  std::vector<StrokeInput> strokes(static_cast<std::size_t>(stroke_count_));
  KindReader kinds(*file_, first_bit_);
  std::uint64_t points = 0, features = 0;
  for (StrokeInput& stroke : strokes) {
    const StrokeKind* const kind = kinds.next();
    if (kind == nullptr) fail("it has a stroke of an invalid kind");
    stroke.id = kind->id;
    stroke.elements = kind->elements;
    points += kind->points[degree];
    features += kind->elements.size() + 1;
  }
  const std::uint64_t factors_at = kinds.at() + points * (coding_.x_bits + std::uint64_t{coding_.y_bits});
  const std::uint64_t ink_at = factors_at + (has_factors_ ? 64 * features : 0);
  if (ink_at > end_bit_) fail("its strokes take " + std::to_string(ink_at) + " bits");

  PointReader reader(file_->bytes(), coding_, kinds.at());
  std::uint64_t factor_at = factors_at;
  for (StrokeInput& stroke : strokes) {
    const int count = control_point_count(stroke.elements, curve_degree_);
    for (int i = 0; i < count; ++i) stroke.control_points.push_back(reader.next());
    for (int i = 0; has_factors_ && i < feature_point_count(stroke.elements); ++i, factor_at += 64) {
      stroke.attraction_factors.push_back(load_double(file_->bytes(), factor_at));
    }
  }
  InkReader inks(*file_, ink_at);
  kinds.restart();
  for (std::size_t i = 0; has_ink_ && i < strokes.size(); ++i) {
    if (!inks.next(*kinds.next(), strokes[i].ink.emplace())) {
      fail("stroke " + std::to_string(i + 1) + " has ink of an invalid width");
    }
  }
  if ((inks.at() + 7) / 8 * 8 != end_bit_) fail("its strokes take " + std::to_string(inks.at()) + " bits");
  try {
    Character character = make_character(code_, strokes, curve_degree_);
    character.order = order_;
    return character;
  } catch (const ValueError& error) {
    fail(error.what());
    throw;
  }
}

}  // namespace calligraphy
