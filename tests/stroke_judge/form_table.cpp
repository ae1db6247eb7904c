#include "form_table.hpp"

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>

#include <calligraphy/base/text.hpp>

#include "cases.hpp"
#include "guidance/statistics.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

const std::pair<const char*, JudgeTolerances> all_tolerances[] = {
    {"lenient", JudgeTolerances::lenient()},
    {"normal", JudgeTolerances::normal()},
    {"strict", JudgeTolerances::strict()}};

/// "gap 3, bent 1": the most frequent first.
std::string counts_of(const std::map<StrokeRemarkKind, int>& kinds) {
  std::vector<std::pair<int, StrokeRemarkKind>> ordered;
  for (const auto& [kind, count] : kinds) ordered.emplace_back(-count, kind);
  std::sort(ordered.begin(), ordered.end());
  std::string text;
  for (const auto& [count, kind] : ordered) {
    text += (text.empty() ? "" : ", ") + std::string(to_string(kind)) + " " + std::to_string(-count);
  }
  return text;
}

class FormTables {
 public:
  FormTables(const CharacterSet& set, const FormTableOptions& options) : set_(set), options_(options) {}

  void print_right_pens(const std::vector<RightPen>& pens) {
    const AcceptedForms forms = accepted_forms(set_, pens);
    for (const auto& [name, tolerances] : all_tolerances) {
      const auto outcomes = judge_right_pens(pens, forms, tolerances, options_.others, options_.threads);
      std::map<std::string, RightRow> rows;
      for (std::size_t i = 0; i < pens.size(); ++i) {
        rows[pens[i].source].add(pens[i], outcomes[i]);
        rows[""].add(pens[i], outcomes[i]);
        if (!outcomes[i].form || tolerances != options_.tolerances) continue;
        fail(pens[i], "right", pens[i].paths, "", outcomes[i]);
      }
      if (rows.size() == 2) rows.erase("");
      for (const auto& [source, row] : rows) row.print(source.empty() ? "together" : source, name);
    }
  }

  void print_faults(const std::vector<RightPen>& pens, const std::string& source) {
    const AcceptedForms forms = accepted_forms(set_, pens);
    for (std::size_t row = 0; row < form_rows().size(); ++row) {
      if (options_.row.empty() || options_.row == form_rows()[row].name) print_fault(pens, source, forms, row);
    }
  }

  std::vector<PenTrace> failed() && { return std::move(failed_); }

 private:
  struct RightRow {
    ClusteredMean form, any, other;
    int count = 0;
    std::set<char32_t> characters;
    std::map<StrokeRemarkKind, int> kinds;

    void add(const RightPen& pen, const FormOutcome& outcome) {
      ++count;
      const char32_t code = pen.character.code;
      characters.insert(code);
      form.add(code, outcome.form ? 100.0 : 0.0);
      any.add(code, outcome.remarks > 0 ? 100.0 : 0.0);
      other.add(code, outcome.other != 0 ? 100.0 : 0.0);
      for (const StrokeRemarkKind kind : outcome.kinds) ++kinds[kind];
    }
    void print(const std::string& source, const char* tolerances) const {
      std::printf("%-15s %-9s %6d %10zu %6.1f +- %4.1f %6.1f +- %4.1f %6.1f  %s\n", source.c_str(), tolerances, count,
                  characters.size(), form.mean(), form.half_width(), any.mean(), any.half_width(), other.mean(),
                  counts_of(kinds).c_str());
    }
  };

  void print_fault(const std::vector<RightPen>& pens, const std::string& source, const AcceptedForms& forms,
                   std::size_t index) {
    const FormRow& row = form_rows()[index];
    const std::vector<FormCase> cases = form_cases_of(pens, index, options_.cases, options_.seed);
    const auto outcomes =
        judge_form_cases(cases, row, forms, options_.tolerances, options_.others, options_.threads);
    ClusteredMean told, best, any, remarks, other;
    std::set<char32_t> characters;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const FormOutcome& outcome = outcomes[i];
      const char32_t code = cases[i].pen->character.code;
      characters.insert(code);
      told.add(code, outcome.told ? 100.0 : 0.0);
      best.add(code, outcome.told_best ? 100.0 : 0.0);
      any.add(code, outcome.remarks > 0 ? 100.0 : 0.0);
      remarks.add(code, outcome.remarks);
      other.add(code, outcome.other != 0 ? 100.0 : 0.0);
      if (outcome.told) continue;
      std::string strokes;
      for (const int stroke : cases[i].written.strokes) strokes += " " + std::to_string(stroke + 1);
      fail(*cases[i].pen, row.name + "-" + std::to_string(cases[i].seed), cases[i].written.paths, strokes, outcome);
    }
    std::printf("%-15s %-9s %6zu %10zu %6.1f +- %4.1f %6.1f %6.1f %8.2f %6.1f", row.name.c_str(), source.c_str(),
                cases.size(), characters.size(), told.mean(), told.half_width(), best.mean(), any.mean(),
                remarks.mean(), other.mean());
    std::printf("  %s\n", to_string(row.kinds.front()));
  }

  void fail(const RightPen& pen, const std::string& name, const std::vector<PenPath>& paths, const std::string& strokes,
            const FormOutcome& outcome) {
    failed_.push_back(trace_of(pen.character.code, name, paths));
    if (!options_.list) return;
    std::printf("    %s %s %s:%s told %s\n", pen.source.c_str(), encode_utf8(pen.character.code).c_str(), name.c_str(),
                strokes.c_str(), outcome.text.c_str());
  }

  const CharacterSet& set_;
  const FormTableOptions& options_;
  std::vector<PenTrace> failed_;
};

}  // namespace

std::vector<PenTrace> print_form_tables(const std::vector<std::vector<RightPen>>& sources, const CharacterSet& set,
                                        const FormTableOptions& options) {
  FormTables tables(set, options);
  if (options.row.empty() || options.row == "right") {
    std::printf("right pens: %% with a remark of form, and with any, without notes of hooks; %% taken for another "
                "character; remarks by kind, with notes\n");
    std::printf("%-15s %-9s %6s %10s %14s %14s %6s\n", "pens", "tolerances", "n", "characters", "form", "any", "other");
    for (const std::vector<RightPen>& pens : sources) tables.print_right_pens(pens);
  }
  if (options.row != "right") {
    std::printf("faults: %% told; told by its first kind; with any remark; mean number of remarks; %% taken for "
                "another character; first kind\n");
    std::printf("%-15s %-9s %6s %10s %14s %6s %6s %8s %6s\n", "row", "pens", "n", "characters", "told", "first", "any",
                "remarks", "other");
    for (const std::vector<RightPen>& pens : sources) {
      tables.print_faults(pens, pens.front().source == "medians" ? "medians" : "people");
    }
  }
  return std::move(tables).failed();
}

}  // namespace calligraphy_test
