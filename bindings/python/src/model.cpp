// The model room: characters, typical strokes, character sets.
#include <filesystem>
#include <sstream>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/doubtful_strokes.hpp>
#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/set_encoding.hpp>

#include "enumeration.hpp"
#include "record.hpp"
#include "rooms.hpp"

namespace calligraphy::python {
namespace {

using Release = py::call_guard<py::gil_scoped_release>;

/// (n, 2), read only, for as long as the owner lives.
py::array_t<double> view_of(std::span<const Point> points, py::handle owner) {
  return view(points.empty() ? nullptr : points.front().data(), {static_cast<py::ssize_t>(points.size()), 2}, owner,
              false);
}
py::array_t<double> view_of(std::span<const double> values, py::handle owner) {
  return view(values.data(), {static_cast<py::ssize_t>(values.size())}, owner, false);
}

py::array_t<int> view_of(const std::vector<int>& values, py::handle owner) {
  py::array_t<int> result(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  result.attr("flags").attr("writeable") = false;
  return result;
}

std::string text_of(const CharacterList& list) {
  std::ostringstream out;
  write_characters(out, list);
  return out.str();
}

CharacterList list_of(const std::string& text) {
  std::istringstream in(text);
  return read_characters(in, "characters");
}

void add_typical_strokes(py::module_& module) {
  py::class_<TypicalStroke>(module, "TypicalStroke", "One of the 39 typical strokes (Wang 2006, Fig. 7). Read only.")
      .def_readonly("id", &TypicalStroke::id, "1 to 39")
      .def_readonly("name", &TypicalStroke::name, "Chinese name")
      .def_readonly("pinyin", &TypicalStroke::pinyin)
      .def_readonly("code", &TypicalStroke::code, "letter code as used for CJK strokes")
      .def_readonly("unicode", &TypicalStroke::unicode, "code point of the CJK stroke in hexadecimal")
      .def_readonly("elements", &TypicalStroke::elements, "'L' (line) or 'C' (curve) per element, in writing order")
      .def_readonly("joints", &TypicalStroke::joints, "'c' (corner) or 's' (smooth) per inner feature point")
      .def_readonly("example", &TypicalStroke::example, "characters that contain it")
      .def_property_readonly(
          "shape",
          [](const py::object& self) {
            const auto shape = self.cast<const TypicalStroke&>().shape;
            return view(shape.data()->data(), {static_cast<py::ssize_t>(shape.size()), 2}, self, false);
          },
          "typical control points, cubic curves, (n, 2) [em]")
      .def("control_point_count", &TypicalStroke::control_point_count, py::arg("curve_degree") = 3)
      .def("feature_point_count", &TypicalStroke::feature_point_count)
      .def("feature_points", &TypicalStroke::feature_points, py::arg("curve_degree") = 3,
           "Indices of the feature points among the control points.")
      .def(py::init([](int id) { return typical_stroke(id); }), py::arg("id"),
           "The typical stroke of this id, 1 to 39.")
      .def("__reduce__",  // by its type: functions of pybind11 2.10 cannot be pickled
           [](const py::object& self) { return py::make_tuple(py::type::of(self), py::make_tuple(self.attr("id"))); })
      .def("__repr__", [](const TypicalStroke& self) {
        return "TypicalStroke(" + std::to_string(self.id) + ", " + std::string(self.name) + ")";
      });
  module.def(
      "typical_strokes",
      [] {
        py::list result;
        for (const TypicalStroke& stroke : typical_strokes()) {
          result.append(py::cast(&stroke, py::return_value_policy::reference));
        }
        return result;
      },
      "All typical strokes, in order of id.");
  module.def("typical_stroke", &typical_stroke, py::return_value_policy::reference, py::arg("id"),
             "The typical stroke with this id, 1 to 39.");
}

/// Views, each of which keeps the character alive.
std::vector<py::object> strokes_of(const py::object& character) {
  if (!py::isinstance<Character>(character)) {
    throw py::type_error("character: a calligraphy.Character is expected, not " +
                         py::str(py::type::handle_of(character).attr("__name__")).cast<std::string>());
  }
  std::vector<py::object> result;
  for (const Stroke& stroke : strokes(character.cast<const Character&>())) {
    result.push_back(py::cast(stroke));
    py::detail::keep_alive_impl(result.back(), character);
  }
  return result;
}

void add_characters(py::module_& module) {
  py::class_<StrokeInput>(module, "StrokeInput",
                          "A stroke as input to make_character: typical stroke id, control points (n, 2) [em], and an "
                          "attraction factor per feature point (none: all 1).")
      .def(py::init([](int id, const ArrayLike& control_points, const std::vector<double>& factors) {
             return StrokeInput{id, points(control_points, "control_points"), factors};
           }),
           py::arg("id"), py::arg("control_points"), py::arg("attraction_factors") = std::vector<double>{})
      .def_readwrite("id", &StrokeInput::id)
      .def_property(
          "control_points", [](const StrokeInput& self) { return array_of_points(self.control_points); },
          [](StrokeInput& self, const ArrayLike& value) { self.control_points = points(value, "control_points"); },
          "(n, 2), copied [em]")
      .def_readwrite("attraction_factors", &StrokeInput::attraction_factors, "copied [1]")
      .def("__reduce__", [](const py::object& self) {
        return py::make_tuple(py::type::of(self), py::make_tuple(self.attr("id"), self.attr("control_points"),
                                                                 self.attr("attraction_factors")));
      });

  py::class_<Stroke>(module, "Stroke", "One stroke of a character: a view that keeps the character alive.")
      .def_property_readonly(
          "type", [](const Stroke& self) { return self.type; }, py::return_value_policy::reference)
      .def_readonly("curve_degree", &Stroke::curve_degree)
      .def_property_readonly(
          "control_points",
          [](const py::object& self) { return view_of(self.cast<const Stroke&>().control_points, self); },
          "(n, 2), read only [em]")
      .def_property_readonly(
          "attraction_factors",
          [](const py::object& self) { return view_of(self.cast<const Stroke&>().attraction_factors, self); },
          "one per feature point, read only [1]")
      .def("__repr__", [](const Stroke& self) {
        return told("Stroke({}, {} control points)", self.type->name, self.control_points.size());
      });

  py::class_<Problem>(module, "Problem", "What a validator has to say.")
      .def_readonly("stroke", &Problem::stroke, "counted from 1; 0: the character as a whole")
      .def_readonly("what", &Problem::what)
      .def("__repr__",
           [](const Problem& self) { return "Problem(" + std::to_string(self.stroke) + ", '" + self.what + "')"; });

  py::class_<Character> character(
      module, "Character",
      "A character: shape, order and feel. Made by make_character, read from a set or a file; it does "
      "not change. Frame: em square, y up.");
  compare(character, [](py::handle self, py::handle other) {
    const auto &a = self.cast<const Character&>(), &b = other.cast<const Character&>();
    return a.code == b.code && a.order == b.order && a.curve_degree == b.curve_degree &&
           a.structure.control_points == b.structure.control_points && a.sequence.stroke_ids == b.sequence.stroke_ids &&
           a.sequence.feature_points == b.sequence.feature_points &&
           a.physics.attraction_factors == b.physics.attraction_factors;
  });
  character.def_readonly("code", &Character::code, "the character, a str of length 1")
      .def_readonly("order", &Character::order, "name of an alternate stroke order; empty for the standard one")
      .def_readonly("curve_degree", &Character::curve_degree, "3, or 4 as eq. (1) prints")
      .def_property_readonly("stroke_count", &Character::stroke_count)
      .def_property_readonly(
          "control_points",
          [](const py::object& self) {
            return view_of(std::span<const Point>(self.cast<const Character&>().structure.control_points), self);
          },
          "of all strokes, one after the other, (n, 2), read only [em]")
      .def_property_readonly(
          "stroke_ids",
          [](const py::object& self) { return view_of(self.cast<const Character&>().sequence.stroke_ids, self); },
          "typical stroke ids in writing order, read only")
      .def_property_readonly(
          "feature_points",
          [](const py::object& self) { return view_of(self.cast<const Character&>().sequence.feature_points, self); },
          "indices into control_points in writing order, read only")
      .def_property_readonly(
          "attraction_factors",
          [](const py::object& self) {
            return view_of(std::span<const double>(self.cast<const Character&>().physics.attraction_factors), self);
          },
          "one per feature point, read only [1]")
      .def("strokes", &strokes_of, "The strokes in writing order.")
      .def("__repr__",
           [](const Character& self) {
             return "Character(" + encode_utf8(self.code) + ", " + std::to_string(self.stroke_count()) + " strokes)";
           })
      .def(py::pickle(
          [](const Character& self) {
            return py::make_tuple(self.code, self.order, self.curve_degree,
                                  array_of_points(self.structure.control_points), self.sequence.stroke_ids,
                                  self.sequence.feature_points, self.physics.attraction_factors);
          },
          [](const py::tuple& state) {
            Character result;
            result.code = state[0].cast<char32_t>();
            result.order = state[1].cast<std::string>();
            result.curve_degree = state[2].cast<int>();
            result.structure.control_points = points(state[3], "control_points");
            result.sequence = {state[4].cast<std::vector<int>>(), state[5].cast<std::vector<int>>()};
            result.physics.attraction_factors = state[6].cast<std::vector<double>>();
            if (!validate(result).empty())
              throw ValueError("a pickled character is not valid: " + validate(result)[0].what);
            return result;
          }));

  module.def("strokes", &strokes_of, py::arg("character"), "The strokes in writing order.");
  module.def(
      "make_character",
      [](char32_t code, const std::vector<StrokeInput>& inputs, int curve_degree) {
        return make_character(code, inputs, curve_degree);
      },
      py::arg("code"), py::arg("strokes"), py::arg("curve_degree") = 3,
      "Builds a character from its strokes in writing order; raises InvalidValue naming the stroke.");
  module.def("with_quartic_curves", &with_quartic_curves, py::arg("character"),
             "The same shape with quartic curves, as eq. (1) prints.");
  module.def("validate", py::overload_cast<const Character&>(&validate), py::arg("character"),
             "Everything that makes a character unusable; empty when it is valid.");
  module.def("paper_example", &paper_example, py::return_value_policy::copy, "The character of Table 3.");

  Enumeration<DoubtKind>(module, "DoubtKind")
      .value("type", DoubtKind::type)
      .value("direction", DoubtKind::direction)
      .value("overlap", DoubtKind::overlap)
      .value("outside", DoubtKind::outside);
  py::class_<Doubt>(module, "Doubt", "A stroke that is valid and yet looks wrong.")
      .def_readonly("stroke", &Doubt::stroke, "from 1")
      .def_readonly("kind", &Doubt::kind)
      .def_readonly("what", &Doubt::what)
      .def("__repr__", [](const Doubt& self) { return told("Doubt({}, {!r})", self.stroke, self.what); });
  module.def("doubtful_strokes", &doubtful_strokes, py::arg("character"), Release(),
             "Strokes of a valid character that look wrong.");

  Enumeration<DrawnWith>(module, "DrawnWith", "What a path was drawn with, and so what of it a pen does not write.")
      .value("brush", DrawnWith::brush)
      .value("textbook_pen", DrawnWith::textbook_pen)
      .value("pen", DrawnWith::pen);
  py::class_<FittedStroke>(module, "FittedStroke", "A stroke recognised and fitted.")
      .def_readonly("stroke", &FittedStroke::stroke)
      .def_readonly("error", &FittedStroke::error, "largest distance between path and stroke, both ways [em]")
      .def_readonly("median_error", &FittedStroke::median_error, "the same where the path keeps its shoulders [em]")
      .def("__repr__", [](const FittedStroke& self) {
        return told("FittedStroke({}, error {:.3g} em)", typical_stroke(self.stroke.id).name, self.error);
      });
  module.def(
      "fit_stroke",
      [](const ArrayLike& path, DrawnWith drawn_with, const std::vector<int>& ids) {
        const std::vector<Point> way = points(path, "path");
        const py::gil_scoped_release release;
        return fit_stroke(way, {drawn_with, ids});
      },
      py::arg("path"), py::arg("drawn_with") = DrawnWith::brush, py::arg("ids") = std::vector<int>{},
      "Finds the typical stroke and its control points for a pen path (n, 2) [em], y up.");
}

void add_sets(py::module_& module) {
  Record<Provenance>(module, "Provenance", "Where characters come from, and how they may be used.")
      .field("source", &Provenance::source, "who drew them, one line")
      .field("licence", &Provenance::licence, "under which terms they may be used, one line")
      .field("attribution", &Provenance::attribution, "whom to name, one line")
      .field("licence_text", &Provenance::licence_text, "the licence itself, where it must go along");

  py::class_<CharacterList>(module, "CharacterList", "Characters in memory, with where they come from.")
      .def(py::init([](std::vector<Character> characters, Provenance provenance) {
             return CharacterList{std::move(provenance), std::move(characters)};
           }),
           py::arg("characters") = std::vector<Character>{}, py::arg("provenance") = Provenance{})
      .def_readwrite("provenance", &CharacterList::provenance, "Provenance")
      .def_property(
          "characters", [](const CharacterList& self) { return std::vector<Character>(self.characters); },
          [](CharacterList& self, std::vector<Character> value) { self.characters = std::move(value); }, "copied")
      .def(
          "find",
          [](const CharacterList& self, char32_t code, const std::string& order) -> std::optional<Character> {
            const Character* const found = self.find(code, order);
            if (found == nullptr) return std::nullopt;
            return *found;
          },
          py::arg("code"), py::arg("order") = "",
          "The character in the standard order or the one of this name, or None.")
      .def("__len__", [](const CharacterList& self) { return self.characters.size(); })
      .def("__iter__",
           [](const CharacterList& self) -> py::iterator {
             return py::iter(py::cast(std::vector<Character>(self.characters)));  // a copy, as a list may be changed
           })
      .def(
          "__getitem__",
          [](const CharacterList& self, char32_t code) {
            const Character* const found = self.find(code);
            if (found == nullptr) throw py::key_error(encode_utf8(code));
            return *found;
          },
          py::arg("code"))
      .def(
          "__contains__", [](const CharacterList& self, char32_t code) { return self.find(code) != nullptr; },
          py::arg("code"))
      .def("__repr__",
           [](const CharacterList& self) {
             return told("CharacterList({} characters of {!r})", self.characters.size(), self.provenance.source);
           })
      .def(py::pickle([](const CharacterList& self) { return py::str(text_of(self)); },
                      [](const py::str& text) { return list_of(text.cast<std::string>()); }));
  module.def("built_in_characters", &built_in_characters, py::return_value_policy::copy,
             "The characters drawn for this library, at least one for every typical stroke.");
  module.def(
      "read_characters", [](const std::filesystem::path& path) { return read_characters(path.string()); },
      py::arg("path"), Release(), "Reads the text format of docs/character-format.md.");
  module.def(
      "write_characters",
      [](const std::filesystem::path& path, const CharacterList& list) { write_file(path, text_of(list)); },
      py::arg("path"), py::arg("characters"), Release(), "Writes the text format.");

  Enumeration<CoordinatePrecision>(module, "CoordinatePrecision", "How finely a set file keeps control points.")
      .value("coarse", CoordinatePrecision::coarse, "1/200 em")
      .value("standard", CoordinatePrecision::standard, "1/800 em")
      .value("fine", CoordinatePrecision::fine, "1/12800 em")
      .value("exact", CoordinatePrecision::exact, "doubles as they are");
  module.def(
      "encode_character_set",
      [](const CharacterList& list, CoordinatePrecision precision) {
        std::vector<std::byte> bytes;
        {
          const py::gil_scoped_release release;
          bytes = encode_character_set(list, precision);
        }
        return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      },
      py::arg("characters"), py::arg("precision") = CoordinatePrecision::standard,
      "The set as the bytes of a set file.");

  py::class_<StoredCharacter>(module, "StoredCharacter", "A character of a set, decoded when it is asked for.")
      .def_property_readonly("code", &StoredCharacter::code)
      .def_property_readonly("order", [](const StoredCharacter& self) { return std::string(self.order()); })
      .def_property_readonly("curve_degree", &StoredCharacter::curve_degree)
      .def_property_readonly("stroke_count", &StoredCharacter::stroke_count, "0 where it is kept is damaged")
      .def_property_readonly("provenance", [](const StoredCharacter& self) { return self.provenance(); })
      .def("stroke_id", &StoredCharacter::stroke_id, py::arg("index"))
      .def("character", &StoredCharacter::character, "Decodes it; raises FormatError when it is damaged.")
      .def("__repr__", [](const StoredCharacter& self) {
        return told("StoredCharacter({}, {} strokes)", encode_utf8(self.code()), self.stroke_count());
      });

  py::class_<CharacterSet>(module, "CharacterSet",
                           "A set of characters: a mapped file, characters in memory, or several sets one over the "
                           "other. It never changes; any number of threads may use it.")
      .def(py::init<>())
      .def(py::init<const CharacterList&>(), py::arg("characters"), Release())
      .def_static(
          "open", [](const std::filesystem::path& path) { return CharacterSet::open(path.string()); }, py::arg("path"),
          Release(), "A set file, of which only the index is read now, or a file in the text format.")
      .def_static(
          "from_bytes",
          [](const py::bytes& bytes, const std::string& name) {
            const std::string_view view = bytes;
            const auto* const first = reinterpret_cast<const std::byte*>(view.data());
            return CharacterSet::from_bytes({first, first + view.size()}, name);
          },
          py::arg("bytes"), py::arg("name") = "bytes")
      .def_static(
          "layered", [](const std::vector<CharacterSet>& sets) { return CharacterSet::layered(sets); }, py::arg("sets"),
          "One set over the other: of what several have, the first one's is found.")
      .def(
          "find",
          [](const CharacterSet& self, char32_t code, const std::string& order) { return self.find(code, order); },
          py::arg("code"), py::arg("order") = "", "The character, or None.")
      .def(
          "__getitem__",
          [](const CharacterSet& self, char32_t code) {
            const std::optional<StoredCharacter> found = self.find(code);
            if (!found) throw py::key_error(encode_utf8(code));
            return found->character();
          },
          py::arg("code"), "The character, decoded.")
      .def(
          "__contains__", [](const CharacterSet& self, char32_t code) { return self.find(code).has_value(); },
          py::arg("code"))
      .def("__len__", &CharacterSet::size)
      .def(
          "__iter__", [](const CharacterSet& self) { return py::make_iterator(self.begin(), self.end()); },
          py::keep_alive<0, 1>(), "Every character once, as StoredCharacter, by rising code point.")
      .def("orders", &CharacterSet::orders, py::arg("code"))
      .def("bytes", &CharacterSet::bytes)
      .def("provenances", &CharacterSet::provenances)
      .def("coordinate_error", &CharacterSet::coordinate_error, "[em]")
      .def("list", &CharacterSet::list, Release(), "Every character in every order, decoded.")
      .def("check", &CharacterSet::check, Release(), "Decodes everything; raises FormatError naming what is damaged.")
      .def("__repr__", [](const CharacterSet& self) { return told("CharacterSet({} characters)", self.size()); });
}

}  // namespace

void add_model(py::module_& module) {
  add_typical_strokes(module);
  add_characters(module);
  add_sets(module);
}

}  // namespace calligraphy::python
