// Characters by the thousand in a few bytes each, found and decoded without allocation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/provenance.hpp>

namespace calligraphy {

class SetFile;

/// How the coordinates of control points are kept.
struct CoordinateEncoding {
  std::uint32_t steps_per_em = 0;  ///< 0: doubles as they are
  std::int32_t x_origin = 0;       ///< what is kept as 0 [steps]
  std::int32_t y_origin = 0;
  std::uint8_t x_bits = 64;
  std::uint8_t y_bits = 64;
};

/// One stroke of a set, decoded.
struct StoredStroke {
  const TypicalStroke* type;
  int curve_degree;
  std::array<Point, max_control_points_per_stroke> points;  ///< [em]
  std::array<double, max_elements_per_stroke + 1> factors;  ///< one per feature point [1]
  std::size_t point_count;

  /// A view that lives as long as this.
  Stroke stroke() const noexcept {
    return {type, curve_degree, std::span(points).first(point_count),
            std::span(factors).first(type->elements.size() + 1)};
  }
};

/// A character of a set: a view that keeps the set's bytes alive. Nothing of it is decoded before it is asked for. One
/// that was made of nothing has no strokes, like a damaged one.
class StoredCharacter {
 public:
  char32_t code() const noexcept { return code_; }
  /// Name of an alternate stroke order; empty for the standard one.
  std::string_view order() const noexcept { return order_; }
  int curve_degree() const noexcept { return curve_degree_; }
  /// 0 when the place where it is kept is damaged.
  int stroke_count() const noexcept { return stroke_count_; }
  /// Typical stroke id of the stroke with this index; 0 when there is no such stroke or it is damaged. O(index).
  int stroke_id(int index) const noexcept;
  /// The stroke with this index; none when there is no such stroke or it is damaged. For the loop: no allocation, lock
  /// or throw; O(index). It is in its domain (count, ids, finite, within 16 em), but only character() tells whether
  /// its elements have lengths and its joints are smooth.
  std::optional<StoredStroke> stroke(int index) const noexcept;
  /// @throws FormatError naming the file and the character when it is damaged
  Character character() const;
  /// Where it comes from, for as long as this lives.
  const Provenance& provenance() const noexcept;

 private:
  friend class SetFile;

  std::shared_ptr<const SetFile> file_;
  char32_t code_ = 0;
  std::string_view order_;
  int curve_degree_ = 3;
  int stroke_count_ = 0;
  bool has_factors_ = false;
  CoordinateEncoding coding_;
  std::uint64_t first_bit_ = 0;  // in the file: ids, points, factors
  std::uint64_t end_bit_ = 0;
};

/// A set of characters: a set file, mapped, or characters in memory, or several sets one over the other. A cheap value,
/// that never changes: copies share the bytes, and any number of threads may use them.
class CharacterSet {
 public:
  /// No character.
  CharacterSet();
  /// The characters as they are, encoded in memory. @throws ValueError as encode_character_set
  explicit CharacterSet(const CharacterList& list);
  /// A set file, of which only the index is read now, or a file in the text format.
  /// @throws FileError when it cannot be opened, FormatError when it is not what it should be; each names the file
  static CharacterSet open(const std::string& path);
  /// The bytes of a set file. `name` is used in messages. @throws FormatError
  static CharacterSet from_bytes(std::vector<std::byte> bytes, std::string name);
  /// One set over the other: of what several have, the first one's is found.
  static CharacterSet layered(std::span<const CharacterSet> sets);

  /// The character in the order of this name; without a name in the standard order, or else the first that there is.
  /// For the loop: no allocation, lock or throw. The first use of 64 neighbouring code points checks their checksum; a
  /// character that is damaged is found, but has no strokes.
  std::optional<StoredCharacter> find(char32_t code, std::string_view order = {}) const noexcept;
  /// Names of all stroke orders of a character; the standard one's is empty.
  std::vector<std::string> orders(char32_t code) const;
  /// The first character from this code point on; none when there is no more.
  std::optional<char32_t> next(char32_t from) const noexcept;

  class Iterator;
  /// Every character once, as find(code) gives it, by rising code point.
  Iterator begin() const noexcept;
  Iterator end() const noexcept;

  /// Number of characters. O(index) for one set, O(characters) for layered ones.
  std::size_t size() const noexcept;
  /// Of all layers together.
  std::size_t bytes() const noexcept;
  /// Of each layer.
  std::vector<Provenance> provenances() const;
  /// Largest distance between a stored control point and the one that was encoded [em].
  double coordinate_error() const noexcept;
  /// Every character in every order, that of the first layer's provenance; what is hidden by another layer, too, does
  /// not count. @throws FormatError naming the file and what is damaged
  CharacterList list() const;
  /// Decodes everything in every order. @throws FormatError naming the file and what is damaged
  void check() const;

 private:
  using SharedFile = std::shared_ptr<const SetFile>;
  using Layers = std::vector<SharedFile>;

  explicit CharacterSet(Layers layers);

  std::shared_ptr<const Layers> layers_;
};

/// Goes through a set, for as long as the set lives.
class CharacterSet::Iterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = StoredCharacter;
  using difference_type = std::ptrdiff_t;
  using pointer = const StoredCharacter*;
  using reference = StoredCharacter;

  Iterator() = default;
  StoredCharacter operator*() const noexcept { return *set_->find(*code_); }
  Iterator& operator++() noexcept {
    code_ = set_->next(*code_ + 1);
    return *this;
  }
  void operator++(int) noexcept { ++*this; }
  bool operator==(const Iterator& other) const noexcept { return code_ == other.code_; }

 private:
  friend class CharacterSet;
  Iterator(const CharacterSet* set, std::optional<char32_t> code) : set_(set), code_(code) {}

  const CharacterSet* set_ = nullptr;
  std::optional<char32_t> code_;
};

inline CharacterSet::Iterator CharacterSet::begin() const noexcept { return {this, next(0)}; }
inline CharacterSet::Iterator CharacterSet::end() const noexcept { return {this, std::nullopt}; }

}  // namespace calligraphy
