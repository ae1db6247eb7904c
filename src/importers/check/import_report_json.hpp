// Reports and warnings of an import as JSON; private to importers and program.
#pragma once

#include <cstddef>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/importers/stroke_warnings.hpp>

namespace calligraphy {

/// The report, with the measures of every stroke if there are any. `bytes`: size of the file that was written [byte].
nlohmann::ordered_json report_json(const ImportResult& import, std::size_t bytes);

/// ink_figures() by key, each with the intersection over union of every stroke.
nlohmann::ordered_json ink_json(const ImportResult& import);

/// One row per warning.
nlohmann::ordered_json warnings_json(const std::vector<CharacterWarnings>& characters);

}  // namespace calligraphy
