#include "stroke_labels.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/charconv.hpp"
#include "importers/built_in.hpp"

namespace calligraphy {
namespace {

using LabelIds = std::map<std::string, std::vector<int>, std::less<>>;

std::vector<int> parse_ids(std::string_view list) {
  std::vector<int> ids;
  const char* at = list.data();
  const char* const end = at + list.size();
  while (at < end) {
    int id = 0;
    at = from_chars(at, end, id).ptr + 1;
    ids.push_back(id);
  }
  return ids;
}

/// Rows of label, comma-separated ids and example; the first row has the column names.
LabelIds parse_table(std::string_view table) {
  LabelIds labels;
  std::size_t begin = table.find('\n') + 1;
  while (begin < table.size()) {
    const std::string_view row = table.substr(begin, table.find('\n', begin) - begin);
    const std::size_t first_tab = row.find('\t');
    const std::size_t second_tab = row.find('\t', first_tab + 1);
    labels.emplace(row.substr(0, first_tab), parse_ids(row.substr(first_tab + 1, second_tab - first_tab - 1)));
    begin += row.size() + 1;
  }
  return labels;
}

struct LetterIds {
  std::array<int, 4> ids{};
  std::size_t count = 0;
};

/// a to z; the names are those of cnchar-order's own table.
constexpr std::array<LetterIds, 26> letter_ids = {{
    {{26}, 1},            // a heng zhe zhe pie
    {{30, 32}, 2},        // b shu wan, and shu zhe
    {{16}, 1},            // c heng zhe
    {{8, 9, 10, 38}, 4},  // d "dian 2": the left dot of 心, the dots of 冫 and 氵, ti among them
    {{11, 17}, 2},        // e heng pie, heng gou
    {{2}, 1},             // f shu
    {{12}, 1},            // g shu gou
    {{29}, 1},            // h shu ti
    {{10}, 1},            // i ti
    {{1}, 1},             // j heng
    {{8, 9, 38}, 3},      // k dian
    {{6, 7, 38}, 3},      // l na, and chang dian where it stands for one
    {{37}, 1},            // m pie dian
    {{36}, 1},            // n pie zhe
    {{20, 21, 22}, 3},    // o heng xie gou, heng zhe wan gou
    {{19}, 1},            // p heng zhe ti
    {{25}, 1},            // q heng zhe zhe zhe
    {{18}, 1},            // r heng zhe gou
    {{3, 4, 5}, 3},       // s pie
    {{13}, 1},            // t wan gou
    {{31}, 1},            // u shu wan gou
    {{23, 24}, 2},        // v heng zhe zhe, heng zhe wan
    {{27, 28}, 2},        // w heng zhe zhe zhe gou, heng pie wan gou
    {{33, 34}, 2},        // x shu zhe pie, shu zhe zhe
    {{14, 15}, 2},        // y xie gou, wo gou
    {{35}, 1},            // z shu zhe zhe gou
}};

}  // namespace

std::span<const int> ids_of_kanjivg_label(std::string_view label) {
  static const LabelIds labels = parse_table(built_in::kanjivg_labels);
  const auto found = labels.find(label);
  return found == labels.end() ? std::span<const int>() : std::span<const int>(found->second);
}

std::span<const int> ids_of_stroke_letter(char letter) noexcept {
  if (letter < 'a' || letter > 'z') return {};
  const LetterIds& entry = letter_ids[static_cast<std::size_t>(letter - 'a')];
  return std::span(entry.ids).first(entry.count);
}

}  // namespace calligraphy
