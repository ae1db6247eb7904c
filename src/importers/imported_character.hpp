// One character on its way from a source to a CharacterList; private to the import.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/importers/character_import.hpp>

namespace calligraphy {

struct ImportedStroke {
  double error = 0.0;         ///< [em]
  double median_error = 0.0;  ///< with the corners that a brush's median cuts [em]
  int recognised = 0;         ///< id by geometry alone
  std::string label;          ///< empty where there is none
  bool label_known = false;
  bool label_agrees = false;
};

struct ImportedCharacter {
  Character character;
  std::vector<ImportedStroke> strokes;
  bool letters_unused = false;
  std::string notice;  ///< of its file
};

/// Counts what was fitted and how labels fared.
ImportReport report_of(SourceKind kind, const std::vector<ImportedCharacter>& characters);

/// Counts what the text format gave.
ImportReport report_of(const CharacterList& list);

}  // namespace calligraphy
