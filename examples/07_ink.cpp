// Draws a character as ink: fills the outline of each of its strokes. A set imported from hanzi-writer-data has each
// stroke's own width; the built-in characters get that of their kinds of strokes.
//
//   07_ink [FILE] > ink.svg      FILE: a set file or the text format
#include <cstdio>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/typical_ink.hpp>

using namespace calligraphy;

int main(int argc, char** argv) try {
  const CharacterSet set = argc > 1 ? CharacterSet::open(argv[1]) : CharacterSet(built_in_characters());
  const auto found = set.find(U'永');
  if (!found) throw ValueError("the set does not have 永");
  const Character character = with_typical_ink(found->character());

  std::puts(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1 1" width="400" height="400">)");
  for (const Stroke& stroke : strokes(character)) {
    std::printf("<path d=\"M");
    for (const Point& point : ink_outline(stroke)) std::printf(" %.4f,%.4f", point.x(), 1.0 - point.y());
    std::puts("Z\"/>");
  }
  std::puts("</svg>");
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
