// Draws the typical strokes with nothing above the pictures.
#include <cstdio>
#include <string>

#include <calligraphy/pictures/picture.hpp>

int main() {
  const std::string picture = calligraphy::typical_strokes_picture();
  std::printf("%zu bytes\n", picture.size());
  return picture.find("</svg>") == std::string::npos ? 1 : 0;
}
