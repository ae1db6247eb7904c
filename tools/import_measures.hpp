// How imported strokes follow their source: the part of the report that `calligraphy import --report` adds.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include <calligraphy/importers/character_import.hpp>

namespace calligraphy::tools {

inline constexpr double percent = 100.0;

/// Part of the whole, 1 of nothing.
double share(int part, int whole);

/// "永 (U+6C38) stroke 3".
std::string stroke_reference_text(const StrokeReference& place);

nlohmann::ordered_json place_json(const StrokeReference& place);

/// Shares of all strokes, and the strokes that run back. `bytes` of the file that was written.
std::string measures_table(const ImportReport& report, std::size_t bytes);

/// The same, and the measures of every stroke.
nlohmann::ordered_json measures_json(const ImportReport& report, std::size_t bytes);

/// What ink costs in a set file at standard precision, and how well it covers the outlines: typical ink, half-widths
/// alone, and with offsets. Empty if nothing was imported with ink and a report.
std::string ink_table(const ImportResult& import);

/// The same, and the intersection over union of every stroke.
nlohmann::ordered_json ink_json(const ImportResult& import);

}  // namespace calligraphy::tools
