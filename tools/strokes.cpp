// calligraphy strokes: draws the 39 typical strokes.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <calligraphy/pictures/picture.hpp>

#include "commands.hpp"
#include "output_file.hpp"

namespace calligraphy::tools {

void add_strokes(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("strokes", "Draw the 39 typical strokes as SVG.");
  const auto out = std::make_shared<std::string>();
  command->footer("calligraphy strokes --out strokes.svg");
  add_out_file(*command, *out);
  command->callback([out] { write_output(*out, typical_strokes_picture()); });
}

}  // namespace calligraphy::tools
