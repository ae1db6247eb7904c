// Catches an error with nothing but the base.
#include <cstdio>

#include <calligraphy/base/error.hpp>

int main() {
  try {
    throw calligraphy::ValueError("em: is 0, expected more than 0");
  } catch (const calligraphy::Error& error) {
    std::printf("%s\n", error.what());
    return 0;
  }
}
