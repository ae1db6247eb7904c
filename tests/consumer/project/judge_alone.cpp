// Judges a stroke written backwards, using only the judge and the components below it.
#include <cstdio>

#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/model/character_list.hpp>

int main() {
  using namespace calligraphy;
  const PenPath backwards = {{0.9, 0.5}, {0.1, 0.5}};
  const MatchResult match = match_strokes(built_in_characters().at(U'一'), {{backwards}});
  for (const StrokeRemark& remark : match.remarks) std::printf("%s\n", to_string(remark.kind));
  return match.count(StrokeRemarkKind::direction) == 1 ? 0 : 1;
}
