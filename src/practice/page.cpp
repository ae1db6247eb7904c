#include <calligraphy/practice/page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"
#include "model/checksum.hpp"
#include "model/little_endian.hpp"

namespace calligraphy {

PageLayout workspace_layout(const Capabilities& device, const MotionMapping& mapping) {
  // Along a page axis the workspace ends at the nearest of its faces.
  const auto extent = [&](Eigen::Index axis) {
    const Eigen::Vector3d direction = mapping.rotation.row(axis).cwiseAbs();
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (direction[i] > 0.0) least = std::min(least, device.workspace[i] / direction[i]);
    }
    return mapping.scale * least;
  };
  constexpr double room = 1.5;  // for one square and the gaps around it [em]
  PageLayout layout;
  layout.width = extent(0);
  layout.height = extent(1);
  const double most = std::min(layout.width, layout.height) / room;
  if (most < layout.em) {
    layout.gap *= most / layout.em;
    layout.em = most;
  }
  return layout;
}

std::vector<PracticePage> lay_out(std::span<const Character> characters, const PageLayout& layout) {
  require_above_zero("page layout: width", layout.width, "m");
  require_above_zero("page layout: height", layout.height, "m");
  require_within("page layout: em", layout.em, "m", Placement::min_em, Placement::max_em);
  require_not_negative("page layout: gap", layout.gap, "m");
  const double pitch = layout.em + layout.gap;
  constexpr double rounding = 1e-9;  // 1.4 times 0.04 m is a little less than a square of that size and two gaps
  const double columns_that_fit = std::floor((layout.width - layout.gap) / pitch + rounding);
  const double rows_that_fit = std::floor((layout.height - layout.gap) / pitch + rounding);
  if (columns_that_fit < 1.0 || rows_that_fit < 1.0) {
    throw ValueError("page layout: a square of " + number_text(layout.em) + " m does not fit on a page of " +
                     number_text(layout.width) + " m x " + number_text(layout.height) + " m");
  }
  const std::size_t most = std::max<std::size_t>(characters.size(), 1);
  const auto columns = static_cast<std::size_t>(std::min(columns_that_fit, static_cast<double>(most)));
  const auto rows = static_cast<std::size_t>(std::min(rows_that_fit, static_cast<double>(most)));

  std::vector<PracticePage> pages;
  for (std::size_t first = 0; first < characters.size(); first += columns * rows) {
    const auto on_page = characters.subspan(first, std::min(columns * rows, characters.size() - first));
    const std::size_t rows_used = (on_page.size() + columns - 1) / columns;
    PracticePage page{layout.width, layout.height, {}};
    for (std::size_t i = 0; i < on_page.size(); ++i) {
      const std::size_t row = i / columns;
      const std::size_t in_row = std::min(columns, on_page.size() - row * columns);
      const double row_width = static_cast<double>(in_row) * pitch - layout.gap;
      const double height = static_cast<double>(rows_used) * pitch - layout.gap;
      const Point origin(0.5 * (layout.width - row_width) + static_cast<double>(i % columns) * pitch,
                         0.5 * (layout.height + height) - layout.em - static_cast<double>(row) * pitch);
      page.characters.push_back({on_page[i], {origin, layout.em}});
    }
    pages.push_back(std::move(page));
  }
  return pages;
}

std::uint32_t page_id(const PracticePage& page) {
  std::vector<std::byte> bytes;
  const auto add = [&bytes](double value) {
    const bool in_range = std::abs(value) < 1e18;
    append(bytes, static_cast<std::uint64_t>(in_range ? std::llround(value) : std::numeric_limits<long long>::max()));
  };
  constexpr double nanometres = 1e9, micro_em = 1e6;
  for (const PlacedCharacter& placed : page.characters) {
    add(placed.character.code);
    for (const double length : {placed.placement.origin.x(), placed.placement.origin.y(), placed.placement.em}) {
      add(length * nanometres);
    }
    for (const int id : placed.character.sequence.stroke_ids) add(id);
    for (const int feature : placed.character.sequence.feature_points) add(feature);
    for (const Point& point : placed.character.structure.control_points) {
      add(point.x() * micro_em);
      add(point.y() * micro_em);
    }
  }
  return std::max<std::uint32_t>(crc32(bytes), 1);
}

}  // namespace calligraphy
