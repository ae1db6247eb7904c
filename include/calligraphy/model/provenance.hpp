// Source and licence of characters.
#pragma once

#include <string>

namespace calligraphy {

/// Origin of characters, and the terms of their use.
struct Provenance {
  std::string source;        ///< origin of the drawings, one line
  std::string licence;       ///< name of the licence, one line
  std::string attribution;   ///< who must be credited, one line
  std::string licence_text;  ///< text of the licence if its terms require including it; any number of lines

  /// Whether all four texts are equal.
  bool operator==(const Provenance&) const = default;
};

}  // namespace calligraphy
