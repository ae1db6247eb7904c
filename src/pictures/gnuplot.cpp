#include "gnuplot.hpp"

#include <calligraphy/base/error.hpp>

#include "process.hpp"

namespace calligraphy::gnuplot {

std::string svg_terminal(int width, int height) {
  return "set terminal svg noenhanced size " + std::to_string(width) + "," + std::to_string(height) +
         " font 'sans-serif,13' background rgb 'white'\n";
}

std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char each : text) {
    const bool is_control = static_cast<unsigned char>(each) < ' ';
    result += each == '\'' ? std::string("''") : std::string(1, is_control ? ' ' : each);
  }
  return result + "'";
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
  // A browser would show the names of data blocks beside the pointer.
  for (const auto& named : picture.select_nodes("//g/title[starts-with(., '$')]")) {
    named.node().parent().remove_child(named.node());
  }
}

}  // namespace calligraphy::gnuplot
