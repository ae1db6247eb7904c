#include "gnuplot.hpp"

#include <calligraphy/base/error.hpp>

#include "process.hpp"

namespace calligraphy::gnuplot {

std::string svg_terminal(int width, int height) {
  return "set terminal svg noenhanced size " + std::to_string(width) + "," + std::to_string(height) +
         " font 'sans-serif,13' background rgb 'white'\n";
}

void draw(const std::string& script, pugi::xml_document& picture) {
  const ProcessResult result = run_process({"gnuplot", "--default-settings"}, script);
  if (result.exit_code != 0) {
    throw Error("gnuplot failed with exit code " + std::to_string(result.exit_code) + ": " + result.errors);
  }
  const auto parsed = picture.load_string(result.output.c_str(), pugi::parse_default | pugi::parse_declaration);
  if (!parsed || !picture.child("svg")) {
    throw Error(std::string("gnuplot returned no SVG: ") + parsed.description() + " " + result.errors);
  }
}

}  // namespace calligraphy::gnuplot
