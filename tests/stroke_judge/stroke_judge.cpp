// Judges match_strokes() by thousands of pens of which it is known what they wrote: how often it tells that, exactly.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/model/character_list.hpp>

#include "cases.hpp"
#include "corruptions.hpp"
#include "form_table.hpp"
#include "guidance/statistics.hpp"
#include "named_constants.hpp"
#include "other_characters.hpp"
#include "stability/arguments.hpp"

namespace {

using namespace calligraphy;
using namespace calligraphy_test;

constexpr const char* usage =
    "usage: stroke_judge [--traces DIR]... [--characters FILE.set]... [--written N] [--half choosing|printed|all]\n"
    "                    [--row NAME] [--class any|dots|hooks|parallel] [--cases N]\n"
    "                    [--tolerances lenient|normal|strict] [--others] [--seed S] [--threads T] [--list]\n"
    "                    [--constant NAME=VALUE]... [--out FILE] [--form]\n"
    "    --traces, --characters: of people's pens and of what they wrote, several in turn; by default those that\n"
    "        CALLIGRAPHY_PEN_TRACES and CALLIGRAPHY_CHARACTER_FILE name, separated by ':', or else none and the\n"
    "        built-in characters\n"
    "    --written: characters that the simulated writer writes besides, 400 by default\n"
    "    --half: of the characters: the half on which thresholds may be chosen, or the other; all by default\n"
    "    --row, --class: that one alone; any: without those of the classes\n"
    "    --cases: of each row, 300 by default; rows in which nothing is random have one of each pen\n"
    "    --others: lets match_strokes() tell that another character of the sets was written, and counts how often it\n"
    "        does where that is wrong; then two rows where it is right: another, pens judged against a character\n"
    "        drawn at random, and twins, against one that differs by little (of both halves)\n"
    "    --form: two other tables, of what is remarked of form: of right pens by the file, with each tolerance, and\n"
    "        of faults of form; instead of the simulated writer, the middle lines of characters are pens, and all are\n"
    "        matched with every form of their characters; --row also takes the names of that table, and right\n"
    "    --list: each case that failed: pen-downs and remarks as they are, and as they are told\n"
    "    --constant: judges with this value of a constant of src/judge/judge_constants.hpp, several in turn\n"
    "    --out: writes those cases as pen traces, for calligraphy replay\n"
    "    --threads: 0, one per core, by default\n";

constexpr std::size_t written_twins = 10;  // pens of each form

std::vector<std::string> all_of(Arguments& arguments, const std::string& name) {
  std::vector<std::string> all;
  for (std::string next = arguments.text(name); !next.empty(); next = arguments.text(name)) all.push_back(next);
  return all;
}

std::vector<std::string> all_of(Arguments& arguments, const std::string& name, const char* variable) {
  std::vector<std::string> all = all_of(arguments, name);
  const char* const otherwise = std::getenv(variable);
  if (!all.empty() || otherwise == nullptr) return all;
  std::istringstream names(otherwise);
  for (std::string next; std::getline(names, next, ':');) {
    if (!next.empty()) all.push_back(next);
  }
  return all;
}

JudgeTolerances tolerances_of(const std::string& name) {
  if (name == "lenient") return JudgeTolerances::lenient();
  if (name == "normal") return JudgeTolerances::normal();
  if (name == "strict") return JudgeTolerances::strict();
  throw ValueError("--tolerances " + name + ": expected lenient, normal or strict");
}

bool is_of_half(char32_t code, const std::string& half) {
  if (half == "all") return true;
  if (half != "choosing" && half != "printed") {
    throw ValueError("--half " + half + ": expected choosing, printed or all");
  }
  return is_printed_half(code) == (half == "printed");
}

class Program {
 public:
  explicit Program(Arguments& arguments)
      : traces_(all_of(arguments, "--traces", "CALLIGRAPHY_PEN_TRACES")),
        files_(all_of(arguments, "--characters", "CALLIGRAPHY_CHARACTER_FILE")),
        half_(arguments.text("--half", "all")),
        row_(arguments.text("--row")),
        class_(arguments.text("--class")),
        tolerances_(tolerances_of(arguments.text("--tolerances", "normal"))),
        out_(arguments.text("--out")),
        written_count_(static_cast<std::size_t>(arguments.number("--written", 400))),
        case_count_(static_cast<std::size_t>(arguments.number("--cases", 300))),
        seed_(static_cast<std::uint64_t>(arguments.number("--seed", 1))),
        threads_(static_cast<int>(arguments.number("--threads", 0))),
        list_(arguments.flag("--list")),
        others_(arguments.flag("--others")),
        form_(arguments.flag("--form")) {}

  void run() {
    if (!out_.empty()) check_can_write(out_);
    check_row();
    collect_pens();
    if (others_) index_.emplace(set_);
    if (form_) {
      failed_ = print_form_tables(
          sources_, set_, {tolerances_, index_ ? &*index_ : nullptr, row_, case_count_, seed_, threads_, list_});
    } else {
      print_table();
    }
    if (out_.empty()) return;
    std::ostringstream text;
    write_pen_traces(text, failed_);
    write_file(out_, text.str());
  }

 private:
  void check_row() const {
    if (row_.empty()) return;
    if (form_ && row_ != "right") form_row_named(row_);
    if (!form_ && !(others_ && (row_ == "another" || row_ == "twins"))) corruption_named(row_);
  }

  void print_table() {
    std::vector<StrokeClass> classes = {StrokeClass::any, StrokeClass::dots, StrokeClass::hooks, StrokeClass::parallel};
    if (!class_.empty()) classes = {class_named(class_)};
    std::printf("comparisons: of a pen-down with a stroke, per pen-down and stroke; median and 95 %%\n");
    std::printf("%-19s %-9s %6s %10s %13s %8s\n", "row", "strokes", "n", "characters", "comparisons", "%");
    for (const StrokeClass stroke_class : classes) {
      for (std::size_t row = 0; row < corruptions().size(); ++row) {
        const Corruption& corruption = corruptions()[row];
        if (!row_.empty() && corruption.name != row_) continue;
        if (stroke_class == StrokeClass::any || corruption.has_classes()) run_row(row, stroke_class);
      }
    }
    if (others_ && (row_.empty() || row_ == "another")) run_another();
    if (others_ && (row_.empty() || row_ == "twins")) run_twins();
  }

  void collect_pens() {
    std::vector<CharacterSet> sets;
    for (const std::string& file : files_) sets.push_back(CharacterSet::open(file));
    if (sets.empty()) sets.emplace_back(built_in_characters());
    set_ = CharacterSet::layered(sets);
    std::vector<Character> characters;
    for (const CharacterSet& set : sets) {
      for (Character& each : spread_over(set, written_count_ / sets.size())) characters.push_back(std::move(each));
    }
    std::erase_if(characters, [&](const Character& each) { return !is_of_half(each.code, half_); });
    std::vector<RightPen> people = pens_of_people(traces_, sets);
    if (others_) pens_of_twins_ = people;
    std::erase_if(people, [&](const RightPen& pen) { return !is_of_half(pen.character.code, half_); });
    std::map<std::string, int> files;
    for (const RightPen& pen : people) ++files[pen.source];
    sources_ = {std::move(people), form_ ? medians(characters) : written_pens(characters, seed_, threads_)};
    std::printf("right pens: %zu of people", sources_[0].size());
    for (const auto& [file, pens] : files) std::printf(", %d in %s", pens, file.c_str());
    std::printf("; %zu of %zu %s\n", sources_[1].size(), characters.size(),
                form_ ? "middle lines" : "written by the simulated writer");
    Random random(seed_);
    for (std::vector<RightPen>& pens : sources_) shuffle(pens, random);
    std::erase_if(sources_, [](const std::vector<RightPen>& pens) { return pens.empty(); });
  }

  void run_row(std::size_t row, StrokeClass stroke_class) {
    const Corruption& corruption = corruptions()[row];
    const std::vector<Case> cases = cases_of(sources_, row, stroke_class, case_count_, seed_);
    const std::vector<Outcome> outcomes = judge_cases(cases, tolerances_, index_ ? &*index_ : nullptr, threads_);
    ClusteredMean share, form, other;
    std::vector<double> comparisons;
    std::set<char32_t> characters;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const char32_t code = cases[i].pen->character.code;
      characters.insert(code);
      comparisons.push_back(outcomes[i].comparisons);
      const bool counted = corruption.is_clean() ? !outcomes[i].silent : outcomes[i].told;
      share.add(code, counted ? 100.0 : 0.0);
      form.add(code, outcomes[i].form ? 100.0 : 0.0);
      other.add(code, outcomes[i].other != 0 ? 100.0 : 0.0);
      if (counted != corruption.is_clean()) continue;
      if (list_) print_failure(corruption, cases[i], outcomes[i]);
      if (out_.empty()) continue;
      const std::string name = corruption.name + "-" + std::to_string(cases[i].seed);
      failed_.push_back(trace_of(code, name, cases[i].corrupted.paths));
    }
    std::printf("%-19s %-9s %6zu %10zu %6.1f %6.1f %8.1f +- %.1f %s", corruption.name.c_str(), to_string(stroke_class),
                cases.size(), characters.size(), quantile(comparisons, 0.5), quantile(comparisons, 0.95), share.mean(),
                share.half_width(), corruption.is_clean() ? "with any remark" : "told exactly");
    std::printf("; %.1f +- %.1f of form", form.mean(), form.half_width());
    if (others_) std::printf("; %.1f +- %.1f another character", other.mean(), other.half_width());
    std::printf("\n");
  }

  void run_another() {
    const std::vector<OtherCase> cases = cases_of_another(sources_, set_, case_count_, seed_);
    const std::vector<OtherOutcome> outcomes = judge_others(cases, tolerances_, *index_, threads_);
    ClusteredMean exact, named;
    std::set<char32_t> characters;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const char32_t code = cases[i].pen->character.code;
      characters.insert(code);
      exact.add(code, outcomes[i].exact ? 100.0 : 0.0);
      named.add(code, outcomes[i].named == code ? 100.0 : 0.0);
      if (list_ && !outcomes[i].exact) print_failure("another", cases[i], outcomes[i]);
    }
    std::printf("%-19s %-9s %6zu %10zu %13s %8.1f +- %.1f told exactly; %.1f +- %.1f name what was written\n",
                "another", "any", cases.size(), characters.size(), "", exact.mean(), exact.half_width(), named.mean(),
                named.half_width());
  }

  void run_twins() {
    std::vector<Character> twins = forms_of_twins(set_, written_count_ > 0 ? written_twins : 0);
    for (RightPen& pen : written_pens(twins, seed_, threads_)) pens_of_twins_.push_back(std::move(pen));
    int most = 0;
    for (const Twins& each : all_twins) {
      const std::vector<OtherCase> cases = cases_of_twins(pens_of_twins_, set_, each);
      const std::vector<OtherOutcome> outcomes = judge_others(cases, tolerances_, *index_, threads_);
      Share told;
      for (std::size_t i = 0; i < cases.size(); ++i) {
        told.add(outcomes[i].named != 0);
        if (list_ && outcomes[i].named == 0) print_failure("twins", cases[i], outcomes[i]);
      }
      most += told.percent() > 50.0;
      std::printf("twins: %s written for %s: %d of %d told\n", encode_utf8(each.first).c_str(),
                  encode_utf8(each.second).c_str(), told.count, told.of);
    }
    const Pairs pairs = count_pairs(*index_, threads_);
    std::printf("twins: %d of %zu told in more than half of the cases; %zu of %zu pairs of characters hardly differ\n",
                most, all_twins.size(), pairs.lookalikes, pairs.all);
  }

  static void print_failure(const std::string& row, const OtherCase& each, const OtherOutcome& outcome) {
    std::printf("    %s %s %s for %s: told %s\n", each.pen->source.c_str(),
                encode_utf8(each.pen->character.code).c_str(), row.c_str(), encode_utf8(each.asked_for.code).c_str(),
                outcome.text.c_str());
  }

  static void print_failure(const Corruption& corruption, const Case& each, const Outcome& outcome) {
    std::printf("    %s %s %s-%llu: %s; told %s\n", each.pen->source.c_str(),
                encode_utf8(each.pen->character.code).c_str(), corruption.name.c_str(),
                static_cast<unsigned long long>(each.seed), describe(each.corrupted.truths.front()).c_str(),
                outcome.text.c_str());
  }

  std::vector<std::string> traces_, files_;
  std::string half_, row_, class_;
  JudgeTolerances tolerances_;
  std::string out_;
  std::size_t written_count_, case_count_;
  std::uint64_t seed_;
  int threads_;
  bool list_, others_, form_;
  CharacterSet set_;  ///< all sets
  std::optional<CharacterIndex> index_;
  std::vector<std::vector<RightPen>> sources_;  ///< people's pens and written ones, where there are any
  std::vector<RightPen> pens_of_twins_;         ///< of people, of both halves, and written
  std::vector<PenTrace> failed_;
};

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // seconds pass between lines
  Arguments arguments(argc, argv);
  try {
    for (const std::string& assignment : all_of(arguments, "--constant")) set_constant(assignment);
    Program program(arguments);
    if (!arguments.understood()) {
      std::fputs(usage, stderr);
      return 2;
    }
    program.run();
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
