#include "bitmap.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace calligraphy::recognition {
namespace {

constexpr double beyond_em = 0.25;  // [em]
constexpr int bits_per_word = 64;

}  // namespace

Bitmap::Bitmap(int pixels_per_em)
    : pixels_per_em_(pixels_per_em),
      rows_(static_cast<int>((1.0 + 2.0 * beyond_em) * pixels_per_em)),
      words_((rows_ + bits_per_word - 1) / bits_per_word),
      first_row_(rows_),
      last_row_(-1),
      bits_(static_cast<std::size_t>(rows_ * words_), 0) {}

void Bitmap::clear() {
  if (first_row_ <= last_row_) {
    const auto row_at = [this](int row) { return bits_.begin() + std::ptrdiff_t{row} * words_; };
    std::fill(row_at(first_row_), row_at(last_row_ + 1), 0);
  }
  first_row_ = rows_;
  last_row_ = -1;
}

void Bitmap::fill(const Outline& outline) {
  if (outline.empty()) return;
  const Eigen::AlignedBox2d box = box_of(outline);
  const int last = row_of(box.max().y());
  std::vector<std::pair<double, int>> crossings;  // x, and whether the edge goes up
  for (int row = row_of(box.min().y()); row <= last; ++row) {
    const double y = (row + 0.5) / pixels_per_em_ - beyond_em;
    crossings.clear();
    for (const auto& [from, to, is_border] : outline.edges) {
      if ((from.y() <= y) == (to.y() <= y)) continue;
      const double share = (y - from.y()) / (to.y() - from.y());
      crossings.emplace_back(from.x() + share * (to.x() - from.x()), to.y() > from.y() ? 1 : -1);
    }
    std::sort(crossings.begin(), crossings.end());
    int winding = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
      winding += crossings[i].second;
      if (winding != 0) fill_span(row, crossings[i].first, crossings[i + 1].first);
    }
  }
}

void Bitmap::fill(const InkDisc& disc) {
  const int last = row_of(disc.centre.y() + disc.radius);
  for (int row = row_of(disc.centre.y() - disc.radius); row <= last; ++row) {
    const double dy = (row + 0.5) / pixels_per_em_ - beyond_em - disc.centre.y();
    const double squared = disc.radius * disc.radius - dy * dy;
    if (squared <= 0.0) continue;
    const double half = std::sqrt(squared);
    fill_span(row, disc.centre.x() - half, disc.centre.x() + half);
  }
}

void Bitmap::add(const Bitmap& other) {
  for (int i = other.first_row_ * words_; i < (other.last_row_ + 1) * words_; ++i) {
    bits_[static_cast<std::size_t>(i)] |= other.bits_[static_cast<std::size_t>(i)];
  }
  first_row_ = std::min(first_row_, other.first_row_);
  last_row_ = std::max(last_row_, other.last_row_);
}

std::int64_t Bitmap::area() const {
  std::int64_t area = 0;
  for (const std::uint64_t word : bits_) area += std::popcount(word);
  return area;
}

double intersection_over_union(const Bitmap& a, const Bitmap& b) {
  std::int64_t both = 0, any = 0;
  const int first = std::min(a.first_row_, b.first_row_) * a.words_;
  const int end = (std::max(a.last_row_, b.last_row_) + 1) * a.words_;
  for (int i = first; i < end; ++i) {
    const std::uint64_t one = a.bits_[static_cast<std::size_t>(i)], other = b.bits_[static_cast<std::size_t>(i)];
    if ((one | other) == 0) continue;
    both += std::popcount(one & other);
    any += std::popcount(one | other);
  }
  return any > 0 ? static_cast<double>(both) / static_cast<double>(any) : 0.0;
}

int Bitmap::row_of(double y) const {
  return std::clamp(static_cast<int>(std::floor((y + beyond_em) * pixels_per_em_)), 0, rows_ - 1);
}

void Bitmap::fill_span(int row, double from, double to) {
  const double last_pixel = bits_per_word * words_ - 1;
  const int first = static_cast<int>(std::clamp(std::ceil((from + beyond_em) * pixels_per_em_ - 0.5), 0.0, last_pixel));
  const int last = static_cast<int>(std::clamp(std::floor((to + beyond_em) * pixels_per_em_ - 0.5), -1.0, last_pixel));
  if (first > last) return;
  first_row_ = std::min(first_row_, row);
  last_row_ = std::max(last_row_, row);
  std::uint64_t* const words = &bits_[static_cast<std::size_t>(row * words_)];
  const int first_word = first / bits_per_word, last_word = last / bits_per_word;
  const std::uint64_t from_first = ~std::uint64_t{0} << (first % bits_per_word);
  const std::uint64_t to_last = ~std::uint64_t{0} >> (bits_per_word - 1 - last % bits_per_word);
  if (first_word == last_word) {
    words[first_word] |= from_first & to_last;
    return;
  }
  words[first_word] |= from_first;
  for (int i = first_word + 1; i < last_word; ++i) words[i] = ~std::uint64_t{0};
  words[last_word] |= to_last;
}

}  // namespace calligraphy::recognition
