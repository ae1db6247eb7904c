#include <calligraphy/model/set_encoding.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "base/bit_cast.hpp"
#include "checksum.hpp"
#include "code_point_name.hpp"
#include "ink_encoding.hpp"
#include "little_endian.hpp"
#include "order_name.hpp"
#include "set_format.hpp"

namespace calligraphy {
namespace {

using namespace set_format;

using Bytes = std::vector<std::byte>;

struct PrecisionSteps {
  CoordinateEncoding coordinates;  ///< cover -0.14 to 1.14 em
  std::uint32_t ink = 0;           ///< [1/em]; 0: exact
};

PrecisionSteps steps_in(CoordinatePrecision precision) {
  switch (precision) {
    case CoordinatePrecision::coarse:
      return {{200, -28, -28, 8, 8}, 400};
    case CoordinatePrecision::standard:
      return {{800, -112, -112, 10, 10}, 800};
    case CoordinatePrecision::fine:
      return {{12800, -1792, -1792, 14, 14}, 12800};
    case CoordinatePrecision::exact:
      break;
  }
  return {};
}

void append_bytes(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

void append_text(Bytes& bytes, std::string_view text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}

/// Seven bits per byte, lowest first.
void append_number(Bytes& bytes, std::size_t number) {
  for (; number >= 0x80; number >>= 7) bytes.push_back(static_cast<std::byte>((number & 0x7F) | 0x80));
  bytes.push_back(static_cast<std::byte>(number));
}

void append_coding(Bytes& bytes, const CoordinateEncoding& coding) {
  append(bytes, coding.steps_per_em);
  append(bytes, static_cast<std::uint32_t>(coding.x_origin));
  append(bytes, static_cast<std::uint32_t>(coding.y_origin));
  append(bytes, coding.x_bits);
  append(bytes, coding.y_bits);
}

std::int64_t steps(double coordinate, std::uint32_t steps_per_em) { return std::llround(coordinate * steps_per_em); }

bool is_covered(std::int64_t step, std::int64_t origin, int bits) {
  return step >= origin && step - origin < std::int64_t{1} << bits;
}

bool covers(const CoordinateEncoding& coding, const Character& character) {
  const auto& points = character.structure.control_points;
  return coding.steps_per_em == 0 || std::all_of(points.begin(), points.end(), [&](const Point& point) {
           return is_covered(steps(point.x(), coding.steps_per_em), coding.x_origin, coding.x_bits) &&
                  is_covered(steps(point.y(), coding.steps_per_em), coding.y_origin, coding.y_bits);
         });
}

/// The fewest bits that cover the character.
CoordinateEncoding fitted_coding(const Character& character, std::uint32_t steps_per_em) {
  CoordinateEncoding coding{steps_per_em, 0, 0, 0, 0};
  const auto fit = [&](int axis, std::int32_t& origin, std::uint8_t& bits) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max(), most = std::numeric_limits<std::int64_t>::min();
    for (const Point& point : character.structure.control_points) {
      const std::int64_t step = steps(point[axis], steps_per_em);
      least = std::min(least, step);
      most = std::max(most, step);
    }
    origin = static_cast<std::int32_t>(least);
    bits =
        static_cast<std::uint8_t>(std::bit_width(static_cast<std::uint64_t>(std::max<std::int64_t>(1, most - least))));
  };
  fit(0, coding.x_origin, coding.x_bits);
  fit(1, coding.y_origin, coding.y_bits);
  return coding;
}

/// The character as it will be decoded.
Character rounded(const Character& character, std::uint32_t steps_per_em) {
  Character result = character;
  if (steps_per_em == 0) return result;
  const auto round = [&](double coordinate) {
    return static_cast<double>(steps(coordinate, steps_per_em)) / steps_per_em;
  };
  for (Point& point : result.structure.control_points) point = {round(point.x()), round(point.y())};
  return result;
}

double max_distance(const Character& a, const Character& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.structure.control_points.size(); ++i) {
    largest = std::max(largest, (a.structure.control_points[i] - b.structure.control_points[i]).norm());
  }
  return largest;
}

/// A form and its encoding.
struct Form {
  const Character* character;
  CoordinateEncoding coding;
  bool has_own_coding;
};

/// The encoding of the set, or a finer one specific to the character.
Form choose_coding(const Character& character, const CoordinateEncoding& common, double& max_error) {
  constexpr std::uint32_t finer = 4;
  for (std::uint32_t steps_per_em = common.steps_per_em; steps_per_em != 0; steps_per_em *= finer) {
    if (steps_per_em > max_steps_per_em) break;
    const Character stored = rounded(character, steps_per_em);
    if (!validate(stored).empty()) continue;
    max_error = std::max(max_error, max_distance(stored, character));
    if (steps_per_em == common.steps_per_em && covers(common, character)) return {&character, common, false};
    return {&character, fitted_coding(character, steps_per_em), true};
  }
  return {&character, CoordinateEncoding(), common.steps_per_em != 0};
}

void write_coordinate(BitWriter& bits, double coordinate, std::uint32_t steps_per_em, std::int32_t origin, int width) {
  if (steps_per_em == 0) return bits.write_double(coordinate);
  bits.write(static_cast<std::uint64_t>(steps(coordinate, steps_per_em) - origin), width);
}

/// The kind of each stroke of a character: id, and which elements are curves.
using Kind = std::pair<int, unsigned>;

std::vector<Kind> kinds_of(const Character& character) {
  const SequenceData& sequence = character.sequence;
  std::vector<Kind> kinds;
  for (std::size_t i = 0; i < sequence.stroke_ids.size(); ++i) {
    kinds.emplace_back(sequence.stroke_ids[i], sequence.elements[i].curves());
  }
  return kinds;
}

/// Writes the bits of a form: kinds, points, factors, ink.
class FormEncoder {
 public:
  FormEncoder(const CharacterList& set, const std::vector<Kind>& kinds, CoordinatePrecision precision) {
    for (std::size_t i = 0; i < kinds.size(); ++i) ranks_[kinds[i]] = i;
    std::vector<RankedInk> inks;
    for (const Character& character : set.characters) {
      const std::vector<RankedInk> own = inks_of(character);
      inks.insert(inks.end(), own.begin(), own.end());
    }
    ink_code = ink_code_of(inks, kinds.size(), steps_in(precision).ink);
  }

  InkCode ink_code;

  Bytes encode(const Form& form, bool is_last) const {
    const Character& character = *form.character;
    const auto& all_factors = character.physics.attraction_factors;
    const bool has_factors = std::any_of(all_factors.begin(), all_factors.end(), [](double f) { return f != 1.0; });
    const Bytes content = encode_bits(form, has_factors);
    const bool lacks_ink = ink_code.is_present && character.physics.ink.empty();
    const std::size_t count = character.sequence.stroke_ids.size();
    const unsigned flags = (is_last ? 0U : more_forms) | (character.order.empty() ? 0U : named) |
                           (character.curve_degree == 4 ? quartic : 0U) | (has_factors ? factors : 0U) |
                           (form.has_own_coding ? own_coding : 0U) | (lacks_ink ? no_ink : 0U);
    Bytes bytes;
    if (flags == 0 && count <= max_plain_strokes) {
      bytes.push_back(static_cast<std::byte>(count));
      append_bytes(bytes, content);
      return bytes;
    }
    Bytes rest;
    if (!character.order.empty()) {
      rest.push_back(static_cast<std::byte>(character.order.size()));
      append_text(rest, character.order);
    }
    if (form.has_own_coding) append_coding(rest, form.coding);
    append_bytes(rest, content);
    bytes.push_back(static_cast<std::byte>(special | flags));
    append_number(bytes, count);
    append_number(bytes, rest.size());
    append_bytes(bytes, rest);
    return bytes;
  }

 private:
  std::vector<RankedInk> inks_of(const Character& character) const {
    const std::vector<Kind> kinds = kinds_of(character);
    std::vector<RankedInk> inks;
    for (std::size_t i = 0; i < character.physics.ink.size(); ++i) {
      const TypicalStroke& type = typical_stroke(character.sequence.stroke_ids[i]);
      inks.push_back({&character.physics.ink[i], ranks_.at(kinds[i]),
                      ink_size(type, character.sequence.elements[i].elements())});
    }
    return inks;
  }

  Bytes encode_bits(const Form& form, bool has_factors) const {
    const Character& character = *form.character;
    const CoordinateEncoding& coding = form.coding;
    BitWriter bits;
    for (const Kind& kind : kinds_of(character)) {
      const std::size_t rank = ranks_.at(kind);
      const int ones = rank < max_short_ranks ? static_cast<int>(rank / 2) : escape_ones;
      bits.write((std::uint64_t{1} << ones) - 1, ones);
      if (ones < escape_ones) {
        bits.write((rank % 2) << 1, 2);
      } else {
        bits.write(rank, escaped_rank_bits);
      }
    }
    for (const Point& point : character.structure.control_points) {
      write_coordinate(bits, point.x(), coding.steps_per_em, coding.x_origin, coding.x_bits);
      write_coordinate(bits, point.y(), coding.steps_per_em, coding.y_origin, coding.y_bits);
    }
    if (has_factors) {
      for (const double factor : character.physics.attraction_factors) bits.write_double(factor);
    }
    for (const RankedInk& ink : inks_of(character)) write_ink(bits, ink, ink_code);
    return bits.bytes();
  }

  std::map<Kind, std::size_t> ranks_;
};

std::string character_label(const Character& character) {
  const std::string name = "character " + code_point_name(character.code);
  return character.order.empty() ? name : name + " order " + character.order;
}

void check(const Character& character) {
  const auto fail = [&](const std::string& what) { throw ValueError(character_label(character) + ": " + what); };
  const auto code = static_cast<std::uint32_t>(character.code);
  if (code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) fail("is not a Unicode character");
  if (!character.order.empty()) check_order_name(character.order);
  if (const std::size_t count = character.sequence.stroke_ids.size(); count > max_strokes) {
    fail(std::to_string(count) + " strokes, more than " + std::to_string(max_strokes));
  }
  const std::vector<ValidationIssue> problems = validate(character);
  if (problems.empty()) return;
  fail((problems[0].stroke > 0 ? "stroke " + std::to_string(problems[0].stroke) + ": " : "") + problems[0].what);
}

void check(const Provenance& provenance) {
  for (const std::string& text :
       {provenance.source, provenance.licence, provenance.attribution, provenance.licence_text}) {
    try {
      decode_utf8(text);
    } catch (const FormatError& error) {
      throw ValueError("provenance: " + std::string(error.what()));
    }
  }
}

/// The forms of each character, the standard order first.
std::map<char32_t, std::vector<const Character*>> sorted(const CharacterList& set) {
  std::map<char32_t, std::vector<const Character*>> forms;
  for (const Character& character : set.characters) {
    check(character);
    auto& own = forms[character.code];
    const auto is_same = [&](const Character* other) { return other->order == character.order; };
    if (std::any_of(own.begin(), own.end(), is_same)) throw ValueError(character_label(character) + ": occurs twice");
    if (own.size() == max_forms) {
      throw ValueError(character_label(character) + ": more than " + std::to_string(max_forms) + " orders");
    }
    own.insert(character.order.empty() ? own.begin() : own.end(), &character);
  }
  return forms;
}

/// All kinds of strokes in the set, the most frequent first.
std::vector<Kind> ranked_kinds(const CharacterList& set) {
  std::map<Kind, std::size_t> strokes;
  for (const Character& character : set.characters) {
    for (const Kind& kind : kinds_of(character)) ++strokes[kind];
  }
  std::vector<Kind> kinds;
  for (const auto& [kind, count] : strokes) kinds.push_back(kind);
  std::stable_sort(kinds.begin(), kinds.end(),
                   [&](const Kind& a, const Kind& b) { return strokes[a] > strokes[b]; });
  return kinds;
}

/// Collects the records of 64 neighbouring code points, group by group.
class GroupWriter {
 public:
  void add(char32_t code, const Bytes& record) {
    const auto block = static_cast<std::uint16_t>(static_cast<std::uint32_t>(code) >> group_shift);
    if (records_.empty() || block != block_) finish_group();
    block_ = block;
    present_ |= std::uint64_t{1} << (code & 63);
    records_.push_back(record);
  }

  /// The directory: blocks, then entries. Offsets count from the first group.
  void finish_group() {
    if (records_.empty()) return;
    std::size_t size = 0;
    for (const Bytes& record : records_) size += record.size();
    const bool is_narrow = size + 2 * records_.size() <= 0xFFFF;
    const std::size_t width = is_narrow ? 2 : 4;
    Bytes group;
    std::size_t offset = width * records_.size();
    for (const Bytes& record : records_) {
      if (is_narrow) {
        append(group, static_cast<std::uint16_t>(offset));
      } else {
        append(group, static_cast<std::uint32_t>(offset));
      }
      offset += record.size();
    }
    for (const Bytes& record : records_) append_bytes(group, record);
    blocks.push_back(block_);
    entries.push_back({present_, groups.size(), crc32(group)});
    append_bytes(groups, group);
    records_.clear();
    present_ = 0;
  }

  struct Entry {
    std::uint64_t present;
    std::size_t begin;  ///< relative to the first group
    std::uint32_t checksum;
  };
  std::vector<std::uint16_t> blocks;
  std::vector<Entry> entries;
  Bytes groups;

 private:
  std::uint16_t block_ = 0;
  std::uint64_t present_ = 0;
  std::vector<Bytes> records_;
};

struct Header {
  CoordinateEncoding coding;
  std::vector<Kind> kinds;
  InkCode ink;
  double coordinate_error;
};

/// The complete file, including its checksum.
Bytes assemble(const Header& header, const Provenance& provenance, const GroupWriter& writer) {
  const bool has_ink = header.ink.is_present;
  const auto texts = {&provenance.source, &provenance.licence, &provenance.attribution, &provenance.licence_text};
  std::size_t first_group = kinds_at + sizeof(std::uint16_t) + kind_size * header.kinds.size() +
                            (block_size + entry_size) * writer.blocks.size();
  Bytes ink;
  if (has_ink) {
    std::vector<InkSize> sizes;
    for (const auto& [id, curves] : header.kinds) {
      const TypicalStroke& type = typical_stroke(id);
      const auto elements = ElementList::of(type.elements.size(), static_cast<std::uint8_t>(curves));
      sizes.push_back(ink_size(type, elements.elements()));
    }
    append_ink_code(ink, header.ink, sizes);
  }
  first_group += ink.size();
  for (const std::string* text : texts) first_group += 4 + text->size();
  const std::size_t size = first_group + writer.groups.size();
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw ValueError("set file: " + std::to_string(size) + " bytes, more than 4 GiB");
  }
  Bytes index;  // covered by the checksum
  append(index, static_cast<std::uint32_t>(size));
  append(index, static_cast<std::uint32_t>(first_group));
  append(index, static_cast<std::uint32_t>(writer.blocks.size()));
  append(index, bit_cast<std::uint64_t>(header.coordinate_error));
  append_coding(index, header.coding);
  append(index, static_cast<std::uint16_t>(header.kinds.size()));
  for (const auto& [id, curves] : header.kinds) {
    append(index, static_cast<std::uint8_t>(id));
    append(index, static_cast<std::uint8_t>(curves));
  }
  append_bytes(index, ink);
  for (const std::string* text : texts) {
    append(index, static_cast<std::uint32_t>(text->size()));
    append_text(index, *text);
  }
  for (const std::uint16_t block : writer.blocks) append(index, block);
  for (const GroupWriter::Entry& entry : writer.entries) {
    append(index, entry.present);
    append(index, static_cast<std::uint32_t>(first_group + entry.begin));
    append(index, entry.checksum);
  }
  Bytes file;
  file.reserve(size);
  append_text(file, magic);
  append(file, has_ink ? version : version_without_ink);
  append(file, crc32(index));
  append_bytes(file, index);
  append_bytes(file, writer.groups);
  return file;
}

}  // namespace

double coordinate_error_bound(CoordinatePrecision precision) noexcept {
  const std::uint32_t steps_per_em = steps_in(precision).coordinates.steps_per_em;
  if (steps_per_em == 0) return 0.0;
  constexpr double arithmetic = 1e-14;  // [em]; of a coordinate within 16 em
  return std::numbers::sqrt2 / 2.0 / steps_per_em + arithmetic;
}

double ink_error_bound(CoordinatePrecision precision) noexcept {
  const std::uint32_t steps_per_em = steps_in(precision).ink;
  if (steps_per_em == 0) return 0.0;
  constexpr double arithmetic = 1e-15;  // [em]; of a length within 1 em
  return 0.5 / steps_per_em + arithmetic;
}

std::vector<std::byte> encode_character_set(const CharacterList& set, CoordinatePrecision precision) {
  check(set.provenance);
  const auto characters = sorted(set);
  Header header{steps_in(precision).coordinates, ranked_kinds(set), {}, 0.0};
  const FormEncoder encoder(set, header.kinds, precision);
  header.ink = encoder.ink_code;
  GroupWriter writer;
  for (const auto& [code, forms] : characters) {
    Bytes record;
    for (const Character* character : forms) {
      const Form form = choose_coding(*character, header.coding, header.coordinate_error);
      append_bytes(record, encoder.encode(form, character == forms.back()));
    }
    writer.add(code, record);
  }
  writer.finish_group();
  return assemble(header, set.provenance, writer);
}

}  // namespace calligraphy
