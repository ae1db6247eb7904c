// Set files: intact, damaged, truncated, forged, and files of other formats.
#include "../catch.hpp"
#include "../sanitized.hpp"

#include <sys/stat.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/set_encoding.hpp>
#include <base/bit_cast.hpp>
#include <model/checksum.hpp>
#include <model/little_endian.hpp>
#include <model/order_name.hpp>
#include <model/set_format.hpp>

#include "character_lists.hpp"

namespace set_file_tests {

using namespace calligraphy;
using calligraphy_test::one_stroke;
using calligraphy_test::rich_list;
using calligraphy_test::same;

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

/// A few characters in several groups, including an alternate order, factors, quartics, a character-specific encoding,
/// and ink, common and exact.
CharacterList small_list() {
  const CharacterList rich = rich_list();
  CharacterList list{{"s", "l", "a", "t\n"}, {one_stroke(U'一')}};
  for (const Character& character : rich.characters) {
    if (character.code == U'北' || character.code == U'\U00020000') list.characters.push_back(character);
  }
  list.characters.push_back(with_quartic_curves(one_stroke(U'\U00020001')));  // short, and its form not plain
  list.characters.push_back(one_stroke(U'丁'));
  calligraphy_test::Sequence random(19);
  calligraphy_test::add_ink(list.characters[0], 0.06, random);
  calligraphy_test::add_ink(list.characters.back(), max_ink_length, random);
  return list;
}

/// The error of opening and decoding everything; "" if there is none.
std::string complaint(const Bytes& bytes) {
  try {
    CharacterSet::from_bytes(bytes, "test.set").check();
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

/// As complaint(), for a file.
std::string complaint_of_file(const std::string& path) {
  try {
    CharacterSet::open(path).check();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

template <class Unsigned>
void store(Bytes& bytes, std::size_t at, Unsigned value) {
  Bytes number;
  append(number, value);
  std::copy(number.begin(), number.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

std::size_t load_u32(const Bytes& bytes, std::size_t at) { return load<std::uint32_t>(bytes.data() + at); }

/// Recomputes all checksums from the numbers in the file, as far as those point into it.
void forge_checksums(Bytes& bytes) {
  using namespace set_format;
  const std::size_t first = std::min(load_u32(bytes, first_group_at), bytes.size());
  const std::size_t groups = load_u32(bytes, group_count_at);
  if (groups <= first / entry_size) {
    const std::size_t entries = first - groups * entry_size;
    for (std::size_t group = 0; group < groups; ++group) {
      const std::size_t entry = entries + group * entry_size;
      const std::size_t begin = load_u32(bytes, entry + 8);
      const std::size_t end = group + 1 < groups ? load_u32(bytes, entry + entry_size + 8) : bytes.size();
      if (begin <= end && end <= bytes.size()) {
        store(bytes, entry + 12, crc32(std::span(bytes).subspan(begin, end - begin)));
      }
    }
  }
  if (first > size_at) store(bytes, checksum_at, crc32(std::span(bytes).subspan(size_at, first - size_at)));
}

/// Calls everything that a set offers; all results must be within their domains.
void use(const CharacterSet& set) {
  std::size_t count = 0;
  for (const StoredCharacter& character : set) {
    ++count;
    for (int i = 0; i < character.stroke_count(); ++i) {
      REQUIRE(character.stroke_id(i) >= 0);
      REQUIRE(character.stroke_id(i) <= typical_stroke_count);
      if (const auto ink = character.ink(i)) {
        for (const double length : {ink->start, ink->end}) REQUIRE((length >= 0.0 && length <= max_ink_length));
        for (const double half : ink->half_widths) REQUIRE((half >= 0.0 && half <= max_ink_length));
        for (const double offset : ink->offsets) REQUIRE(std::abs(offset) <= max_ink_length);
      }
      const auto stroke = character.stroke(i);
      if (!stroke) continue;
      for (const Point& point : stroke->stroke().control_points) REQUIRE(point.cwiseAbs().maxCoeff() <= 16.0);
      for (const double factor : stroke->stroke().attraction_factors) REQUIRE(factor >= 0.0);
    }
    for (const std::string& order : set.orders(character.code())) {
      if (!order.empty()) REQUIRE(is_order_name(order));
      try {
        const Character whole = set.find(character.code(), order)->character();
        REQUIRE(validate(whole).empty());
      } catch (const FormatError& error) {
        REQUIRE(std::string(error.what()).starts_with("test.set: "));
      }
    }
  }
  REQUIRE(count == set.size());
}

/// Recomputes the checksums and uses everything in the bytes; true if they can be opened.
bool use_forged(Bytes bytes) {
  forge_checksums(bytes);
  try {
    use(CharacterSet::from_bytes(std::move(bytes), "test.set"));
    return true;
  } catch (const FormatError& error) {
    REQUIRE(std::string(error.what()).starts_with("test.set: "));
    return false;
  }
}

/// A temporary file, removed at the end.
class TestFile {
 public:
  explicit TestFile(const std::string& name) : path_((fs::temp_directory_path() / ("calligraphy_" + name)).string()) {
    fs::remove_all(path_);
  }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;
  ~TestFile() { fs::remove_all(path_); }

  void write(std::string_view content) const { std::ofstream(path_, std::ios::binary) << content; }
  void write(const Bytes& bytes) const { write({reinterpret_cast<const char*>(bytes.data()), bytes.size()}); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

TEST_CASE("the checksum is the CRC-32 of zip, and depends on every bit", "[model]") {
  const auto sum = [](std::string_view text) { return crc32(std::as_bytes(std::span(text.data(), text.size()))); };
  CHECK(sum("123456789") == 0xCBF43926);  // the check value of the CRC catalogues
  CHECK(sum("") == 0);
  CHECK(sum("The quick brown fox jumps over the lazy dog") == 0x414FA339);
}

TEST_CASE("set files and text files are distinguished by their content", "[model]") {
  const CharacterList list = rich_list();
  const TestFile file("set");
  file.write(encode_character_set(list, CoordinatePrecision::exact));
  const CharacterSet set = CharacterSet::open(file.path());
  CHECK(set.bytes() == fs::file_size(file.path()));
  CHECK(set.provenances() == std::vector{list.provenance});
  for (const Character& character : list.characters) {
    CHECK(same(set.find(character.code, character.order)->character(), character));
  }
  const TestFile text("text");
  {
    std::ofstream out(text.path(), std::ios::binary);
    write_characters(out, list);
  }
  const CharacterSet read = CharacterSet::open(text.path());
  for (const Character& character : list.characters) {
    CHECK(same(read.find(character.code, character.order)->character(), character));
  }
}

TEST_CASE("files of each version stay readable, and those of versions 2 and 4 are still written identically",
          "[model]") {
  const std::string directory = CALLIGRAPHY_SOURCE_DIR "/tests/data/";
  for (const std::string version : {"version_1", "version_2", "version_4"}) {
    const CharacterSet stored = CharacterSet::open(directory + version + ".set");
    const CharacterList list = read_characters(directory + version + ".txt");
    CHECK(stored.provenances() == std::vector{list.provenance});
    CHECK(list.provenance.licence_text == "First line\n\n and the third");
    for (const Character& character : list.characters) {  // whose coordinates and ink are whole steps of 1/800 em
      CHECK(same(stored.find(character.code, character.order)->character(), character));
    }
  }
  for (const std::string version : {"version_2", "version_4"}) {
    std::ifstream in(directory + version + ".set", std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    const Bytes written = encode_character_set(read_characters(directory + version + ".txt"));
    CHECK(std::string(reinterpret_cast<const char*>(written.data()), written.size()) == bytes);
  }
}

TEST_CASE("an open set is unaffected when its file is replaced or removed", "[model]") {
  const TestFile file("replaced"), other("replacement");
  file.write(encode_character_set(small_list()));
  const CharacterSet set = CharacterSet::open(file.path());
  other.write("calligraphy characters 1\n");
  fs::rename(other.path(), file.path());
  CHECK_NOTHROW(set.check());
  fs::remove(file.path());
  CHECK_NOTHROW(set.check());
}

TEST_CASE("a file truncated anywhere, or with trailing data, is rejected", "[model]") {
  const Bytes whole = encode_character_set(small_list());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::string found = complaint(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
    INFO(length << ": " << found);
    CHECK(found.starts_with("test.set: is truncated"));
  }
  Bytes longer = whole;
  longer.push_back(std::byte{0});
  CHECK(complaint(longer).starts_with("test.set: continues after its end"));
  CHECK(complaint(whole).empty());
}

TEST_CASE("every changed bit is detected", "[model]") {
  const Bytes whole = encode_character_set(small_list());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      Bytes damaged = whole;
      damaged[at] ^= std::byte{1} << bit;
      INFO("byte " << at << " bit " << bit);
      REQUIRE(complaint(damaged).starts_with("test.set: "));
    }
  }
}

TEST_CASE("damage in one group leaves the others usable", "[model]") {
  const CharacterList list = small_list();
  Bytes bytes = encode_character_set(list, CoordinatePrecision::exact);
  bytes.back() ^= std::byte{1};  // in the last group, U+20000's
  const CharacterSet set = CharacterSet::from_bytes(bytes, "test.set");
  CHECK(same(set.find(U'一')->character(), list.characters[0]));
  const auto damaged = set.find(U'\U00020000');
  REQUIRE(damaged);  // the index still lists it
  CHECK(damaged->stroke_count() == 0);
  CHECK_FALSE(damaged->stroke(0));
  CHECK(damaged->stroke_id(0) == 0);
  CHECK_THROWS_AS(damaged->character(), FormatError);
  const CharacterSet under = CharacterSet(list);
  CHECK(CharacterSet::layered(std::vector{set, under}).find(U'\U00020000')->stroke_count() ==
        0);  // not replaced by a lower layer
  try {
    set.check();
    FAIL("not noticed");
  } catch (const FormatError& error) {
    CHECK(std::string(error.what()).find("U+20000") != std::string::npos);
  }
}

TEST_CASE("any byte forged under correct checksums causes no access outside the file", "[model]") {
  constexpr unsigned stride = calligraphy_test::sanitized ? 51 : 5;  // 0 and 255 are among them
  int opened = 0, refused = 0;
  for (const CoordinatePrecision precision : {CoordinatePrecision::coarse, CoordinatePrecision::exact}) {
    const Bytes whole = encode_character_set(small_list(), precision);
    const std::size_t most = std::min<std::size_t>(whole.size(), 700);  // header, index and the numbers of the records
    for (std::size_t at = set_format::size_at; at < most; ++at) {
      for (unsigned value = 0; value < 256; value += stride) {
        Bytes forged = whole;
        forged[at] = static_cast<std::byte>(value);
        ++(use_forged(std::move(forged)) ? opened : refused);
      }
    }
  }
  const int many = calligraphy_test::sanitized ? 500 : 5000;
  CHECK(opened > many);
  CHECK(refused > many);
}

TEST_CASE("several numbers forged under correct checksums cause no access outside the file", "[model]") {
  constexpr int repetitions = calligraphy_test::sanitized ? 5'000 : 50'000;
  std::vector<Bytes> files;
  for (const CoordinatePrecision precision : {CoordinatePrecision::coarse, CoordinatePrecision::exact}) {
    files.push_back(encode_character_set(small_list(), precision));
  }
  calligraphy_test::Sequence random(17);
  const auto draw = [&](std::size_t count) {
    return static_cast<std::size_t>(random.next() * static_cast<double>(count));
  };
  int opened = 0, refused = 0;
  for (int i = 0; i < repetitions; ++i) {
    Bytes forged = files[static_cast<std::size_t>(i) % files.size()];
    const std::size_t changes = 1 + draw(4);
    for (std::size_t k = 0; k < changes; ++k) {
      const std::size_t at = set_format::size_at + draw(forged.size() - set_format::size_at);
      const int kind = static_cast<int>(draw(4));
      if (kind == 0) forged[at] ^= std::byte{1} << draw(8);
      if (kind == 1) forged[at] = static_cast<std::byte>(draw(256));
      if (kind == 2) forged[at] = std::byte{0xFF};
      if (kind == 3 && at + 4 <= forged.size()) store(forged, at, static_cast<std::uint32_t>(draw(2 * forged.size())));
    }
    ++(use_forged(std::move(forged)) ? opened : refused);
  }
  CHECK(opened > repetitions / 10);
  CHECK(refused > repetitions / 10);
}

TEST_CASE("each number of the header is validated, not only its checksum", "[model]") {
  using namespace set_format;
  const Bytes whole = encode_character_set(small_list());
  const auto with = [&](std::size_t at, std::uint32_t value) {
    Bytes bytes = whole;
    store(bytes, at, value);
    forge_checksums(bytes);
    return complaint(bytes);
  };
  const std::size_t first = load_u32(whole, first_group_at), groups = load_u32(whole, group_count_at);
  const std::size_t entries = first - groups * entry_size;
  CHECK(groups >= 3);
  CHECK(with(first_group_at, 12).find("groups begin at byte 12") != std::string::npos);
  CHECK(with(first_group_at, 0xFFFFFFFF).find("4294967295") != std::string::npos);
  CHECK(with(group_count_at, 0xFFFFFFFF).find("4294967295 groups") != std::string::npos);
  CHECK(with(error_at + 4, 0x7FF00000).find("coordinate error") != std::string::npos);
  CHECK(with(error_at + 4, 0xBFF00000).find("coordinate error") != std::string::npos);
  CHECK(with(coding_at, 0).find("coding") != std::string::npos);  // doubles of 10 bits
  CHECK(with(coding_at, 0xFFFFFFFF).find("coding") != std::string::npos);
  const std::size_t kinds = load<std::uint16_t>(whole.data() + kinds_at), ink = kinds_at + 2 + kind_size * kinds;
  const std::size_t rows = ink + ink_head_size;
  const std::size_t parameters = rows + 2;
  REQUIRE(load<std::uint16_t>(whole.data() + rows) == 1);  // for all kinds, as each is rare
  const std::size_t provenance = parameters + 3 * max_ink_values;
  CHECK(kinds >= 5);
  CHECK(with(kinds_at, 0xFFFFFFFF).find("list of stroke kinds has 65535 entries") != std::string::npos);
  CHECK(with(kinds_at, 0x01010400).find("list of stroke kinds") != std::string::npos);
  CHECK(with(kinds_at + 2, 0x01010028).find("invalid id 40") != std::string::npos);
  CHECK(with(kinds_at + 2, 0x01010201).find("invalid elements of id 1") != std::string::npos);  // a second element
  CHECK(with(ink, max_ink_steps_per_em + 1).find("ink encoding has invalid numbers") != std::string::npos);
  CHECK(with(ink + 1, 0x11000003).find("ink encoding has invalid numbers") != std::string::npos);  // 17 values
  CHECK(with(ink + 1, 0x00000003).find("ink encoding has invalid numbers") != std::string::npos);  // none
  CHECK(with(parameters, 0x10).find("ink encoding has invalid numbers") != std::string::npos);
  CHECK(with(rows, 0).find("ink encoding has 0 rows") != std::string::npos);
  CHECK(with(rows, 1000).find("ink encoding has 1000 rows") != std::string::npos);
  CHECK(with(provenance, 0xFFFFFFFF).find("its provenance") != std::string::npos);
  CHECK(with(provenance + 1, 0xFF000000).find("its provenance") != std::string::npos);  // no UTF-8
  CHECK(with(entries, 0).find("entry 1 ") != std::string::npos);                         // a group of no character
  const auto with_block = [&](std::size_t group, std::uint16_t value) {
    Bytes bytes = whole;
    store(bytes, entries - (groups - group) * block_size, value);
    forge_checksums(bytes);
    return complaint(bytes);
  };
  CHECK(with_block(groups - 1, 0x110000 >> 6).find("entry 3 ") != std::string::npos);
  CHECK(with_block(groups - 1, 0xDFFF >> 6).find("entry 3 ") != std::string::npos);  // surrogates
  CHECK(with_block(groups - 1, 0).find("entry 3 ") != std::string::npos);            // not rising
  CHECK(with_block(1, 0x4E00 >> 6).find("entry 2 ") != std::string::npos);
  for (std::size_t group = 0; group < groups; ++group) {
    const std::string entry = "entry ";
    CHECK(with(entries + group * entry_size + 8, 0xFFFFFFFF).find(entry) != std::string::npos);
    CHECK(with(entries + group * entry_size + 8, 1).find(entry) != std::string::npos);
  }
}

TEST_CASE("a character-specific encoding is validated like that of the file", "[model]") {
  using namespace set_format;
  CharacterList list;
  list.characters.push_back(one_stroke(U'一'));
  for (Point& point : list.characters[0].structure.control_points) point += Point(10.0, 0.1);
  const Bytes whole = encode_character_set(list);
  // The only record is at the end: offset u16, head, strokes, size, coding, bits.
  const std::size_t record = load_u32(whole, first_group_at) + 2, coding = record + 3;
  REQUIRE(whole[record] == static_cast<std::byte>(special | own_coding));
  const auto with_bits = [&](int x, int y) {
    Bytes bytes = whole;
    bytes[coding + 12] = static_cast<std::byte>(x);
    bytes[coding + 13] = static_cast<std::byte>(y);
    forge_checksums(bytes);
    return complaint(bytes);
  };
  const int x = std::to_integer<int>(whole[coding + 12]), y = std::to_integer<int>(whole[coding + 13]);
  CHECK(with_bits(x, y).empty());
  CHECK(with_bits(x + y, 0).find("一") != std::string::npos);  // as many bits as before, but not a width
  CHECK(with_bits(0, x + y).find("一") != std::string::npos);
  Bytes bytes = whole;
  store(bytes, coding, max_steps_per_em + 1);
  forge_checksums(bytes);
  CHECK(complaint(bytes).find("一") != std::string::npos);
}

namespace {

std::size_t record_of_first(const Bytes& bytes) { return load_u32(bytes, set_format::first_group_at) + 2; }

void store_bits(Bytes& bytes, std::size_t at, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i, ++at) {
    const std::byte bit = std::byte{1} << (at % 8);
    bytes[at / 8] = ((value >> i) & 1) != 0 ? bytes[at / 8] | bit : bytes[at / 8] & ~bit;
  }
}

/// Of the first stroke of 一: its ink is damaged and reported, and the stroke itself is not.
bool has_damaged_ink(Bytes bytes) {
  forge_checksums(bytes);
  const StoredCharacter stored = *CharacterSet::from_bytes(bytes, "test.set").find(U'一');
  REQUIRE(stored.has_ink());
  REQUIRE(stored.stroke(0).has_value());
  const bool is_reported = complaint(bytes).find("stroke 1 has ink") != std::string::npos;
  REQUIRE(is_reported == !stored.ink(0).has_value());
  return is_reported;
}

}  // namespace

TEST_CASE("ink that is negative, not finite or wider than 1 em is damaged, and its stroke is not", "[model]") {
  CharacterList list{{}, {one_stroke(U'一')}};
  calligraphy_test::Sequence random(23);
  calligraphy_test::add_ink(list.characters[0], 0.06, random);
  using namespace set_format;
  constexpr std::size_t knots = 8, first = 2 + knots, values = first + knots;  // its first offset, after its half-widths
  for (const CoordinatePrecision precision : {CoordinatePrecision::fine, CoordinatePrecision::exact}) {
    const Bytes whole = encode_character_set(list, precision);
    const bool is_exact = precision == CoordinatePrecision::exact;
    const std::size_t usual = kinds_at + 2 + kind_size + ink_head_size + 2 + 1;  // of all kinds
    const auto is_damaged = [&](std::size_t value, double number) {
      Bytes bytes = whole;
      if (is_exact) {  // after the rank of the kind and two points
        store_bits(bytes, 8 * record_of_first(bytes) + 8 + 2 + 64 * (4 + value), bit_cast<std::uint64_t>(number), 64);
        return has_damaged_ink(bytes);
      }
      const std::size_t place = value < first ? value : value - first + 2 + max_ink_knots + max_ink_corners;
      store(bytes, usual + 3 * place, static_cast<std::uint16_t>(std::lround(number * 12800.0)));
      return has_damaged_ink(bytes);
    };
    for (std::size_t value = 0; value < values; ++value) {
      INFO("value " << value << (is_exact ? ", exact" : ""));
      CHECK_FALSE(is_damaged(value, 1.0));
      CHECK(is_damaged(value, 1.0 + 1.0 / 12800.0));
      CHECK(is_damaged(value, -1.0 / 12800.0) == (value < first));
      if (!is_exact) continue;
      for (const double number : {HUGE_VAL, -HUGE_VAL, std::nan("")}) CHECK(is_damaged(value, number));
    }
  }
}

TEST_CASE("a form has ink for each of its strokes, and flags of ink only where the file has ink", "[model]") {
  using namespace set_format;
  calligraphy_test::Sequence random(29);
  constexpr std::size_t all_ink = 2;  // [byte]; 18 bits, as all values are the usual ones, after 42
  const auto complaint_of_head = [](const CharacterList& list, unsigned head, std::size_t cut) {
    Bytes bytes = encode_character_set(list);
    const std::size_t record = load_u32(bytes, first_group_at) + 2;
    bytes[record] = static_cast<std::byte>(head);
    bytes.resize(bytes.size() - cut);
    store(bytes, size_at, static_cast<std::uint32_t>(bytes.size()));
    if (head >= special) bytes[record + 2] = static_cast<std::byte>(bytes.size() - record - 3);
    forge_checksums(bytes);
    return complaint(bytes);
  };
  CharacterList plain{{}, {one_stroke(U'一')}};
  calligraphy_test::add_ink(plain.characters[0], 0.06, random);
  CHECK(complaint_of_head(plain, 1, 0).empty());
  CHECK_FALSE(complaint_of_head(plain, 1, 1).empty());
  CHECK_FALSE(complaint_of_head(plain, 1, all_ink).empty());

  CharacterList inked{{}, {with_quartic_curves(one_stroke(U'一'))}};
  CHECK(complaint_of_head(inked, special | quartic, 0).empty());
  CHECK_FALSE(complaint_of_head(inked, special | quartic | no_ink, 0).empty());
  calligraphy_test::add_ink(inked.characters[0], 0.06, random);
  CHECK(complaint_of_head(inked, special | quartic, 0).empty());
  CHECK(complaint_of_head(inked, special | quartic | no_ink, all_ink).empty());
  CHECK_FALSE(complaint_of_head(inked, special | quartic | no_ink, 0).empty());
}

TEST_CASE("files of a newer version and of another program are reported as such", "[model]") {
  Bytes bytes = encode_character_set(small_list());
  store(bytes, set_format::version_at, std::uint32_t{5});
  CHECK(complaint(bytes).find("newer version") != std::string::npos);
  CHECK(complaint(bytes).find("format is 5") != std::string::npos);
  store(bytes, set_format::version_at, std::uint32_t{3});
  CHECK(complaint(bytes).find("import its source again") != std::string::npos);
  store(bytes, set_format::version_at, std::uint32_t{0});
  CHECK(complaint(bytes).find("another program") != std::string::npos);
  const TestFile file("magic");
  file.write("\x89PNG\r\n\x1A\n");
  CHECK(complaint_of_file(file.path()) == file.path() + ": is not a set file: its first bytes differ");
}

TEST_CASE("a file that cannot be opened is named", "[model]") {
  const auto is_named = [](const std::string& path, const std::string& what) {
    const std::string found = complaint_of_file(path);
    INFO(found);
    return found.starts_with(path + ": ") && found.find(what) != std::string::npos;
  };
  const TestFile file("none");
  CHECK(is_named(file.path(), "cannot be opened"));
  CHECK(is_named(fs::temp_directory_path().string(), "regular file"));
  CHECK(is_named("/dev/zero", "regular file"));
  file.write("");
  CHECK(is_named(file.path(), "empty"));
  const TestFile text("nul");
  text.write(std::string_view("calligraphy characters 1\nsource \0\0\nstroke\0 1 0,0 1,1\n", 54));
  CHECK(complaint_of_file(text.path()).starts_with(text.path() + ":3: "));
  const TestFile pipe("pipe");
  REQUIRE(mkfifo(pipe.path().c_str(), 0600) == 0);
  CHECK(is_named(pipe.path(), "regular file"));  // without waiting for a writer
  const TestFile hidden("hidden");
  hidden.write(encode_character_set(small_list()));
  fs::permissions(hidden.path(), fs::perms::none);
  const bool is_root = std::ifstream(hidden.path()).good();
  if (!is_root) CHECK(is_named(hidden.path(), "cannot be opened"));
}

TEST_CASE("a character with too many strokes or orders is rejected by name", "[model]") {
  const auto complaint = [](const CharacterList& list) -> std::string {
    try {
      encode_character_set(list);
      return "none";
    } catch (const ValueError& error) {
      return error.what();
    }
  };
  const StrokeInput heng{1, {{0.1, 0.5}, {0.9, 0.5}}, {}};
  CharacterList strokes{{}, {make_character(U'一', std::vector<StrokeInput>(set_format::max_strokes, heng))}};
  CHECK(CharacterSet(strokes).find(U'一')->stroke_count() == static_cast<int>(set_format::max_strokes));
  strokes.characters = {make_character(U'一', std::vector<StrokeInput>(set_format::max_strokes + 1, heng))};
  CHECK(complaint(strokes).find("4097 strokes") != std::string::npos);

  CharacterList orders{{}, {}};
  const Character one = make_character(U'一', std::vector{heng});
  for (std::size_t i = 0; i < set_format::max_forms; ++i) {
    orders.characters.push_back(one);
    orders.characters.back().order = "order " + std::to_string(i);
  }
  CHECK(CharacterSet(orders).orders(U'一').size() == set_format::max_forms);
  CHECK(CharacterSet(orders).find(U'一', "order 254").has_value());
  orders.characters.push_back(one);
  CHECK(complaint(orders).find("more than 255 orders") != std::string::npos);
}

TEST_CASE("all characters of an imported set stay within the stated size and error", "[model]") {
  const char* const path = std::getenv("CALLIGRAPHY_CHARACTER_FILE");
  if (path == nullptr) {
    WARN("skipped: CALLIGRAPHY_CHARACTER_FILE does not name a file of characters as calligraphy import makes it");
    CHECK(std::getenv("CALLIGRAPHY_REQUIRE_DATA") == nullptr);
    return;
  }
  const CharacterSet whole = CharacterSet::open(path);
  CharacterList list{whole.provenances()[0], {}};
  for (const StoredCharacter& character : whole) list.characters.push_back(character.character());
  CHECK(list.characters.size() >= 9574);
  const struct {
    CoordinatePrecision precision;
    double max_bytes, max_ink_bytes, max_error;
  } marks[] = {{CoordinatePrecision::standard, 110.0, 112.0, 1e-3}, {CoordinatePrecision::coarse, 75.0, 85.0, 4e-3}};
  CharacterList bare = list;
  for (Character& character : bare.characters) character.physics.ink.clear();
  for (const auto& [precision, max_bytes, max_ink_bytes, max_error] : marks) {
    const CharacterSet set = CharacterSet::from_bytes(encode_character_set(list, precision), path);
    CHECK(set.size() == list.characters.size());
    const std::size_t without_ink = encode_character_set(bare, precision).size();
    CHECK(static_cast<double>(without_ink) <= max_bytes * static_cast<double>(set.size()));
    CHECK(static_cast<double>(set.bytes() - without_ink) <= max_ink_bytes * static_cast<double>(set.size()));
    double largest = 0.0;
    for (const Character& character : list.characters) {
      const Character stored = set.find(character.code)->character();
      REQUIRE(stored.sequence.stroke_ids == character.sequence.stroke_ids);
      for (std::size_t i = 0; i < character.structure.control_points.size(); ++i) {
        const Point difference = stored.structure.control_points[i] - character.structure.control_points[i];
        largest = std::max(largest, difference.norm());
      }
    }
    CHECK(largest <= coordinate_error_bound(precision));
    CHECK(largest <= max_error);
  }
}

}  // namespace set_file_tests
