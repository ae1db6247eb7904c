#include <algorithm>
#include <map>
#include <utility>

#include "base/enum_name.hpp"
#include "imported_character.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_worst = 10;

/// Counts stroke by stroke, in the order of the characters.
class Counter {
 public:
  explicit Counter(SourceKind kind) { report_.kind = kind; }

  void add(const ImportedCharacter& imported) {
    const Character& character = imported.character;
    for (std::size_t i = 0; i < imported.strokes.size(); ++i) {
      const StrokeReference place{character.code, character.order, static_cast<int>(i) + 1};
      const int id = character.sequence.stroke_ids[i];
      add_stroke(imported.strokes[i], place, id);
    }
    count_within(imported.strokes);
    report_.measures.insert(report_.measures.end(), imported.measures.begin(), imported.measures.end());
    add(imported.ink, report_.ink);
    add(imported.plain_ink, report_.plain_ink);
    add(imported.typical_ink, report_.typical_ink);
    report_.crossings.source += imported.crossings.source;
    report_.crossings.kept += imported.crossings.kept;
    report_.lost_crossings.insert(report_.lost_crossings.end(), imported.lost_crossings.begin(),
                                  imported.lost_crossings.end());
    if (imported.letters_unused) report_.letters_unused.push_back(character.code);
    if (!imported.correction.empty()) report_.corrected.push_back({character.code, imported.correction});
    ++report_.characters;
  }

  ImportReport finish() {
    std::stable_sort(errors_.begin(), errors_.end(), [](const auto& a, const auto& b) { return a.error > b.error; });
    errors_.resize(std::min(errors_.size(), max_worst));
    report_.worst = std::move(errors_);
    for (auto& [key, confusion] : confusions_) report_.confusions.push_back(std::move(confusion));
    std::stable_sort(report_.confusions.begin(), report_.confusions.end(),
                     [](const auto& a, const auto& b) { return a.count > b.count; });
    return std::move(report_);
  }

 private:
  static void add(const InkMeasures& character, InkMeasures& sum) {
    for (const auto values : {&InkMeasures::strokes, &InkMeasures::characters, &InkMeasures::uncovered,
                              &InkMeasures::beyond, &InkMeasures::notches, &InkMeasures::source_notches}) {
      (sum.*values).insert((sum.*values).end(), (character.*values).begin(), (character.*values).end());
    }
    sum.contacts += character.contacts;
    sum.contacts_kept += character.contacts_kept;
    sum.apart += character.apart;
    sum.new_contacts += character.new_contacts;
  }

  void count_within(const std::vector<ImportedStroke>& strokes) {
    for (FitCount& count : report_.within) {
      const auto is_within = [&](const ImportedStroke& stroke) { return stroke.error <= count.error; };
      count.strokes += static_cast<int>(std::count_if(strokes.begin(), strokes.end(), is_within));
      count.characters += std::all_of(strokes.begin(), strokes.end(), is_within) ? 1 : 0;
    }
  }

  void add_stroke(const ImportedStroke& stroke, const StrokeReference& place, int id) {
    ++report_.strokes;
    ++report_.ids_used[static_cast<std::size_t>(id)];
    errors_.push_back({place, id, stroke.error});
    if (stroke.label.empty()) return;
    if (stroke.label_known) ++report_.labelled;
    if (stroke.label_agrees) {
      ++report_.agreed;
      ++report_.allowed;
      return;
    }
    const LabelResolution resolution = !stroke.label_known       ? LabelResolution::unknown
                                       : id == stroke.recognised ? LabelResolution::overridden
                                                                 : LabelResolution::accepted;
    report_.label_conflicts.push_back(
        {place, stroke.label, resolution, stroke.recognised, id, stroke.contradicts_label});
    if (!stroke.label_known) return;
    if (resolution == LabelResolution::accepted) ++report_.allowed;
    const auto [entry, is_new] = confusions_.try_emplace({stroke.label, stroke.recognised},
                                                         LabelConfusion{stroke.label, stroke.recognised, 0, place});
    ++entry->second.count;
  }

  ImportReport report_;
  std::vector<StrokeError> errors_;
  std::map<std::pair<std::string, int>, LabelConfusion> confusions_;
};

}  // namespace

const char* to_string(LabelResolution resolution) noexcept {
  static constexpr const char* names[] = {"unknown", "accepted", "overridden"};
  return name_of<LabelResolution::overridden>(resolution, names, "unknown");
}

ImportReport report_of(SourceKind kind, const std::vector<ImportedCharacter>& characters) {
  Counter counter(kind);
  for (const ImportedCharacter& character : characters) counter.add(character);
  return counter.finish();
}

ImportReport report_of(const CharacterList& list) {
  ImportReport report;
  for (const Character& character : list.characters) {
    ++report.characters;
    report.strokes += character.stroke_count();
    for (const int id : character.sequence.stroke_ids) ++report.ids_used[static_cast<std::size_t>(id)];
  }
  return report;
}

}  // namespace calligraphy
