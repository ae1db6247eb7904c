#include "set_file.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "base/bit_cast.hpp"
#include "checksum.hpp"
#include "little_endian.hpp"
#include "order_name.hpp"

namespace calligraphy {
namespace {

using namespace set_format;

constexpr std::uint32_t first_surrogate_block = 0xD800 >> group_shift;
constexpr std::uint32_t last_surrogate_block = 0xDFFF >> group_shift;

std::uint64_t bit_of(std::uint32_t number) { return std::uint64_t{1} << (number & 63); }

CoordinateEncoding load_coding(const std::byte* at) noexcept {
  return {load<std::uint32_t>(at), static_cast<std::int32_t>(load<std::uint32_t>(at + 4)),
          static_cast<std::int32_t>(load<std::uint32_t>(at + 8)), load<std::uint8_t>(at + 12),
          load<std::uint8_t>(at + 13)};
}

bool is_sound(const CoordinateEncoding& coding) noexcept {
  if (coding.steps_per_em == 0) return coding.x_bits == 64 && coding.y_bits == 64;
  const auto is_width = [](std::uint8_t bits) { return bits >= 1 && bits <= max_coordinate_bits; };
  return coding.steps_per_em <= max_steps_per_em && is_width(coding.x_bits) && is_width(coding.y_bits);
}

/// Reads a number of up to 32 bits, seven per byte, lowest first. False if it ends beyond `end` or is too large.
bool read_number(std::span<const std::byte> bytes, std::size_t& at, std::size_t end, std::uint32_t& number) noexcept {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 35 && at < end; shift += 7) {
    const auto byte = std::to_integer<std::uint64_t>(bytes[at++]);
    value |= (byte & 0x7F) << shift;
    if (byte < 0x80) {
      number = static_cast<std::uint32_t>(value);
      return value <= std::numeric_limits<std::uint32_t>::max();
    }
  }
  return false;
}

}  // namespace

SetFile::SetFile(std::vector<std::byte> bytes, std::string name)
    : name_(std::move(name)), own_(std::move(bytes)), bytes_(own_) {
  read();
}

SetFile::SetFile(std::unique_ptr<const MappedFile> file, std::string name)
    : name_(std::move(name)), file_(std::move(file)), bytes_(file_->bytes()) {
  read();
}

void SetFile::fail(const std::string& what) const { throw FormatError(name_ + ": " + what); }

void SetFile::read() {
  read_header();
  read_provenance(read_ink_code(read_kinds()));
}

void SetFile::read_header() {
  const std::size_t size = bytes_.size();
  const std::string_view start(reinterpret_cast<const char*>(bytes_.data()), std::min(size, magic.size()));
  if (start != magic.substr(0, start.size())) fail("is not a set file: its first bytes differ");
  if (size < version_at + 4) fail("is truncated after " + std::to_string(size) + " bytes");
  const auto found = load<std::uint32_t>(bytes_.data() + version_at);
  if (found < oldest_version || found > version) {
    fail("was written by " + std::string(found > version ? "a newer version" : "another program") + ": its format is " +
         std::to_string(found) + ", but this program reads " + std::to_string(oldest_version) + " to " +
         std::to_string(version));
  }
  if (found == unreleased_version) {
    fail("is of format " + std::to_string(found) + ", which no release wrote: import its source again");
  }
  if (size < kinds_at) fail("is truncated after " + std::to_string(size) + " bytes");
  if (const auto whole = load<std::uint32_t>(bytes_.data() + size_at); whole != size) {
    fail(std::string(whole > size ? "is truncated" : "continues after its end") + ": " + std::to_string(size) +
         " bytes, but its header states " + std::to_string(whole));
  }
  first_group_ = load<std::uint32_t>(bytes_.data() + first_group_at);
  if (first_group_ < kinds_at || first_group_ > size) {
    fail("its groups begin at byte " + std::to_string(first_group_) + " of " + std::to_string(size));
  }
  const std::uint32_t checksum = crc32(bytes_.subspan(size_at, first_group_ - size_at));
  if (checksum != load<std::uint32_t>(bytes_.data() + checksum_at)) {
    fail("is damaged: the checksum of its index does not match");
  }
  group_count_ = load<std::uint32_t>(bytes_.data() + group_count_at);
  coordinate_error_ = bit_cast<double>(load<std::uint64_t>(bytes_.data() + error_at));
  if (!(coordinate_error_ >= 0.0) || std::isinf(coordinate_error_)) fail("its coordinate error is not a distance");
  coding_ = load_coding(bytes_.data() + coding_at);
  if (!is_sound(coding_)) fail("its coordinate encoding has invalid numbers");
}

std::size_t SetFile::read_kinds() {
  std::size_t at = kinds_at;
  const auto take = [&](std::size_t size) {
    if (first_group_ - at < size) fail("its index ends within its list of stroke kinds");
    const std::byte* const taken = bytes_.data() + at;
    at += size;
    return taken;
  };
  if (load<std::uint32_t>(bytes_.data() + version_at) == 1) {
    for (int i = 0; i < typical_stroke_count; ++i) add_kind(load<std::uint8_t>(take(1)), std::nullopt);
    return at;
  }
  const auto count = load<std::uint16_t>(take(2));
  if (count > max_kinds) fail("its list of stroke kinds has " + std::to_string(count) + " entries");
  for (int i = 0; i < count; ++i) {
    const std::byte* const kind = take(kind_size);
    add_kind(load<std::uint8_t>(kind), load<std::uint8_t>(kind + 1));
  }
  return at;
}

std::size_t SetFile::read_ink_code(std::size_t at) {
  if (load<std::uint32_t>(bytes_.data() + version_at) <= version_without_ink) return at;
  if (first_group_ - at < ink_head_size) fail("its index ends within its ink encoding");
  ink_code_.steps_per_em = load<std::uint32_t>(bytes_.data() + at);
  const auto values_per_knot = load<std::uint8_t>(bytes_.data() + at + 4);
  ink_code_.is_present = true;
  ink_code_.has_offsets = values_per_knot == 2;
  at += ink_head_size;
  const bool is_sound = ink_code_.steps_per_em <= max_ink_steps_per_em &&
                        (values_per_knot == 1 || values_per_knot == 2);
  if (!is_sound) fail("its ink encoding has invalid numbers");
  if (ink_code_.steps_per_em == 0) return at;
  if (first_group_ - at < 2) fail("its index ends within its ink encoding");
  const std::size_t rows = load<std::uint16_t>(bytes_.data() + at);
  at += 2;
  if (rows == 0 || rows > kinds_.size() + 1) fail("its ink encoding has " + std::to_string(rows) + " rows");
  for (std::size_t i = 0; i < rows; ++i) {
    const InkSize size = i + 1 < rows ? kinds_[i].ink : InkSize{max_ink_knots, max_ink_corners};
    InkRow& row = ink_code_.rows.emplace_back();
    for_ink_places(size, ink_code_.has_offsets, [&](std::size_t place) {
      if (first_group_ - at < 3) fail("its index ends within its ink encoding");
      row.parameters[place] = load<std::uint8_t>(bytes_.data() + at);
      row.usual[place] = static_cast<std::int16_t>(load<std::uint16_t>(bytes_.data() + at + 1));
      if (row.parameters[place] > max_ink_parameter) fail("its ink encoding has invalid numbers");
      at += 3;
    });
  }
  return at;
}

/// `curves` is empty for version 1, which does not store it.
void SetFile::add_kind(std::uint8_t id, std::optional<std::uint8_t> curves) {
  if (id < 1 || id > typical_stroke_count) {
    fail("its list of stroke kinds contains the invalid id " + std::to_string(id));
  }
  const TypicalStroke& type = typical_stroke(id);
  if (!curves) curves = static_cast<std::uint8_t>(ElementList(type.as_printed()).curves());
  if (*curves >> type.elements.size() != 0) {
    fail("its list of stroke kinds contains invalid elements of id " + std::to_string(id));
  }
  const ElementList elements = ElementList::of(type.elements.size(), *curves);
  const auto points = [&](int degree) { return static_cast<std::uint8_t>(control_point_count(elements, degree)); };
  kinds_.push_back({id, elements, {points(3), points(4)}, ink_size(type, elements.elements())});
}

void SetFile::read_provenance(std::size_t at) {
  for (std::string* const text :
       {&provenance_.source, &provenance_.licence, &provenance_.attribution, &provenance_.licence_text}) {
    if (first_group_ - at < 4) fail("its index ends within its provenance");
    const std::size_t length = load<std::uint32_t>(bytes_.data() + at);
    at += 4;
    if (first_group_ - at < length) fail("its index ends within its provenance");
    text->assign(reinterpret_cast<const char*>(bytes_.data() + at), length);
    at += length;
    check_text(*text);
  }
  read_directory(at);
}

void SetFile::check_text(const std::string& text) const {
  try {
    decode_utf8(text);
  } catch (const FormatError& error) {
    fail("its provenance: " + std::string(error.what()));
  }
}

void SetFile::read_directory(std::size_t at) {
  if (group_count_ > last_block + 1 || first_group_ - at != group_count_ * (block_size + entry_size)) {
    fail("its index has " + std::to_string(first_group_ - at) + " bytes for " + std::to_string(group_count_) +
         " groups");
  }
  blocks_ = bytes_.data() + at;
  entries_ = blocks_ + block_size * group_count_;
  for (std::size_t group = 0; group < group_count_; ++group) check_group(group);
  if (group_count_ > 0 ? group_begin(0) != first_group_ : bytes_.size() != first_group_) {
    fail("its groups do not begin where its index ends");
  }
  std::uint32_t before = 0;
  for (BlockCell& cell : cells_) {
    cell.before = before;
    before += static_cast<std::uint32_t>(std::popcount(cell.present));
  }
  states_ = std::make_unique<std::atomic<GroupState>[]>(group_count_);
}

void SetFile::check_group(std::size_t group) {
  const std::uint32_t own = block(group);
  const bool is_above = group == 0 || own > block(group - 1);
  const bool is_surrogate = own >= first_surrogate_block && own <= last_surrogate_block;
  const auto characters = static_cast<std::size_t>(std::popcount(present(group)));
  const std::size_t begin = group_begin(group), end = group_end(group);
  const bool has_room = begin >= first_group_ && begin <= end && end <= bytes_.size() &&
                        end - begin > characters * offset_size(end - begin);
  if (!is_above || own > last_block || is_surrogate || characters == 0 || !has_room) {
    fail("entry " + std::to_string(group + 1) + " of its index has invalid numbers");
  }
  size_ += characters;
  cells_[own >> 6].present |= bit_of(own);
}

std::uint32_t SetFile::block(std::size_t group) const noexcept {
  return load<std::uint16_t>(blocks_ + block_size * group);
}

std::uint64_t SetFile::present(std::size_t group) const noexcept {
  return load<std::uint64_t>(entries_ + entry_size * group);
}

std::size_t SetFile::group_begin(std::size_t group) const noexcept {
  return load<std::uint32_t>(entries_ + entry_size * group + 8);
}

std::size_t SetFile::group_end(std::size_t group) const noexcept {
  return group + 1 < group_count_ ? group_begin(group + 1) : bytes_.size();
}

std::size_t SetFile::groups_before(std::uint32_t wanted) const noexcept {
  const BlockCell& cell = cells_[wanted >> 6];
  return cell.before + static_cast<std::size_t>(std::popcount(cell.present & (bit_of(wanted) - 1)));
}

bool SetFile::has_group(std::uint32_t wanted) const noexcept {
  return (cells_[wanted >> 6].present & bit_of(wanted)) != 0;
}

bool SetFile::is_intact(std::size_t group) const noexcept {
  GroupState state = states_[group].load(std::memory_order_relaxed);
  if (state == GroupState::unknown) {
    const std::size_t begin = group_begin(group);
    const bool agrees = crc32(bytes_.subspan(begin, group_end(group) - begin)) ==
                        load<std::uint32_t>(entries_ + entry_size * group + 12);
    state = agrees ? GroupState::intact : GroupState::damaged;
    states_[group].store(state, std::memory_order_relaxed);
  }
  return state == GroupState::intact;
}

std::optional<SetFile::Record> SetFile::record(char32_t code) const noexcept {
  const std::uint32_t wanted = static_cast<std::uint32_t>(code) >> group_shift;
  if (code > 0x10FFFF || !has_group(wanted)) return std::nullopt;
  const std::size_t group = groups_before(wanted);
  const std::uint64_t characters = present(group);
  if ((characters & bit_of(code)) == 0) return std::nullopt;
  if (!is_intact(group)) return Record{};

  const auto count = static_cast<std::size_t>(std::popcount(characters));
  const auto index = static_cast<std::size_t>(std::popcount(characters & (bit_of(code) - 1)));
  const std::size_t begin = group_begin(group), size = group_end(group) - begin;
  const std::size_t width = offset_size(size);
  const auto offset = [&](std::size_t i) -> std::size_t {
    const std::byte* const at = bytes_.data() + begin + i * width;
    return width == 2 ? load<std::uint16_t>(at) : load<std::uint32_t>(at);
  };
  const std::size_t from = offset(index), to = index + 1 < count ? offset(index + 1) : size;
  if (from < count * width || from > to || to > size) return Record{};
  return Record{begin + from, begin + to};
}

bool SetFile::read_form(Record& rest, StoredCharacter& form) const noexcept {
  form.stroke_count_ = 0;
  form.order_ = {};
  form.has_ink_ = false;
  if (rest.begin >= rest.end) return false;
  const auto head = std::to_integer<std::uint8_t>(bytes_[rest.begin++]);
  std::uint32_t strokes = head;
  std::size_t end = rest.end;
  std::size_t at = rest.begin;
  form.coding_ = coding_;
  form.curve_degree_ = 3;
  form.has_factors_ = false;
  bool has_ink = ink_code_.is_present;
  if (head >= special) {
    std::uint32_t size = 0;
    const unsigned known = has_ink ? known_flags | no_ink : known_flags;
    if ((head & ~known) != 0 || !read_number(bytes_, at, end, strokes) || !read_number(bytes_, at, end, size)) {
      return false;
    }
    if (size > end - at || ((head & more_forms) == 0 && size != end - at)) return false;
    end = at + size;
    if ((head & named) != 0) {
      const std::size_t length = at < end ? std::to_integer<std::size_t>(bytes_[at++]) : 0;
      if (length == 0 || length > end - at) return false;
      const std::string_view name(reinterpret_cast<const char*>(bytes_.data() + at), length);
      if (!is_order_name(name)) return false;
      form.order_ = name;
      at += length;
    }
    if ((head & own_coding) != 0) {
      if (end - at < coding_size) return false;
      form.coding_ = load_coding(bytes_.data() + at);
      if (!is_sound(form.coding_)) return false;
      at += coding_size;
    }
    form.curve_degree_ = (head & quartic) != 0 ? 4 : 3;
    form.has_factors_ = (head & factors) != 0;
    has_ink = has_ink && (head & no_ink) == 0;
  }
  rest.begin = end;
  form.first_bit_ = 8 * std::uint64_t{at};
  form.end_bit_ = 8 * std::uint64_t{end};
  const std::uint64_t least_bits = min_rank_bits + (has_ink ? 2 + 8 : 0);  // of a stroke
  if (strokes == 0 || strokes > max_strokes || strokes * least_bits > form.end_bit_ - form.first_bit_) return false;
  form.has_ink_ = has_ink;
  form.stroke_count_ = static_cast<int>(strokes);
  return true;
}

SetFile::Found SetFile::find(const std::shared_ptr<const SetFile>& file, char32_t code, std::string_view order,
                             StoredCharacter& form) noexcept {
  std::optional<Record> record = file->record(code);
  if (!record) return Found::nothing;
  for (std::size_t i = 0; i < max_forms && (i == 0 || record->begin < record->end); ++i) {
    if (!file->read_form(*record, form) || form.order_ == order) {
      form.code_ = code;
      form.file_ = file;
      return Found::this_order;
    }
  }
  return Found::other_orders;
}

void SetFile::find_first(const std::shared_ptr<const SetFile>& file, char32_t code, StoredCharacter& form) noexcept {
  Record record = file->record(code).value_or(Record{});
  file->read_form(record, form);
  form.code_ = code;
  form.file_ = file;
}

std::vector<StoredCharacter> SetFile::find_all(const std::shared_ptr<const SetFile>& file, char32_t code) {
  std::vector<StoredCharacter> forms;
  std::optional<Record> record = file->record(code);
  if (!record) return forms;
  while (forms.size() < max_forms && (forms.empty() || record->begin < record->end)) {
    StoredCharacter form;
    form.code_ = code;
    form.file_ = file;
    const bool is_sound = file->read_form(*record, form);
    forms.push_back(std::move(form));
    if (!is_sound) break;
  }
  return forms;
}

std::optional<char32_t> SetFile::next(char32_t from) const noexcept {
  if (from > 0x10FFFF) return std::nullopt;
  const std::uint32_t wanted = static_cast<std::uint32_t>(from) >> group_shift;
  for (std::size_t group = groups_before(wanted); group < group_count_; ++group) {
    std::uint64_t characters = present(group);
    if (block(group) == wanted) characters &= ~(bit_of(from) - 1);
    if (characters != 0) {
      return static_cast<char32_t>((block(group) << group_shift) +
                                   static_cast<std::uint32_t>(std::countr_zero(characters)));
    }
  }
  return std::nullopt;
}

}  // namespace calligraphy
