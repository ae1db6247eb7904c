// Compact sets of many thousands of characters, with lookup and decoding without allocation.
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

/// Encoding of control point coordinates.
struct CoordinateEncoding {
  std::uint32_t steps_per_em = 0;  ///< 0: unquantised doubles
  std::int32_t x_origin = 0;       ///< x coordinate that is stored as 0 [steps]
  std::int32_t y_origin = 0;       ///< y coordinate that is stored as 0 [steps]
  std::uint8_t x_bits = 64;        ///< width of a stored x coordinate
  std::uint8_t y_bits = 64;        ///< width of a stored y coordinate
};

/// One stroke of a set, decoded, without its ink.
struct StoredStroke {
  /// Leaves all members uninitialised.
  StoredStroke() noexcept {}  // not `= default`, which lets the decoder zero what it is about to write

  const TypicalStroke* type;  ///< its entry of the stroke library
  std::string_view elements;  ///< its composition, in static storage
  int curve_degree;           ///< of every CSE: 3, or 4 as printed in eq. (1)
  std::array<Point, max_control_points_per_stroke>
      points;  ///< control points, the first `point_count` of the array [em]
  std::array<double, max_elements_per_stroke + 1> factors;  ///< one per feature point [1]
  std::size_t point_count;                                  ///< number of control points

  /// A view, valid as long as this object.
  Stroke stroke() const noexcept {
    return {type, elements, curve_degree, std::span(points).first(point_count),
            std::span(factors).first(elements.size() + 1)};
  }
};

/// A character of a set: a view that keeps the bytes of the set alive and decodes on request. A default-constructed or
/// damaged one has no strokes.
class StoredCharacter {
 public:
  /// Unicode code point.
  char32_t code() const noexcept { return code_; }
  /// Name of an alternate stroke order; empty for the standard one.
  std::string_view order() const noexcept { return order_; }
  /// Degree of every CSE: 3, or 4 as printed in eq. (1).
  int curve_degree() const noexcept { return curve_degree_; }
  /// Number of strokes; 0 if the record is damaged.
  int stroke_count() const noexcept { return stroke_count_; }
  /// Typical stroke id of the stroke with this index; 0 if there is no such stroke or it is damaged. O(index).
  int stroke_id(int index) const noexcept;
  /// The stroke with this index, without its ink; empty if there is no such stroke or it is damaged. Safe in the servo
  /// loop: does not allocate, lock or throw; O(index). Counts, ids and coordinates (finite, within 16 em) are valid,
  /// but only character() checks for elements of zero length and for joints that are not smooth.
  std::optional<StoredStroke> stroke(int index) const noexcept;
  /// Whether the character has ink. False if the record is damaged.
  bool has_ink() const noexcept { return has_ink_; }
  /// The ink of the stroke with this index; empty if there is no such stroke, or its ink is missing or damaged. Safe in
  /// the servo loop, as stroke(); O(strokes).
  std::optional<StrokeInk> ink(int index) const noexcept;
  /// The whole character with its ink, validated.
  /// @throws FormatError naming the file and the character if it is damaged
  Character character() const;
  /// Its provenance; the reference is valid as long as this object.
  const Provenance& provenance() const noexcept;

 private:
  friend class SetFile;

  /// Returns false if there is no such stroke or it is damaged.
  bool decode(int index, StoredStroke& stroke) const noexcept;

  std::shared_ptr<const SetFile> file_;
  char32_t code_ = 0;
  std::string_view order_;
  int curve_degree_ = 3;
  int stroke_count_ = 0;
  bool has_factors_ = false;
  CoordinateEncoding coding_;
  bool has_ink_ = false;
  std::uint64_t first_bit_ = 0;  // in the file: kinds, points, factors, ink
  std::uint64_t end_bit_ = 0;
};

/// An immutable set of characters: a memory-mapped set file, characters in memory, or several layered sets. Cheap to
/// copy: copies share the bytes. Any number of threads may use a set.
class CharacterSet {
 public:
  /// An empty set.
  CharacterSet();
  /// Encodes the characters in memory, without loss. @throws ValueError as encode_character_set()
  explicit CharacterSet(const CharacterList& list);
  /// Opens a set file, reading only its index, or a file in the text format.
  /// @throws FileError if it cannot be opened, FormatError if it is malformed; each names the file
  static CharacterSet open(const std::string& path);
  /// A set from the bytes of a set file. `name` is used in messages. @throws FormatError
  static CharacterSet from_bytes(std::vector<std::byte> bytes, std::string name);
  /// Several sets as one. For a character that several contain, the first set wins.
  static CharacterSet layered(std::span<const CharacterSet> sets);

  /// The character in the stroke order of this name; if that is empty, in the standard order or else the first one
  /// available. Safe in the servo loop: does not allocate, lock or throw. The first use of each group of 64
  /// neighbouring code points verifies its checksum; a damaged character is found, but has no strokes.
  std::optional<StoredCharacter> find(char32_t code, std::string_view order = {}) const noexcept;
  /// Names of all stroke orders of a character; the standard one has an empty name.
  std::vector<std::string> orders(char32_t code) const;
  /// Every form of a character: in each layer, even if hidden by another, and in every stroke order.
  std::vector<StoredCharacter> forms(char32_t code) const;
  /// The first character at or after this code point, if any.
  std::optional<char32_t> next(char32_t from) const noexcept;

  class Iterator;
  /// Every character once, as returned by find(code), in ascending code point order.
  Iterator begin() const noexcept;
  /// Past the character with the highest code point.
  Iterator end() const noexcept;

  /// Number of characters. O(index) for one set, O(characters) for layered ones.
  std::size_t size() const noexcept;
  /// Total size of all layers [byte]; characters in memory or in the text format count as encoded.
  std::size_t bytes() const noexcept;
  /// Provenance of each layer.
  std::vector<Provenance> provenances() const;
  /// Maximum distance between a stored control point and the original one [em].
  double coordinate_error() const noexcept;
  /// Every character in every order, without those hidden by another layer; the provenance is that of the first layer.
  /// @throws FormatError naming the file and the damage
  CharacterList list() const;
  /// Verifies the set by decoding every character in every order. @throws FormatError naming the file and the damage
  void check() const;

 private:
  using SharedFile = std::shared_ptr<const SetFile>;
  using Layers = std::vector<SharedFile>;

  explicit CharacterSet(Layers layers);

  std::shared_ptr<const Layers> layers_;
};

/// Input iterator over a set; valid as long as the set.
class CharacterSet::Iterator {
 public:
  using iterator_category = std::input_iterator_tag;  ///< each character is decoded anew
  using value_type = StoredCharacter;                 ///< a view that outlives the iterator
  using difference_type = std::ptrdiff_t;             ///< required of an iterator; there is no subtraction
  using pointer = const StoredCharacter*;             ///< required of an iterator; there is no arrow
  using reference = StoredCharacter;                  ///< by value

  Iterator() = default;
  /// The character, as found by CharacterSet::find() in the standard order or else the first one. Not at the end.
  StoredCharacter operator*() const noexcept { return *set_->find(*code_); }
  /// Moves on to the next higher code point of the set. Not at the end.
  Iterator& operator++() noexcept {
    code_ = set_->next(*code_ + 1);
    return *this;
  }
  /// The same; returns nothing, as an input iterator may.
  void operator++(int) noexcept { ++*this; }
  /// Whether both are at the same code point, or both at the end; they must be of the same set.
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
