// Characters of a set file, or of the built-in set: find one, and read its strokes without allocating.
#include <cstdio>
#include <optional>
#include <string>

#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>

int main(int argc, char** argv) {
  using namespace calligraphy;
  // A set file comes from `calligraphy import`; it is mapped into memory, and only its index is read.
  const CharacterSet set = argc > 1 ? CharacterSet::open(argv[1]) : CharacterSet(built_in_characters());
  std::printf("%zu characters, %zu bytes\n", set.size(), set.bytes());

  const std::optional<StoredCharacter> found = set.find(U'永');
  if (!found) return 1;
  std::printf("%s has %d strokes:\n", encode_utf8(found->code()).c_str(), found->stroke_count());
  for (int i = 0; i < found->stroke_count(); ++i) {
    const std::optional<StoredStroke> stored =
        found->stroke(i);   // fit for the servo loop: no allocation, lock or throw
    if (!stored) return 1;  // damaged
    const Stroke stroke = stored->stroke();
    const Point start = stroke.control_points.front(), end = stroke.control_points.back();
    const std::string pinyin(stroke.type->pinyin);
    std::printf("  %d: type %2d, %-12s %zu elements from (%.2f, %.2f) to (%.2f, %.2f) em\n", i + 1, stroke.type->id,
                pinyin.c_str(), stroke.elements.size(), start.x(), start.y(), end.x(), end.y());
  }
  return found->stroke_count() == 5 ? 0 : 1;
}
