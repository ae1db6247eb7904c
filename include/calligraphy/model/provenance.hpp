// Where characters come from, and how they may be used.
#pragma once

#include <string>

namespace calligraphy {

struct Provenance {
  std::string source;        ///< who drew them, one line
  std::string licence;       ///< under which terms they may be used, one line
  std::string attribution;   ///< whom to name, one line
  std::string licence_text;  ///< the licence itself, where its terms ask that it goes along; any number of lines

  bool operator==(const Provenance&) const = default;
};

}  // namespace calligraphy
