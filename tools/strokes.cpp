// calligraphy strokes: draws the 39 typical strokes.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/pictures/chinese_font.hpp>
#include <calligraphy/pictures/pdf.hpp>
#include <calligraphy/pictures/picture.hpp>

#include "commands.hpp"
#include "no_font.hpp"
#include "options.hpp"
#include "output_file.hpp"

namespace calligraphy::tools {
namespace {

struct StrokesArguments {
  std::string out;
  StrokeStyle style = StrokeStyle::ink;
};

bool names_pdf(const std::string& out) {
  std::string ending = std::filesystem::path(out).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".pdf";
}

void draw_strokes(const StrokesArguments& options) {
  const bool pdf = names_pdf(options.out);
  if (pdf && !pdf_available()) throw Error(options.out + ": PDF needs librsvg, without which this program was built");
  const std::string font = typical_strokes_font();
  const std::string picture = typical_strokes_picture(options.style, font);
  write_output(options.out, pdf ? pdf_of_svg(picture) : picture);
  if (!font.empty()) return;
  spdlog::warn("{}", fonts_can_be_found() ? no_font_has("the Chinese names, which are left out")
                                          : "the Chinese names are left out, because this build cannot find a font: "
                                            "fontconfig was missing");
}

}  // namespace

void add_strokes(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("strokes", "Draw a poster of the 39 typical strokes, as SVG or, into FILE.pdf, as PDF.");
  const auto options = std::make_shared<StrokesArguments>();
  command->footer("calligraphy strokes --out strokes.svg\ncalligraphy strokes --out strokes.pdf");
  add_out_file(*command, options->out);
  add_lines_flag(*command, options->style);
  command->callback([options] { draw_strokes(*options); });
}

}  // namespace calligraphy::tools
