// calligraphy strokes: draws the 39 typical strokes.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <calligraphy/base/file.hpp>
#include <calligraphy/pictures/picture.hpp>

#include "commands.hpp"

namespace calligraphy::tools {

void add_strokes(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("strokes", "Draw the 39 typical strokes as SVG.");
  const auto out = std::make_shared<std::string>();
  command->add_option("--out", *out, "File to write")->required()->type_name("FILE");
  command->callback([out] {
    if (out->empty()) throw UsageError("--out: the name is empty");
    write_file(*out, typical_strokes_picture());
  });
}

}  // namespace calligraphy::tools
