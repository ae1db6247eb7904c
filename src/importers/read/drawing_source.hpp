// A collection of drawings: its files, its kind and its provenance; private to the importers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/provenance.hpp>

#include "drawing.hpp"

namespace calligraphy {

struct DrawingSource {
  SourceKind kind = SourceKind::calligraphy;
  std::vector<DrawingFile> files;  ///< by code point and order, each character once; at least one
  std::vector<SkippedFile> skipped;
  std::string licence;  ///< text of the licence; empty if the source has none
  std::string package;  ///< text of its package.json; empty if the source has none
};

/// Reads the files that the options ask for. What names no character, or contradicts its name, is skipped.
/// @throws FileError and FormatError as read_source(); FormatError if it contains no such file or is of two kinds;
///         ValueError as check_applies()
DrawingSource read_drawings(const std::filesystem::path& path, const ImportOptions& options);

/// Provenance of the characters made from the drawings; `notes` receives what it lacks. `notice`: of one of the files.
Provenance provenance(const DrawingSource& source, const ImportOptions& options, const std::string& notice,
                      std::vector<std::string>& notes);

/// @throws ValueError naming an option that has no effect on a source of this kind
void check_applies(const ImportOptions& options, SourceKind kind);

}  // namespace calligraphy
