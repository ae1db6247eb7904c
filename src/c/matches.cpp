#include <span>

#include <calligraphy/judge/remark_text.hpp>

#include "conversions.hpp"
#include "objects.hpp"
#include "structs.hpp"

namespace calligraphy::c {
namespace {

/// The pen-downs in the square of the character [em].
std::vector<PenPath> paths_in_square(const double* points, const std::uint32_t* sizes, std::size_t count,
                                     const Placement& placement) {
  std::vector<PenPath> paths;
  if (count == 0) return paths;
  target(points, "points");
  for (const std::uint32_t size : std::span(&target(sizes, "path_sizes"), count)) {
    PenPath& path = paths.emplace_back();
    for (std::uint32_t i = 0; i < size; ++i, points += 2) {
      path.push_back((Point(points[0], points[1]) - placement.origin) / placement.em);
    }
  }
  return paths;
}

}  // namespace
}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_index_create(const calligraphy_set* set, calligraphy_index** index) {
  return guarded([&] {
    const CharacterSet& characters = object<CharacterSet>(set);
    target(index, "index");
    hand_out(index, std::make_shared<CharacterIndex>(characters));
  });
}

calligraphy_status calligraphy_index_recognise(const calligraphy_index* index, const double* points,
                                               const uint32_t* path_sizes, size_t path_count, uint32_t* codes,
                                               double* distances, size_t capacity, size_t* count) {
  return guarded([&] {
    const CharacterIndex& characters = object<CharacterIndex>(index);
    target(count, "count");
    if (capacity > 0) target(codes, "codes"), target(distances, "distances");
    const std::vector<RecognisedCharacter> found =
        characters.recognise(paths_in_square(points, path_sizes, path_count, {Point::Zero(), 1.0}), capacity);
    *count = found.size();
    for (std::size_t i = 0; i < found.size(); ++i) codes[i] = found[i].code, distances[i] = found[i].distance;
  });
}

calligraphy_status calligraphy_match_strokes(const calligraphy_page* page, int32_t character, const double* points,
                                             const uint32_t* path_sizes, size_t path_count, int32_t tolerance,
                                             const calligraphy_set* forms, const calligraphy_index* others,
                                             calligraphy_match** match) {
  return guarded([&] {
    const PlacedCharacter& placed = item("character", object<PracticePage>(page).characters, character);
    const auto tolerances = tolerances_of<JudgeTolerances>(tolerance);
    std::vector<Character> accepted;
    if (forms) {
      for (const StoredCharacter& form : object<CharacterSet>(forms).forms(placed.character.code)) {
        accepted.push_back(form.character());
      }
      if (accepted.empty()) find_character(object<CharacterSet>(forms), placed.character.code);
    } else {
      accepted.push_back(placed.character);
    }
    const CharacterIndex* const index = others ? &object<CharacterIndex>(others) : nullptr;
    target(match, "match");
    const std::vector<PenPath> paths = paths_in_square(points, path_sizes, path_count, placed.placement);
    hand_out(match, std::make_shared<MatchObject>(match_strokes(accepted, paths, tolerances, index)));
  });
}

calligraphy_status calligraphy_match_accepted(const calligraphy_match* match, int32_t* accepted) {
  return guarded([&] { target(accepted, "accepted") = object<MatchObject>(match).result.accepted; });
}

calligraphy_status calligraphy_match_drawn(const calligraphy_match* match, int32_t path,
                                           calligraphy_drawn_stroke* drawn) {
  return guarded([&] {
    const DrawnStroke& found = item("path", object<MatchObject>(match).result.drawn, path);
    write_struct(drawn, "calligraphy_drawn_stroke",
                 {.size = 0,
                  .stroke = found.stroke,
                  .stroke_count = found.stroke_count,
                  .continues = found.continues,
                  .in_turn = found.in_turn,
                  .tap = found.tap,
                  .direction = static_cast<std::int32_t>(found.direction),
                  .attempt = found.attempt,
                  .length = found.length,
                  .distance = found.distance,
                  .also = found.also,
                  .reserved = 0});
  });
}

calligraphy_status calligraphy_language_count(int32_t* count) {
  return guarded([&] { target(count, "count") = static_cast<std::int32_t>(languages().size()); });
}

calligraphy_status calligraphy_language_code(int32_t index, const char** code) {
  return guarded([&] {
    const std::vector<Language> all = languages();
    target(code, "code") = item("index", all, index).code().data();
  });
}

calligraphy_status calligraphy_match_remark_count(const calligraphy_match* match, int32_t* count) {
  return guarded(
      [&] { target(count, "count") = static_cast<std::int32_t>(object<MatchObject>(match).result.remarks.size()); });
}

calligraphy_status calligraphy_match_remark(const calligraphy_match* match, int32_t index, calligraphy_remark* remark) {
  return guarded([&] {
    const StrokeRemark& found = item("index", object<MatchObject>(match).result.remarks, index);
    write_struct(remark, "calligraphy_remark",
                 {.size = 0,
                  .kind = static_cast<std::int32_t>(found.kind),
                  .path = found.path,
                  .path_count = found.path_count,
                  .stroke = found.stroke,
                  .stroke_count = found.stroke_count,
                  .other_path = found.other_path,
                  .other_stroke = found.other_stroke,
                  .place = {found.place.x(), found.place.y()},
                  .other_character = found.other_character,
                  .direction = static_cast<std::int32_t>(found.direction),
                  .length = found.length,
                  .evidence = found.evidence,
                  .end = static_cast<std::int32_t>(found.end),
                  .orientation = static_cast<std::int32_t>(found.orientation),
                  .amount = found.amount,
                  .offset = {found.offset.x(), found.offset.y()}});
  });
}

calligraphy_status calligraphy_match_remark_text(const calligraphy_match* match, int32_t index, const char* language,
                                                 const char** text) {
  return guarded([&] {
    MatchObject& found = object<MatchObject>(match);
    const StrokeRemark& remark = item("index", found.result.remarks, index);
    const Language chosen = language ? Language(language) : Language();
    target(text, "text");
    const std::lock_guard lock(found.mutex);
    std::string& kept = found.texts[{index, std::string(chosen.code())}];
    if (kept.empty()) kept = remark_text(remark, found.result.character, chosen);
    *text = kept.c_str();
  });
}
