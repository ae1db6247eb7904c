// calligraphy strokes: draws the 39 typical strokes.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <calligraphy/pictures/picture.hpp>

#include "commands.hpp"
#include "options.hpp"
#include "output_file.hpp"

namespace calligraphy::tools {
namespace {

struct StrokesArguments {
  std::string out;
  StrokeStyle style = StrokeStyle::ink;
};

}  // namespace

void add_strokes(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("strokes", "Draw the 39 typical strokes as SVG.");
  const auto options = std::make_shared<StrokesArguments>();
  command->footer("calligraphy strokes --out strokes.svg");
  add_out_file(*command, options->out);
  add_lines_flag(*command, options->style);
  command->callback([options] { write_output(options->out, typical_strokes_picture(options->style)); });
}

}  // namespace calligraphy::tools
