// Pages, writers, recordings, scores, imports and pictures.
#include <optional>

#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/pictures/picture.hpp>
#include <calligraphy/practice/hint_text.hpp>
#include <calligraphy/practice/mean_interval.hpp>
#include <calligraphy/practice/recording_file.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// The structs of a structured array with their columns. @throws ValueError naming the argument
template <class Row>
std::vector<Row> structs_of(const ArrayLike& given, const char* name) {
  const py::array rows = py::module_::import("numpy").attr("asarray")(given, dtype_of_struct<Row>());
  if (rows.ndim() != 1) refuse_shape(name, "(n,)", rows);
  std::vector<Row> result(static_cast<std::size_t>(rows.size()));
  for (std::size_t i = 0; i < result.size(); ++i) {
    std::memcpy(static_cast<void*>(&result[i]), rows.data(static_cast<py::ssize_t>(i)), sizeof(Row));
  }
  return result;
}

/// A recording from structured arrays.
Recording recording_of(double rate, const ArrayLike& samples, std::uint32_t page, std::string law,
                       const ArrayLike& inputs, std::optional<RecordingSetup> setup) {
  Recording result{rate,           structs_of<RecordedSample>(samples, "samples"), page,
                   std::move(law), structs_of<DeviceState>(inputs, "inputs"),      std::move(setup)};
  if (!(std::isfinite(rate) && rate > 0.0))
    throw ValueError("rate: expected a finite number above 0, got " + std::to_string(rate));
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    const RecordedSample& sample = result.samples[i];
    if (sample.state > InteractionState::writing || sample.status > TickStatus::bad_law) {
      throw ValueError(formatted("samples[{}]: state {}, status {}: no such state or status", i,
                                 static_cast<int>(sample.state), static_cast<int>(sample.status)));
    }
  }
  if (!result.inputs.empty() && result.inputs.size() != result.samples.size()) {
    throw ValueError(formatted("inputs: expected one for each of {} samples, or none, got {}", result.samples.size(),
                               result.inputs.size()));
  }
  for (std::size_t i = 0; i < result.inputs.size(); ++i) {
    const DeviceState& input = result.inputs[i];
    if (input.status > DeviceStatus::fault || input.fault > DeviceFault::device_error) {
      throw ValueError(formatted("inputs[{}]: status {}, fault {}: no such status or fault", i,
                                 static_cast<int>(input.status), static_cast<int>(input.fault)));
    }
  }
  return result;
}

/// A read-only view of one of the lists of a recording.
template <auto member>
py::array rows_of(const py::object& self) {
  const auto& rows = self.cast<const Recording&>().*member;
  py::array result(dtype_of_struct<typename std::remove_cvref_t<decltype(rows)>::value_type>(), rows.size(),
                   rows.data(), self);
  result.attr("flags").attr("writeable") = false;
  return result;
}

/// The set-up as a file has it, without a law that is not the library's.
std::optional<RecordingSetup> setup_of(const Recording& recording) {
  std::optional<RecordingSetup> setup = recording.setup;
  if (setup && setup->has_own_law) setup->renderer.guidance.force = GuidanceOptions().force;
  return setup;
}

/// Without the set-up, which is long.
py::object represented_recording(const py::object& self) {
  const py::tuple names = py::make_tuple("rate", "samples", "page", "law", "inputs");
  const py::str text = py::module_::import("calligraphy._struct").attr("represented")(self, names);
  if (!self.cast<const Recording&>().setup) return text;
  return py::str("{}, setup=RecordingSetup(...))").format(text[py::slice(0, -1, 1)]);
}

/// Runs a session without the GIL; two additional last arguments are called with the progress, and have the path of a
/// file that stores the recording as it grows.
template <class... Arguments>
auto reporting(Recording (*function)(Arguments...)) {
  return [function](std::remove_cvref_t<Arguments>... given, const Progress& progress,
                    std::optional<std::filesystem::path> path) {
    Store store(std::move(path));
    const auto report = [&](auto& value) {
      if constexpr (requires { value.progress; }) {
        value.progress = interruptible(progress);
        if (store) value.keep = [&store](const Recording& recording) { store.take(recording); };
      }
    };
    (report(given), ...);
    Recording recording = released(function)(given...);
    store.finish();
    return recording;
  };
}

}  // namespace

void add_practice(py::module_& module) {
  add_types<PageLayout, PracticePage, MeanInterval, InkDetail, StrokeStyle, RecordingSetup>(module);
  add_struct<WriterSkill>(module)
      .def_static("novice", &WriterSkill::novice)
      .def_static("skilled", &WriterSkill::skilled);
  add_struct<SessionOptions>(module);
  add_types<StrokeScore, PenDownScore, MeanScore>(module);
  add_struct<CharacterScore>(module)
      .def("order_mistakes", &CharacterScore::order_mistakes)
      .def("direction_mistakes", &CharacterScore::direction_mistakes);

  module.attr("sample_dtype") = dtype_of_struct<RecordedSample>();
  module.attr("input_dtype") = dtype_of_struct<DeviceState>();
  py::class_<Recording>(module, "Recording")
      .def(py::init(&recording_of), "rate"_a, "samples"_a, "page"_a = 0, "law"_a = "", "inputs"_a = py::list(),
           "setup"_a = py::none())
      .def_readonly("rate", &Recording::rate)
      .def_readonly("page", &Recording::page)
      .def_readonly("law", &Recording::law)
      .def_property_readonly("samples", &rows_of<&Recording::samples>,
                             "A structured array (n,), a read-only view of the recording (sample_dtype).")
      .def_property_readonly("inputs", &rows_of<&Recording::inputs>,
                             "+ A structured array (n,) or (0,), a read-only view of the recording (input_dtype); "
                             "`force` is that of the device, `tip_force` that of the pen on the paper.")
      .def_property_readonly("setup", &setup_of,
                             "a RecordingSetup, copied, or None if it is not known; of a law with has_own_law there is "
                             "only the name, in `law`")
      .def("__repr__", &represented_recording)
      .def("__len__", [](const Recording& self) { return self.samples.size(); });
  py::class_<StoredRecording>(module, "StoredRecording")
      .def_readonly("recording", &StoredRecording::recording)
      .def_readonly("is_complete", &StoredRecording::is_complete)
      .def_readonly("has_same_forces", &StoredRecording::has_same_forces);
  module.def("write_recording", to_file<Gzip::by_name>(&write_recording), "path"_a, "recording"_a,
             "+ Atomically, compressed if the name ends in .gz. Raises FileError.");
  module.def("read_recording",
             from_file<StoredRecording, std::filesystem::path>(&read_recording, &read_recording, CutOff::accepted),
             "path"_a,
             "Reads the file of a recording, compressed by gzip or not, whole or cut off anywhere after the first "
             "tick. Raises FileError when it cannot be opened, FormatError naming the file and, of a plain text, the line.");
  module.def("write_ticks", to_file<Gzip::by_name>(&write_ticks), "path"_a, "recording"_a,
             "+ Atomically, compressed if the name ends in .gz. Raises FileError.");
  module.def("replayed", released(&replayed), "recording"_a);
  module.def("device_states", released(&device_states), "recording"_a, "mapping"_a);

  module.def("workspace_layout", &workspace_layout, "device"_a, "mapping"_a = MotionMapping{});
  module.def(
      "lay_out",
      [](const std::vector<Character>& characters, const PageLayout& layout) { return lay_out(characters, layout); },
      "characters"_a, "layout"_a = PageLayout{});

  module.def("write_page", reporting(&write_page), "page"_a, "options"_a, "progress"_a = py::none(),
             "store"_a = py::none(),
             "+ progress(share) is called from time to time. `store` is the path of a file for read_recording(), "
             "compressed if the name ends in .gz, which is written while the recording is made: until the call returns "
             "there is PATH.part with everything up to a quarter of a second before. An existing file is refused: "
             "FileError.");
  module.def("follow_trace", reporting(&follow_trace), "page"_a, "trace"_a, "options"_a, "progress"_a = py::none(),
             "store"_a = py::none(), "+ See write_page for progress and store.");
  module.def(
      "replay_page",
      [](const PracticePage& page, ReplayDevice& device, const SessionOptions& options, const Progress& progress,
         std::optional<std::filesystem::path> path) {
        const AtWork at_work({AtWork::User::call}, &device);
        return reporting(+[](const PracticePage& on, ReplayDevice* const& of, const SessionOptions& chosen) {
          return replay_page(on, *of, chosen);
        })(page, &device, options, progress, std::move(path));
      },
      "page"_a, "device"_a, "options"_a, "progress"_a = py::none(), "store"_a = py::none(),
      "+ See write_page for progress and store.");
  module.def(
      "run_session", reporting(&run_session), "page"_a, "options"_a, "motion"_a, "progress"_a = py::none(),
      "store"_a = py::none(),
      "+ motion(tick, seconds) takes a HapticTick and the period of a tick [s], and returns an Intention in page "
      "coordinates, or None to end. See write_page for progress and store.");

  module.def(
      "hint_text",
      [](WritingHint hint, const ArrayLike& to_start, const std::string& language) {
        return hint_text(hint, point(to_start, "to_start"), Language(language));
      },
      "hint"_a, "to_start"_a, "language"_a = "en");

  module.def("page_id", &page_id, "page"_a);
  module.def("score_page", released(&score_page), "page"_a, "recording"_a, "tolerances"_a = JudgeTolerances());
  module.def(
      "mean_score", [](const std::vector<CharacterScore>& scores) { return mean_score(scores); }, "scores"_a);
  module.def(
      "character_picture",
      released(+[](const PracticePage& page, const Recording& recording, int index, const std::string& title,
                   StrokeStyle style, const std::string& language,
                   const std::optional<std::vector<CharacterScore>>& scores) {
        const std::vector<CharacterScore> known = scores ? *scores : score_page(page, recording);
        return character_picture(page, recording, known, index, title, style, Language(language));
      }),
      "page"_a, "recording"_a, "index"_a = 0, "title"_a = "", "style"_a = StrokeStyle::ink, "language"_a = "en",
      "scores"_a = py::none(), "+ `scores` are those of score_page(), by default with its default tolerances.");
  module.def(
      "page_picture",
      released(+[](const PracticePage& page, const Recording& recording, const std::string& title, StrokeStyle style,
                   const std::string& language, const std::optional<std::vector<CharacterScore>>& scores) {
        const std::vector<CharacterScore> known = scores ? *scores : score_page(page, recording);
        return page_picture(page, recording, known, title, style, Language(language));
      }),
      "page"_a, "recording"_a, "title"_a = "", "style"_a = StrokeStyle::ink, "language"_a = "en",
      "scores"_a = py::none(), "+ See character_picture for scores.");

  module.def(
      "mean_interval",
      [](const ArrayLike& values, const std::vector<std::uint64_t>& draws) {
        const Doubles numbers = doubles(values, "values");
        if (static_cast<std::size_t>(numbers.size()) != draws.size()) {
          throw ValueError(
              formatted("draws: expected one for each of {} values, got {}", numbers.size(), draws.size()));
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
         bool report, const Progress& progress, InkDetail ink, bool corrections,
         bool strict) {
        // Optional, because an empty C++ path would become "." in Python.
        const ImportOptions options = {
            letters.value_or(""), alternates, ideographs_only, corrections, ink, only, date, threads, strict, report, {},
            interruptible(progress)};
        ImportResult imported = released(&import_characters)(source, options);
        return py::typing::Tuple<CharacterList, py::dict>(
            py::make_tuple(std::move(imported.list), in_tables("import_report", as_dict(imported.report))));
      },
      "source"_a, "letters"_a = py::none(), "only"_a = std::u32string(), "alternates"_a = false,
      "ideographs_only"_a = true, "date"_a = "", "threads"_a = 0, "report"_a = false, "progress"_a = py::none(),
      "ink"_a = InkDetail::full, "corrections"_a = true, "strict"_a = false,
      "+ Returns a CharacterList and a report (docs/import.md): a dict, with the tables `within`, `worst` and "
      "`measures` as structured arrays, `ids_used` by id, `crossings` in the source and kept, `ink`, for each "
      "stroke intersection over union with its outline, and the files that were `skipped`, with the reason; `unusable` "
      "has those of them that are malformed, for which `strict` raises FormatError.");
}

}  // namespace calligraphy::python
