// guidance_judge people: people's strokes, as they wrote them.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/device_profiles.hpp>

#include "judge_program.hpp"
#include "people.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

std::string given(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr ? value : "";
}

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream all(list);
  for (std::string name; std::getline(all, name, ':');) {
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

std::vector<CharacterSet> sets_given() {
  std::vector<CharacterSet> sets;
  for (const char* variable : {"CALLIGRAPHY_CHARACTER_FILE", "CALLIGRAPHY_KANJI_FILE"}) {
    if (const std::string file = given(variable); !file.empty()) sets.push_back(CharacterSet::open(file));
  }
  if (sets.empty()) throw ValueError("CALLIGRAPHY_CHARACTER_FILE and CALLIGRAPHY_KANJI_FILE name no characters");
  return sets;
}

/// In an order that no figure depends on.
void keep_characters(std::vector<RightPen>& pens, std::size_t count) {
  const auto key_of = [](char32_t code) { return std::pair(Random(code).bits(), code); };
  std::set<std::pair<std::uint64_t, char32_t>> keys;
  for (const RightPen& pen : pens) keys.insert(key_of(pen.character.code));
  if (keys.size() <= count) return;
  const auto first_dropped = *std::next(keys.begin(), static_cast<std::ptrdiff_t>(count));
  std::erase_if(pens, [&](const RightPen& pen) { return key_of(pen.character.code) >= first_dropped; });
}

struct LengthClass {
  const char* name;
  double from, to;  // of the character's stroke [em]
};
constexpr LengthClass length_classes[] = {{"all", 0.0, std::numeric_limits<double>::infinity()},
                                          {"< 0.2", 0.0, 0.2},
                                          {"0.2 to 0.4", 0.2, 0.4},
                                          {"> 0.4", 0.4, std::numeric_limits<double>::infinity()}};

/// "88.7 +- 3.2" [%], the interval by characters.
template <typename Rows>
std::string percent(const Rows& rows, bool std::decay_t<decltype(*Rows().begin())>::*is) {
  ClusteredMean share;
  for (const auto& row : rows) share.add(row.due.character, row.*is ? 1.0 : 0.0);
  char text[40];
  std::snprintf(text, sizeof text, "%6.2f +- %.2f", 100.0 * share.mean(), 100.0 * share.half_width());
  return text;
}

class PeopleProgram {
 public:
  explicit PeopleProgram(Arguments& arguments)
      : traces_(names_in(arguments.text("--traces", given("CALLIGRAPHY_ALL_PEN_TRACES")))),
        half_(arguments.text("--half")),
        tolerances_(arguments.text("--tolerances", "normal")),
        count_(static_cast<std::size_t>(arguments.number("--characters", 1e6))) {
    options_.device = device_profile("ideal");
    options_.renderer = RendererOptions::for_device(options_.device);
    options_.renderer.tolerances = tolerances_of(tolerances_);
    options_.em = 1e-3 * arguments.number("--em", 40.0);
    options_.threads = static_cast<int>(arguments.number("--threads", 0));
  }

  void run() {
    collect_pens();
    std::printf("ideal, em %.0f mm, %s, kinematic pen: people's strokes at the first touch [%%]\n", 1e3 * options_.em,
                tolerances_.c_str());
    print_first_touches();
    print_parts();
    print_redone();
  }

 private:
  void collect_pens() {
    if (traces_.empty()) throw ValueError("--traces: no directory of pen traces");
    if (!half_.empty() && half_ != "choosing" && half_ != "printed") {
      throw ValueError("--half " + half_ + ": expected choosing or printed");
    }
    pens_ = pens_of_people(traces_, sets_given());
    std::erase_if(pens_, [&](const RightPen& pen) {
      return !half_.empty() && is_printed_half(pen.character.code) != (half_ == "printed");
    });
    keep_characters(pens_, count_);
    if (pens_.empty()) throw ValueError("no pen wrote a character of the sets right");
  }

  void print_first_touches() const {
    const std::vector<FirstTouch> touches = draw_people(pens_, options_, progress());
    std::printf("%-28s %-10s %7s %5s %10s %16s %16s %16s\n", "source", "length", "strokes", "pens", "characters",
                "begun", "at the lift", "with the next");
    std::set<std::string> sources;
    for (const RightPen& pen : pens_) sources.insert(pen.source);
    for (const std::string& source : sources) print_source(source, touches);
    if (sources.size() > 1) print_source("", touches);
    const auto mistaken = std::count_if(touches.begin(), touches.end(), [](const auto& row) { return row.mistaken; });
    std::printf("the next stroke taken for the due one: %d\n", static_cast<int>(mistaken));
  }

  /// "" for all.
  void print_source(const std::string& source, const std::vector<FirstTouch>& touches) const {
    for (const LengthClass& lengths : length_classes) {
      std::vector<FirstTouch> rows;
      std::set<std::size_t> pens;
      std::set<char32_t> characters;
      for (const FirstTouch& touch : touches) {
        const DueStroke& due = touch.due;
        if (!source.empty() && pens_[due.pen].source != source) continue;
        if (due.length < lengths.from || due.length >= lengths.to) continue;
        rows.push_back(touch);
        pens.insert(due.pen);
        characters.insert(due.character);
      }
      if (rows.empty()) continue;
      std::printf("%-28s %-10s %7zu %5zu %10zu %16s %16s %16s\n", source.empty() ? "together" : source.c_str(),
                  lengths.name, rows.size(), pens.size(), characters.size(), percent(rows, &FirstTouch::begun).c_str(),
                  percent(rows, &FirstTouch::at_lift).c_str(), percent(rows, &FirstTouch::with_next).c_str());
    }
  }

  void print_parts() const {
    constexpr PersonsPart halves[] = {{0.0, 0.5, 0.2}, {0.5, 1.0, 0.2}};
    for (const PersonsPart& half : halves) {
      const std::vector<FirstTouch> rows = draw_parts_of_people(pens_, half, options_, progress());
      std::printf("%-54s %7zu: at the lift %s, with the next %s\n",
                  half.from > 0.0 ? "the person's second half of strokes of 0.2 em and more"
                                  : "the person's first half of strokes of 0.2 em and more",
                  rows.size(), percent(rows, &FirstTouch::at_lift).c_str(),
                  percent(rows, &FirstTouch::with_next).c_str());
    }
  }

  void print_redone() const {
    for (const double share : {0.7, 0.8}) {
      const std::vector<Redone> rows = redo_strokes(pens_, share, options_, progress());
      std::printf("%.0f %% of a stroke, unfinished, then the same whole %10zu: finishes it %s, taken for the next %s\n",
                  100.0 * share, rows.size(), percent(rows, &Redone::finished).c_str(),
                  percent(rows, &Redone::taken_for_next).c_str());
    }
  }

  std::vector<std::string> traces_;
  std::string half_, tolerances_;
  std::size_t count_;
  SequenceOptions options_;
  std::vector<RightPen> pens_;
};

}  // namespace

int people(Arguments& arguments) {
  PeopleProgram program(arguments);
  if (!arguments.understood()) return 2;
  program.run();
  return 0;
}

}  // namespace calligraphy_test
