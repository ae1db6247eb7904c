// What was written: pen traces, also of other formats, matching, recognition and the motion of a pen.
#include <map>
#include <optional>
#include <variant>

#include <calligraphy/importers/ink_import.hpp>
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

constexpr py::ssize_t stylus_size = std::tuple_size_v<std::remove_cvref_t<decltype(fields_of<StylusState>)>>;

/// Lists of arrays as PenTrace has them in Python, with their names.
struct GivenPaths {
  const char *points_name, *stylus_name, *buttons_name;
  const std::vector<ArrayLike>&points, &stylus, &buttons;
};

/// Checks that there is an array for each path, or none. @throws ValueError
void require_each(const char* name, const std::vector<ArrayLike>& given, const GivenPaths& paths) {
  if (given.empty() || given.size() == paths.points.size()) return;
  throw ValueError(formatted("{}: expected as many arrays as {}, {}, or none, got {}", name, paths.points_name,
                             paths.points.size(), given.size()));
}

std::vector<PenStroke> pen_strokes(const GivenPaths& given) {
  require_each(given.stylus_name, given.stylus, given);
  require_each(given.buttons_name, given.buttons, given);
  std::vector<PenStroke> result;
  for (std::size_t i = 0; i < given.points.size(); ++i) {
    PenStroke& stroke = result.emplace_back(pen_stroke(given.points[i], given.points_name));
    const auto size = static_cast<py::ssize_t>(stroke.size());
    if (!given.stylus.empty()) {
      const Doubles rows = doubles(given.stylus[i], given.stylus_name, stylus_size);
      if (rows.shape(0) != size) refuse_shape(given.stylus_name, formatted("({}, {})", size, stylus_size), rows);
      const double* from = rows.data();
      for (TimedPoint& point : stroke) {
        each_field<StylusState>([&](const auto& field) { point.stylus.*field.member = *from++; });
      }
    }
    if (!given.buttons.empty()) {
      const Doubles row = doubles(given.buttons[i], given.buttons_name);
      if (row.size() != size) refuse_shape(given.buttons_name, formatted("({},)", size), row);
      constexpr int most = std::numeric_limits<std::int32_t>::max();
      const double* from = row.data();
      for (TimedPoint& point : stroke) {
        const double value = *from++;
        if (!(value >= -1.0 && value <= most && std::trunc(value) == value)) {
          throw ValueError(
              formatted("{}: expected integers from -1 to {}, got {}", given.buttons_name, most, value));
        }
        point.buttons = static_cast<std::int32_t>(value);
      }
    }
  }
  return result;
}

using Lists = std::vector<ArrayLike>;

PenTrace trace_of(const std::string& text, const Lists& strokes, std::string set, double em, const Lists& stylus,
                  const Lists& buttons, const Lists& air, const Lists& air_stylus, const Lists& air_buttons,
                  const std::string& selector) {
  if (!air.empty() && air.size() != strokes.size() + 1) {
    throw ValueError(formatted("air: expected one array more than strokes, {}, or none, got {}", strokes.size() + 1,
                               air.size()));
  }
  const TextCharacter character = one_character(text + selector, "character");
  return {character.written, std::move(set), em,
          pen_strokes({"strokes", "stylus", "buttons", strokes, stylus, buttons}),
          pen_strokes({"air", "air_stylus", "air_buttons", air, air_stylus, air_buttons}), character.selector};
}

/// A file, compressed by gzip or not, or its content.
using InkSource = std::variant<py::bytes, std::filesystem::path>;

InkImport ink_of(const InkSource& source, const std::string& text, const std::optional<YAxis>& y_axis,
                 const std::string& set, const std::string& name) {
  const InkOptions options{text_characters(text), y_axis, set};
  if (const auto* const bytes = std::get_if<py::bytes>(&source)) {
    const std::string_view content = *bytes;
    const py::gil_scoped_release release;
    return import_ink(content, name.empty() ? "bytes" : name, options);
  }
  const auto& path = std::get<std::filesystem::path>(source);
  const py::gil_scoped_release release;
  const std::string content = content_of(path, CutOff::refused);
  return import_ink(content, name.empty() ? path.string() : name, options);
}

PenTrace turned_over(PenTrace trace) {
  turn_over(trace);
  return trace;
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

using Paths = std::vector<PenStroke> PenTrace::*;

template <Paths paths>
py::typing::List<Doubles> places_of(const PenTrace& trace) {
  py::typing::List<Doubles> result;
  for (const PenStroke& stroke : trace.*paths) {
    Doubles rows({static_cast<py::ssize_t>(stroke.size()), py::ssize_t{3}});
    double* to = rows.mutable_data();
    for (const TimedPoint& sample : stroke) *to++ = sample.point.x(), *to++ = sample.point.y(), *to++ = sample.time;
    result.append(rows);
  }
  return result;
}

template <Paths paths>
py::typing::List<Doubles> stylus_of(const PenTrace& trace) {
  py::typing::List<Doubles> result;
  for (const PenStroke& stroke : trace.*paths) {
    Doubles rows({static_cast<py::ssize_t>(stroke.size()), stylus_size});
    double* to = rows.mutable_data();
    for (const TimedPoint& sample : stroke) {
      each_field<StylusState>([&](const auto& field) { *to++ = sample.stylus.*field.member; });
    }
    result.append(rows);
  }
  return result;
}

template <Paths paths>
py::typing::List<py::array_t<std::int32_t>> buttons_of(const PenTrace& trace) {
  py::typing::List<py::array_t<std::int32_t>> result;
  for (const PenStroke& stroke : trace.*paths) {
    py::array_t<std::int32_t> row(static_cast<py::ssize_t>(stroke.size()));
    std::int32_t* to = row.mutable_data();
    for (const TimedPoint& sample : stroke) *to++ = sample.buttons;
    result.append(row);
  }
  return result;
}

/// Without what was not recorded.
py::object represented(const py::object& self) {
  const auto& trace = self.cast<const PenTrace&>();
  const auto any = [](const std::vector<PenStroke>& paths, const auto& has) {
    return std::any_of(paths.begin(), paths.end(),
                       [&](const PenStroke& path) { return std::any_of(path.begin(), path.end(), has); });
  };
  const auto has_stylus = [](const TimedPoint& each) { return !(each.stylus == StylusState()); };
  const auto has_buttons = [](const TimedPoint& each) { return each.buttons >= 0; };
  py::list names;
  for (const char* name : {"character", "strokes", "set", "em"}) names.append(name);
  if (any(trace.strokes, has_stylus)) names.append("stylus");
  if (any(trace.strokes, has_buttons)) names.append("buttons");
  if (!trace.air.empty()) names.append("air");
  if (any(trace.air, has_stylus)) names.append("air_stylus");
  if (any(trace.air, has_buttons)) names.append("air_buttons");
  if (trace.selector != 0) names.append("selector");
  return py::module_::import("calligraphy._struct").attr("represented")(self, names);
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
      .def(py::init(&trace_of), "character"_a, "strokes"_a, "set"_a = "unnamed", "em"_a = 1000.0, py::kw_only(),
           "stylus"_a = Lists(), "buttons"_a = Lists(), "air"_a = Lists(), "air_stylus"_a = Lists(),
           "air_buttons"_a = Lists(), "selector"_a = "")
      .def_readonly("character", &PenTrace::character)
      .def_property_readonly(
          "selector",
          [](const PenTrace& self) { return self.selector == 0 ? std::string() : encode_utf8(self.selector); },
          "variation selector after the character, which asks for one of its forms; empty: none")
      .def_property_readonly("strokes", &places_of<&PenTrace::strokes>,
                             "one array (n, 3) per pen-down, copied: x, y [em], time [s]")
      .def_property_readonly("stylus", &stylus_of<&PenTrace::strokes>,
                             "what the pen sensed besides: one array (n, 6) per pen-down, copied, whose columns are "
                             "stylus_columns; NaN where it is not known")
      .def_property_readonly("buttons", &buttons_of<&PenTrace::strokes>,
                             "one array (n,) of integers per pen-down, copied: the bits of tip_button, barrel_button "
                             "and eraser_button; -1 where they are not known")
      .def_property_readonly("air", &places_of<&PenTrace::air>, "+ Arrays as in `strokes`.")
      .def_property_readonly("air_stylus", &stylus_of<&PenTrace::air>, "as `stylus`, of the pen in the air")
      .def_property_readonly("air_buttons", &buttons_of<&PenTrace::air>, "as `buttons`, of the pen in the air")
      .def("__repr__", &represented)
      .def_readonly("set", &PenTrace::set)
      .def_readonly("em", &PenTrace::em);
  py::list columns;
  each_field<StylusState>([&](const auto& field) { columns.append(field.name); });
  module.attr("stylus_columns") = py::tuple(columns);
  module.attr("tip_button") = tip_button;
  module.attr("barrel_button") = barrel_button;
  module.attr("eraser_button") = eraser_button;
  add_types<StylusState>(module);
  module.def("set_tilt", &set_tilt, "stylus"_a, "tilt_x"_a, "tilt_y"_a);
  module.def("read_pen_traces",
             from_file<std::vector<PenTrace>, std::string>(&read_pen_traces, &read_pen_traces, CutOff::refused),
             "path"_a, "+ The file may be compressed by gzip.");
  module.def("write_pen_traces", to_file<Gzip::by_name>(&write_pen_traces), "path"_a, "traces"_a, "notice"_a = "",
             "+ Atomically, compressed if the name ends in .gz. Raises FileError.");

  add_types<YAxis, InkImport>(module);
  module.def("import_ink", &ink_of, "source"_a, "text"_a = "", "y_axis"_a = py::none(), "set"_a = "", "name"_a = "",
             "+ `source` is a path, of a file that may be compressed by gzip, or the content of a file. `name` is by "
             "default the path. `text`, `y_axis` and `set` are the fields of InkOptions (docs/pen-traces.md).");
  module.def("recognise_y_axis",
             released(+[](const std::vector<PenTrace>& traces) { return recognise_y_axis(traces); }), "traces"_a);
  module.def("turn_over", &turned_over, "trace"_a, "+ Returns the new trace: traces are immutable.");

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
