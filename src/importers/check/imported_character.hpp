// An imported character before it enters a CharacterList; private to the importers.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/importers/character_import.hpp>

namespace calligraphy {

struct ImportedStroke {
  double error = 0.0;       ///< [em]
  double half_width = 0.0;  ///< of the brush [em]
  int recognised = 0;       ///< id by geometry alone
  std::string label;        ///< empty if there is none
  bool label_known = false;
  bool label_agrees = false;
  bool contradicts_label = false;  ///< beyond doubt; set only if measured
};

struct ImportedCharacter {
  Character character;
  std::vector<ImportedStroke> strokes;
  std::vector<StrokeMeasures> measures;  ///< if asked for
  InkMeasures ink;                       ///< of this character, if asked for
  InkMeasures plain_ink;                 ///< the same for ink without offsets
  InkMeasures typical_ink;               ///< the same for typical ink
  CrossingCount crossings;
  std::vector<LostCrossing> lost_crossings;
  bool letters_unused = false;
  std::string correction;  ///< why the order of the strokes was changed; empty: it was not
  std::string notice;  ///< copyright notice of its file
};

/// Statistics of fits and labels.
ImportReport report_of(SourceKind kind, const std::vector<ImportedCharacter>& characters);

/// Statistics of a set file or the text format.
ImportReport report_of(const CharacterList& list);

}  // namespace calligraphy
