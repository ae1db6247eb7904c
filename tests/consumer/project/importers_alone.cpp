// Reads a drawing with nothing but the importers and the model, which refuse what is none.
#include <cstdio>

#include <calligraphy/base/error.hpp>
#include <calligraphy/importers/kanjivg.hpp>

int main() {
  try {
    calligraphy::parse_kanjivg("<html/>", "x.svg");
  } catch (const calligraphy::FormatError& error) {
    std::printf("%s\n", error.what());
    return 0;
  }
  return 1;
}
