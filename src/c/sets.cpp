#include <cstddef>
#include <string>
#include <vector>

#include <calligraphy/model/character_text.hpp>

#include "objects.hpp"
#include "structs.hpp"

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_set_built_in(calligraphy_set** set) {
  return guarded([&] {
    target(set, "set");
    hand_out(set, std::make_shared<CharacterSet>(built_in_characters()));
  });
}

calligraphy_status calligraphy_set_typical_strokes(calligraphy_set** set) {
  return guarded([&] {
    target(set, "set");
    hand_out(set, std::make_shared<CharacterSet>(typical_stroke_characters()));
  });
}

calligraphy_status calligraphy_set_open(const char* path, calligraphy_set** set) {
  return guarded([&] {
    target(set, "set");
    hand_out(set, std::make_shared<CharacterSet>(CharacterSet::open(&target(path, "path"))));
  });
}

calligraphy_status calligraphy_set_from_memory(const void* bytes, size_t size, const char* name,
                                               calligraphy_set** set) {
  return guarded([&] {
    target(set, "set");
    if (!bytes) throw_null("bytes");
    const auto* const first = static_cast<const std::byte*>(bytes);
    hand_out(set,
             std::make_shared<CharacterSet>(CharacterSet::from_bytes({first, first + size}, name ? name : "memory")));
  });
}

calligraphy_status calligraphy_set_next(const calligraphy_set* set, uint32_t from, uint32_t* code) {
  return guarded([&] {
    const std::optional<char32_t> next = object<CharacterSet>(set).next(from);
    target(code, "code");
    if (!next) throw Refusal(CALLIGRAPHY_NOT_FOUND, "no character at or after code point " + std::to_string(from));
    *code = *next;
  });
}

calligraphy_status calligraphy_set_stroke_count(const calligraphy_set* set, uint32_t code, int32_t* stroke_count) {
  return guarded([&] {
    const Character character = find_character(object<CharacterSet>(set), code);
    target(stroke_count, "stroke_count") = character.stroke_count();
  });
}

calligraphy_status calligraphy_text_read(const calligraphy_set* set, const char* text, int32_t index,
                                         calligraphy_text_character* character) {
  return guarded([&] {
    const auto& from = object<CharacterSet>(set);
    const std::vector<TextCharacter> characters = text_characters(&target(text, "text"));
    if (index < 0) throw Refusal(CALLIGRAPHY_INVALID_VALUE, "index = " + std::to_string(index));
    if (static_cast<std::size_t>(index) >= characters.size()) {
      throw Refusal(CALLIGRAPHY_NOT_FOUND, "the text has " + std::to_string(characters.size()) + " characters");
    }
    const TextCharacter& found = characters[static_cast<std::size_t>(index)];
    thread_local std::string note;
    note = reading_note(found, found.code_in(from));
    write_struct(character, "calligraphy_text_character",
                 {.size = 0,
                  .written = found.written,
                  .code = found.code_in(from),
                  .selector = found.selector,
                  .note = note.c_str()});
  });
}
