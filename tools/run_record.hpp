// What the record of a run (summary.json, replay.json, ...) says of how it came about.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/writer.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "options.hpp"

namespace calligraphy::tools {

/// Keeps the words of the command line for run_facts().
void remember_command(std::span<const char* const> words);

/// Version, commit of the source, command line and present time. The commit is that of when the program was
/// built: "unknown" outside a checkout; with "-dirty" if what it was built from differed.
nlohmann::ordered_json run_facts();

/// The device with all its capabilities; null: no limit.
nlohmann::ordered_json device_json(const Capabilities& device);
/// Every option of the renderer in words, by its name.
nlohmann::ordered_json options_json(const RendererOptions& options);
nlohmann::ordered_json mapping_json(const MotionMapping& mapping);
/// The page in the workspace, and the squares on it.
nlohmann::ordered_json page_json(const PageChoice& choice, const PageLayout& layout);
/// The simulated writer, by the name of the skill.
nlohmann::ordered_json writer_json(std::string_view name, const WriterSkill& skill);

/// The text of a JSON file: indented; what is not UTF-8, as in a file's name, is replaced.
std::string json_text(const nlohmann::ordered_json& json);

/// Of which run a record is, for messages: "a run of 2026-11-28T10:15:00+01:00: calligraphy write 永 --out out". What
/// the record does not say is left out.
std::string run_of(const nlohmann::ordered_json& record);

}  // namespace calligraphy::tools
