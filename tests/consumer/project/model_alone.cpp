// Looks up a character with nothing but the model.
#include <cstdio>

#include <calligraphy/model/character_list.hpp>

int main() {
  const calligraphy::Character* const one = calligraphy::built_in_characters().find(U'一');
  if (one == nullptr) return 1;
  std::printf("%zu stroke\n", calligraphy::strokes(*one).size());
  return calligraphy::strokes(*one).size() == 1 ? 0 : 1;
}
