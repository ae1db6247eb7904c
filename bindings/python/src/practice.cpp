// Pages, writers, recordings, scores, imports and pictures.
#include <optional>
#include <variant>

#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/pictures/picture.hpp>
#include <calligraphy/practice/dtw_distance.hpp>
#include <calligraphy/practice/mean_interval.hpp>
#include <calligraphy/practice/pen_kinematics.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/practice/stroke_matching.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// A recording from a structured array with these columns.
Recording recording_of(double rate, const ArrayLike& samples, std::uint32_t page, std::string law) {
  const py::array rows = py::module_::import("numpy").attr("asarray")(samples, dtype_of_struct<RecordedSample>());
  if (rows.ndim() != 1) throw ValueError("samples: expected shape (n,), got " + shape_of(rows));
  if (!(std::isfinite(rate) && rate > 0.0))
    throw ValueError("rate: expected a finite number above 0, got " + std::to_string(rate));
  Recording result{rate, std::vector<RecordedSample>(static_cast<std::size_t>(rows.size())), page, std::move(law)};
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    RecordedSample& sample = result.samples[i];
    std::memcpy(static_cast<void*>(&sample), rows.data(static_cast<py::ssize_t>(i)), sizeof sample);
    if (sample.state > InteractionState::writing || sample.status > TickStatus::bad_law) {
      throw ValueError(told("samples[{}]: state {}, status {}: no such state or status", i,
                            static_cast<int>(sample.state), static_cast<int>(sample.status)));
    }
  }
  return result;
}

py::array samples_of(const py::object& self) {
  const auto& samples = self.cast<const Recording&>().samples;
  py::array result(dtype_of_struct<RecordedSample>(), samples.size(), samples.data(), self);
  result.attr("flags").attr("writeable") = false;
  return result;
}

/// The function without the GIL; its options report the progress to an additional last argument.
template <class Result, class... Arguments>
auto reporting(Result (*function)(Arguments...)) {
  return [function](std::remove_cvref_t<Arguments>... given, const Progress& progress) {
    const auto report = [&](auto& value) {
      if constexpr (requires { value.progress; }) value.progress = interruptible(progress);
    };
    (report(given), ...);
    return released(function)(given...);
  };
}

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

MatchResult match_of(const Accepted& character, const std::vector<ArrayLike>& paths, const StrokeTolerances& tolerances,
                     const std::optional<CharacterIndex>& others) {
  const auto* const one = std::get_if<Character>(&character);
  const std::span<const Character> accepted =
      one ? std::span(one, 1) : std::span<const Character>(std::get<std::vector<Character>>(character));
  const std::vector<PenPath> drawn = paths_of(paths);
  const StrokeTolerances chosen = tolerances;
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

void add_practice(py::module_& module) {
  add_types<PageLayout, PracticePage, DrawnStroke, StrokeRemark, RecognisedCharacter, AffineMap, MeanInterval,
            InkDetail, StrokeStyle>(module);
  add_struct<WriterSkill>(module)
      .def_static("novice", &WriterSkill::novice)
      .def_static("skilled", &WriterSkill::skilled);
  add_struct<SessionOptions>(module);
  add_struct<MatchResult>(module).def("count", &MatchResult::count, "kind"_a);
  add_types<PenKinematics, WritingMotion, StrokeScore, PenDownScore, MeanScore>(module);
  add_struct<CharacterScore>(module)
      .def("order_mistakes", &CharacterScore::order_mistakes)
      .def("direction_mistakes", &CharacterScore::direction_mistakes);

  module.attr("sample_dtype") = dtype_of_struct<RecordedSample>();
  py::class_<Recording>(module, "Recording")
      .def(py::init(&recording_of), "rate"_a, "samples"_a, "page"_a = 0, "law"_a = "")
      .def_readonly("rate", &Recording::rate)
      .def_readonly("page", &Recording::page)
      .def_readonly("law", &Recording::law)
      .def_property_readonly("samples", &samples_of,
                             "A structured array (n,), a read-only view of the recording (sample_dtype).")
      .def("__len__", [](const Recording& self) { return self.samples.size(); });
  module.def("write_recording", to_file(&write_recording), "path"_a, "recording"_a, "+ Atomically. Raises FileError.");
  module.def("read_recording", from_file(&read_recording), "path"_a);
  module.def("device_states", released(&device_states), "recording"_a, "mapping"_a);

  module.def("workspace_layout", &workspace_layout, "device"_a, "mapping"_a = MotionMapping{});
  module.def(
      "lay_out",
      [](const std::vector<Character>& characters, const PageLayout& layout) { return lay_out(characters, layout); },
      "characters"_a, "layout"_a = PageLayout{});

  py::class_<PenTrace>(module, "PenTrace")
      .def(py::init(&trace_of), "character"_a, "strokes"_a, "set"_a = "unnamed", "em"_a = 1000.0)
      .def_readonly("character", &PenTrace::character)
      .def_property_readonly("strokes", &pen_downs, "one array (n, 3) per pen-down, copied: x, y [em], time [s]")
      .def_readonly("set", &PenTrace::set)
      .def_readonly("em", &PenTrace::em);
  module.def("read_pen_traces", from_file(&read_pen_traces), "path"_a);
  module.def("write_pen_traces", to_file(&write_pen_traces), "path"_a, "traces"_a, "notice"_a = "",
             "+ Atomically. Raises FileError.");

  module.def("write_page", reporting(&write_page), "page"_a, "options"_a, "progress"_a = py::none(),
             "+ progress(share) is called from time to time.");
  module.def("follow_trace", reporting(&follow_trace), "page"_a, "trace"_a, "options"_a, "progress"_a = py::none(),
             "+ See write_page for progress.");
  module.def(
      "replay_page",
      [](const PracticePage& page, ReplayDevice& device, const SessionOptions& options, const Progress& progress) {
        const AtWork at_work({AtWork::User::call}, &device);
        return reporting(+[](const PracticePage& on, ReplayDevice* const& of, const SessionOptions& chosen) {
          return replay_page(on, *of, chosen);
        })(page, &device, options, progress);
      },
      "page"_a, "device"_a, "options"_a, "progress"_a = py::none(), "+ See write_page for progress.");
  module.def(
      "run_session", reporting(&run_session), "page"_a, "options"_a, "motion"_a, "progress"_a = py::none(),
      "+ motion(tick, seconds) takes a HapticTick and the period of a tick [s], and returns an Intention in page "
      "coordinates, or None to end.");

  module.def("page_id", &page_id, "page"_a);
  module.def("score_page", released(&score_page), "page"_a, "recording"_a, "tolerances"_a = StrokeTolerances());
  module.def(
      "mean_score", [](const std::vector<CharacterScore>& scores) { return mean_score(scores); }, "scores"_a);
  module.def("page_picture", released(&page_picture), "page"_a, "recording"_a, "active"_a = 0, "title"_a = "",
             "style"_a = StrokeStyle::ink);

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
  module.def("match_strokes", &match_of, "character"_a, "paths"_a, "tolerances"_a = StrokeTolerances(),
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

  module.def(
      "mean_interval",
      [](const ArrayLike& values, const std::vector<std::uint64_t>& draws) {
        const Doubles numbers = doubles(values, "values");
        if (static_cast<std::size_t>(numbers.size()) != draws.size()) {
          throw ValueError(told("draws: expected one for each of {} values, got {}", numbers.size(), draws.size()));
        }
        std::vector<DrawnValue> drawn(draws.size());
        for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] = {numbers.data()[i], draws[i]};
        return mean_interval(drawn);
      },
      "values"_a, "draws"_a, "+ values (n,); draws, an integer for each.");

  module.def(
      "import_characters",
      [](const std::filesystem::path& source, const std::optional<std::filesystem::path>& letters,
         const std::u32string& only, bool alternates, bool ideographs_only, const std::string& date, int threads,
         bool report, const Progress& progress, InkDetail ink) {
        // Optional, because an empty C++ path would become "." in Python.
        const ImportOptions options = {
            letters.value_or(""),   alternates, ideographs_only, ink, only, date, threads, report, {},
            interruptible(progress)};
        ImportResult imported = released(&import_characters)(source, options);
        return py::typing::Tuple<CharacterList, py::dict>(
            py::make_tuple(std::move(imported.list), in_tables("import_report", as_dict(imported.report))));
      },
      "source"_a, "letters"_a = py::none(), "only"_a = std::u32string(), "alternates"_a = false,
      "ideographs_only"_a = true, "date"_a = "", "threads"_a = 0, "report"_a = false, "progress"_a = py::none(),
      "ink"_a = InkDetail::full,
      "+ Returns a CharacterList and a report (docs/import.md): a dict, with the tables `within`, `worst` and "
      "`measures` as structured arrays, `ids_used` by id, `crossings` in the source and kept, and `ink`, for each "
      "stroke intersection over union with its outline.");
}

}  // namespace calligraphy::python
