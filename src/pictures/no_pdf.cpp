#include <calligraphy/base/error.hpp>
#include <calligraphy/pictures/pdf.hpp>

namespace calligraphy {

bool pdf_available() noexcept { return false; }

std::string pdf_of_svg(const std::string&) {
  throw Error("this build cannot draw PDF, because librsvg was missing; draw SVG, which other programs make PDF of");
}

}  // namespace calligraphy
