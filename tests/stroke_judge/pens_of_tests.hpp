// People's pens for the tests of the judge, and the sets that have what they wrote.
#pragma once

#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "../catch.hpp"
#include "judge/pen_traces.hpp"
#include "right_pens.hpp"

namespace calligraphy_test {

struct TestPens {
  std::vector<calligraphy::CharacterSet> sets;  ///< hanzi-writer-data, then KanjiVG
  std::vector<RightPen> pens;
};

/// Of CALLIGRAPHY_ALL_PEN_TRACES and the two imported sets, or none with the reason printed.
inline std::optional<TestPens> people() {
  const char* const directories = std::getenv("CALLIGRAPHY_ALL_PEN_TRACES");
  const char* const kanji = std::getenv("CALLIGRAPHY_KANJI_FILE");
  const auto hanzi = imported_characters();
  if (directories == nullptr || kanji == nullptr || !hanzi) {
    WARN("skipped: CALLIGRAPHY_ALL_PEN_TRACES and CALLIGRAPHY_KANJI_FILE name no pen traces and no characters");
    return std::nullopt;
  }
  std::vector<std::string> all;
  std::istringstream names(directories);
  for (std::string name; std::getline(names, name, ':');) all.push_back(name);
  TestPens result{{*hanzi, calligraphy::CharacterSet::open(kanji)}, {}};
  result.pens = pens_of_people(all, result.sets);
  return result;
}

/// Those of the half that was not looked at.
inline std::vector<RightPen> printed_half(std::vector<RightPen> pens) {
  std::erase_if(pens, [](const RightPen& pen) { return !is_printed_half(pen.character.code); });
  return pens;
}

}  // namespace calligraphy_test
