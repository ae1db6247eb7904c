// What was written: pen traces, matching, recognition and the motion of a pen.
#include <map>
#include <optional>
#include <variant>

#include <calligraphy/judge/dtw_distance.hpp>
#include <calligraphy/judge/remark_text.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/judge/writing_motion.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

PenStroke pen_stroke(const ArrayLike& samples, const char* name) {
  const Doubles rows = doubles(samples, name, 3);
  PenStroke result;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    result.push_back({Point(rows.at(i, 0), rows.at(i, 1)), rows.at(i, 2)});
  }
  return result;
}

PenTrace trace_of(char32_t character, const std::vector<ArrayLike>& strokes, std::string set, double em) {
  PenTrace result{character, std::move(set), em, {}};
  for (const ArrayLike& stroke : strokes) result.strokes.push_back(pen_stroke(stroke, "strokes"));
  return result;
}

std::vector<PenPath> paths_of(const std::vector<ArrayLike>& paths) {
  std::vector<PenPath> drawn;
  for (const ArrayLike& path : paths) drawn.push_back(points(path, "paths"));
  return drawn;
}

/// One character, or several forms of one.
using Accepted = std::variant<Character, std::vector<Character>>;

MatchResult match_of(const Accepted& character, const std::vector<ArrayLike>& paths, const JudgeTolerances& tolerances,
                     const std::optional<CharacterIndex>& others) {
  const auto* const one = std::get_if<Character>(&character);
  const std::span<const Character> accepted =
      one ? std::span(one, 1) : std::span<const Character>(std::get<std::vector<Character>>(character));
  const std::vector<PenPath> drawn = paths_of(paths);
  const JudgeTolerances chosen = tolerances;
  const py::gil_scoped_release release;
  return match_strokes(accepted, drawn, chosen, others ? &*others : nullptr);
}

using Arrays = py::typing::List<Doubles>;

Arrays pen_downs(const PenTrace& trace) {
  Arrays result;
  for (const PenStroke& stroke : trace.strokes) {
    Doubles rows({static_cast<py::ssize_t>(stroke.size()), py::ssize_t{3}});
    double* to = rows.mutable_data();
    for (const TimedPoint& sample : stroke) *to++ = sample.point.x(), *to++ = sample.point.y(), *to++ = sample.time;
    result.append(rows);
  }
  return result;
}

}  // namespace

void add_judge(py::module_& module) {
  add_struct<JudgeTolerances>(module)
      .def_static("lenient", &JudgeTolerances::lenient)
      .def_static("normal", &JudgeTolerances::normal)
      .def_static("strict", &JudgeTolerances::strict);
  add_struct<StrokeRemark>(module).def(
      "text",
      [](const StrokeRemark& self, const Character& character, const std::string& language) {
        return remark_text(self, character, Language(language));
      },
      "character"_a, "language"_a = "en",
      "What is wrong and what to do, in a sentence or two. character: that of the MatchResult. language: the code of one "
      "of languages(). Raises InvalidValue when the remark names a stroke that the character does not have.");
  module.def(
      "languages",
      [] {
        std::map<std::string, std::string> names;
        for (const Language& language : languages()) names.emplace(language.code(), language.name());
        return names;
      },
      "The languages in which people can be told what to do: names by code.");
  add_types<DrawnStroke, RecognisedCharacter, AffineMap, PenKinematics, WritingMotion>(module);
  add_struct<MatchResult>(module).def("count", &MatchResult::count, "kind"_a);

  py::class_<PenTrace>(module, "PenTrace")
      .def(py::init(&trace_of), "character"_a, "strokes"_a, "set"_a = "unnamed", "em"_a = 1000.0)
      .def_readonly("character", &PenTrace::character)
      .def_property_readonly("strokes", &pen_downs, "one array (n, 3) per pen-down, copied: x, y [em], time [s]")
      .def_readonly("set", &PenTrace::set)
      .def_readonly("em", &PenTrace::em);
  module.def("read_pen_traces", from_file(&read_pen_traces), "path"_a);
  module.def("write_pen_traces", to_file(&write_pen_traces), "path"_a, "traces"_a, "notice"_a = "",
             "+ Atomically. Raises FileError.");

  py::class_<CharacterIndex>(module, "CharacterIndex")
      .def(py::init(released(+[](const CharacterSet& set) { return CharacterIndex(set); })), "characters"_a)
      .def(py::init(released(+[](const CharacterList& list) { return CharacterIndex(CharacterSet(list)); })),
           "characters"_a)
      .def("__len__", &CharacterIndex::size)
      .def(
          "recognise",
          [](const CharacterIndex& self, const std::vector<ArrayLike>& paths, std::size_t most) {
            return self.recognise(paths_of(paths), most);
          },
          "paths"_a, "most"_a = 10, "+ Each path is an array (n, 2).");
  module.def("match_strokes", &match_of, "character"_a, "paths"_a, "tolerances"_a = JudgeTolerances(),
             "others"_a = py::none(),
             "+ Each path is an array (n, 2) [em]. Several accepted forms are a list of characters.");

  module.def(
      "pen_kinematics",
      [](const ArrayLike& pen_down) { return released(&pen_kinematics)(pen_stroke(pen_down, "pen_down")); },
      "pen_down"_a, "+ An array (n, 3) as in PenTrace.strokes: x, y, time.");
  module.def(
      "writing_motion", [](const std::vector<PenKinematics>& pen_downs) { return writing_motion(pen_downs); },
      "pen_downs"_a);
  module.def(
      "dtw_distance",
      [](const ArrayLike& one, const ArrayLike& other) {
        return dtw_distance(points(one, "one"), points(other, "other"));
      },
      "one"_a, "other"_a, "+ Arrays (n, 2).");
}

}  // namespace calligraphy::python
