// Characters, typical strokes, character sets.
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/set_encoding.hpp>
#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// Getter of a read-only array, from the path of members that leads to it.
template <class Class, class... Path>
auto array_within(Path... path) {
  return [path...](const py::object& self) { return view_of((self.cast<const Class&>().*....*path), self); };
}

/// Views that keep the character alive.
py::typing::List<Stroke> strokes_of(const py::object& character) {
  py::typing::List<Stroke> result;
  for (const Stroke& stroke : strokes(character.cast<const Character&>())) {
    const py::object view = py::cast(stroke);
    py::detail::keep_alive_impl(view, character);
    result.append(view);
  }
  return result;
}

Character character_of(char32_t code, const std::string& order, int curve_degree, const ArrayLike& control_points,
                       const std::vector<int>& stroke_ids, const std::vector<int>& feature_points,
                       const std::vector<std::string>& elements, const std::vector<double>& factors,
                       const std::vector<StrokeInk>& ink) {
  const std::vector<ElementList> compositions(elements.begin(), elements.end());
  Character result{code,
                   order,
                   curve_degree,
                   {points(control_points, "control_points")},
                   {stroke_ids, feature_points, compositions},
                   {factors, ink}};
  const std::vector<ValidationIssue> problems = validate(result);
  if (!problems.empty()) throw ValueError("stroke " + std::to_string(problems[0].stroke) + ": " + problems[0].what);
  return result;
}

Character decoded(const Character& character) { return character; }
Character decoded(const StoredCharacter& stored) { return stored.character(); }

template <class Characters>
std::optional<Character> find(const Characters& characters, char32_t code, const std::string& order) {
  const auto found = characters.find(code, order);
  return found ? std::optional(decoded(*found)) : std::nullopt;
}
template <class Characters>
Character at(const Characters& characters, char32_t code) {
  if (const std::optional<Character> found = find(characters, code, "")) return *found;
  throw py::key_error(encode_utf8(code));
}

void add_ink(py::module_& module) {
  module.def(
      "ink_knots", [](double length) { return as_numbers(ink_knots(length)); }, "length"_a,
      "Where the knots lie along a drawn out path of this length [em], as shares of it, (8,).");
  module.def(
      "ink_discs",
      [](const ArrayLike& path, const StrokeInk& ink, double spacing) {
        const std::vector<InkDisc> discs = ink_discs(points(path, "path"), ink, spacing);
        Doubles result({static_cast<py::ssize_t>(discs.size()), py::ssize_t{3}});
        double* to = result.mutable_data();
        for (const InkDisc& disc : discs) {
          *to++ = disc.centre.x();
          *to++ = disc.centre.y();
          *to++ = disc.radius;
        }
        return result;
      },
      "path"_a, "ink"_a, "spacing"_a = 0.004,
      "Ink along a path (n, 2) as discs at most `spacing` apart: x, y, radius, (m, 3) [em].");
  module.def(
      "ink_outline",
      [](const Stroke& stroke, double tolerance) { return array_of_points(ink_outline(stroke, tolerance)); },
      "stroke"_a, "tolerance"_a = 5e-4,
      "Outline of a stroke's ink, a polygon to be filled by the nonzero rule, (n, 2) [em]. Raises InvalidValue if the "
      "stroke has none.");
  module.def(
      "ink_outline",
      [](const ArrayLike& path, const StrokeInk& ink, double tolerance) {
        return array_of_points(ink_outline(points(path, "path"), ink, tolerance));
      },
      "path"_a, "ink"_a, "tolerance"_a = 5e-4, "The same along any path (n, 2) [em].");
  module.def("typical_half_width", &typical_half_width, "id"_a, "stroke_count"_a, "length"_a,
             "The usual half-width of a stroke of a kind and length in a character of so many strokes [em].");
  module.def("typical_ink", &typical_ink, "id"_a, "half_width"_a,
             "The typical StrokeInk of a kind of stroke, scaled to a half-width [em].");
  module.def(
      "stroke_polyline",
      [](const Stroke& stroke, double tolerance) { return array_of_points(stroke_polyline(stroke, tolerance)); },
      "stroke"_a, "tolerance"_a = 1e-4,
      "The path of a stroke as a polyline within `tolerance` of it, (n, 2) [em].");
}

}  // namespace

void add_model(py::module_& module) {
  py::class_<TypicalStroke>(module, "TypicalStroke", "One of the 39 typical strokes (Wang 2006, Fig. 7). Read only.")
      .def_readonly("id", &TypicalStroke::id, "1 to 39")
      .def_readonly("name", &TypicalStroke::name, "Chinese name")
      .def_readonly("pinyin", &TypicalStroke::pinyin, "its pronunciation")
      .def_readonly("code", &TypicalStroke::code, "letter code as used for CJK strokes")
      .def_readonly("unicode", &TypicalStroke::unicode, "code point of the CJK stroke in hexadecimal")
      .def_readonly("elements", &TypicalStroke::elements,
                    "its composition: 'L' (line) or 'C' (curve) per element, in writing order")
      .def_readonly("printed_elements", &TypicalStroke::printed_elements,
                    "its composition as the paper counts it, if that differs; otherwise empty")
      .def_readonly("joints", &TypicalStroke::joints, "'c' (corner) or 's' (smooth) per inner feature point")
      .def_readonly("example", &TypicalStroke::example, "characters that contain it")
      .def_property_readonly("shape", array_within<TypicalStroke>(&TypicalStroke::shape),
                             "typical control points of cubic curves, (n, 2) [em]")
      .def("__reduce__",
           [](const TypicalStroke& self) -> py::tuple {
             return py::make_tuple(py::module_::import("calligraphy").attr("typical_stroke"), py::make_tuple(self.id));
           })
      .def("__repr__", [](const TypicalStroke& self) { return told("TypicalStroke({}, {})", self.id, self.name); });
  module.def(
      "typical_strokes",
      [] {
        py::typing::List<TypicalStroke> result;
        for (const TypicalStroke& stroke : typical_strokes()) {
          result.append(py::cast(&stroke, py::return_value_policy::reference));
        }
        return result;
      },
      "All typical strokes, in order of id.");
  module.def("typical_stroke", &typical_stroke, py::return_value_policy::reference, "id"_a,
             "The typical stroke with this id, 1 to 39. Raises InvalidValue for any other id.");

  add_struct<StrokeInk>(
      module, "StrokeInk",
      "What a brush leaves of a stroke: how wide it is along the path, which is drawn out at both ends, and how far its "
      "centre lies to the left of it. Values at eight knots, linear in arc length between them.",
      &StrokeInk::start, "start: by which the path is drawn out before its start [em]", &StrokeInk::end,
      "end: by which it is drawn out beyond its end [em]", &StrokeInk::half_widths, "half_widths: (8,) [em]",
      &StrokeInk::offsets, "offsets: of the centre line, to the left as the stroke is written, (8,) [em]");

  py::class_<StrokeInput>(module, "StrokeInput", "A stroke as input to make_character.")
      .def(py::init([](int id, const ArrayLike& control_points, const std::vector<double>& factors,
                       const std::string& elements, const std::optional<StrokeInk>& ink) {
             return StrokeInput{id, points(control_points, "control_points"), factors, elements, ink};
           }),
           "id"_a, "control_points"_a, "attraction_factors"_a = std::vector<double>{}, "elements"_a = "",
           "ink"_a = py::none())
      .def_readwrite("id", &StrokeInput::id, "id of the typical stroke, 1 to 39")
      .def_property(
          "control_points", [](const StrokeInput& self) { return array_of_points(self.control_points); },
          [](StrokeInput& self, const ArrayLike& value) { self.control_points = points(value, "control_points"); },
          "(n, 2), copied [em]")
      .def_readwrite("attraction_factors", &StrokeInput::attraction_factors,
                     "one per feature point; empty: all 1; copied [1]")
      .def_property(
          "elements", [](const StrokeInput& self) { return self.elements.elements(); },
          [](StrokeInput& self, const std::string& value) { self.elements = value; },
          "composition: 'L' or 'C' for each element of the typical stroke; empty: as there")
      .def_readwrite("ink", &StrokeInput::ink, "StrokeInk, or None; of all strokes of a character or of none; copied")
      .attr("__match_args__") = py::make_tuple("id", "control_points", "attraction_factors", "elements", "ink");

  py::class_<Stroke>(module, "Stroke", "One stroke of a character: a view that keeps the character alive.")
      .def_property_readonly(
          "type", [](const Stroke& self) { return self.type; }, py::return_value_policy::reference, "TypicalStroke")
      .def_readonly("elements", &Stroke::elements, "its composition: 'L' (line) or 'C' (curve) per element")
      .def_readonly("curve_degree", &Stroke::curve_degree, "3, or 4 as eq. (1) prints")
      .def("input", &input_of, "A copy as input to make_character, to be changed.")
      .def_property_readonly("control_points", array_within<Stroke>(&Stroke::control_points), "(n, 2), read only [em]")
      .def_property_readonly("attraction_factors", array_within<Stroke>(&Stroke::attraction_factors),
                             "one per feature point, read only [1]")
      .def_property_readonly(
          "ink", [](const Stroke& self) { return self.ink == nullptr ? std::nullopt : std::optional(*self.ink); },
          "StrokeInk, copied, or None")
      .def("__repr__", [](const Stroke& self) {
        return told("Stroke({}, {} control points)", self.type->name, self.control_points.size());
      });

  add_ink(module);

  py::class_<Character>(module, "Character",
                        "A character: shape, stroke order and feel. Immutable. Made by make_character, or read from a "
                        "file. Frame: em square, y up.")
      .def(py::init(&character_of), "code"_a, "order"_a, "curve_degree"_a, "control_points"_a, "stroke_ids"_a,
           "feature_points"_a, "elements"_a, "attraction_factors"_a, "ink"_a = std::vector<StrokeInk>(),
           "From the fields below; make_character() is simpler.")
      .def_readonly("code", &Character::code, "the character, a str of length 1")
      .def_readonly("order", &Character::order, "name of an alternate stroke order; empty for the standard one")
      .def_readonly("curve_degree", &Character::curve_degree, "3, or 4 as eq. (1) prints")
      .def_property_readonly("stroke_count", &Character::stroke_count, "number of strokes")
      .def_property_readonly("control_points",
                             array_within<Character>(&Character::structure, &StructuralData::control_points),
                             "of all strokes, concatenated, (n, 2), read only [em]")
      .def_property_readonly("stroke_ids", array_within<Character>(&Character::sequence, &SequenceData::stroke_ids),
                             "typical stroke ids in writing order, read only")
      .def_property_readonly("feature_points",
                             array_within<Character>(&Character::sequence, &SequenceData::feature_points),
                             "indices into control_points in writing order, read only")
      .def_property_readonly(
          "elements",
          [](const Character& self) {
            std::vector<std::string_view> elements;
            for (const ElementList composition : self.sequence.elements) elements.push_back(composition.elements());
            return elements;
          },
          "composition of each stroke: 'L' (line) or 'C' (curve) per element; copied")
      .def_property_readonly("attraction_factors",
                             array_within<Character>(&Character::physics, &PhysicalData::attraction_factors),
                             "one per feature point, read only [1]")
      .def_property_readonly(
          "ink", [](const Character& self) { return self.physics.ink; }, "StrokeInk of each stroke, or empty; copied")
      .def("strokes", &strokes_of, "The strokes in writing order.")
      .def("__repr__",
           [](const Character& self) {
             return told("Character({}, {} strokes)", encode_utf8(self.code), self.stroke_count());
           })
      .attr("__match_args__") = py::make_tuple("code", "order", "curve_degree", "control_points", "stroke_ids",
                                               "feature_points", "elements", "attraction_factors", "ink");

  module.def(
      "make_character",
      [](char32_t code, const std::vector<StrokeInput>& inputs, int curve_degree) {
        return make_character(code, inputs, curve_degree);
      },
      "code"_a, "strokes"_a, "curve_degree"_a = 3,
      "Builds a character from its strokes in writing order. Raises InvalidValue naming the stroke.");
  module.def("with_quartic_curves", &with_quartic_curves, "character"_a,
             "The same shape with quartic curves, as eq. (1) prints.");
  module.def("with_typical_ink", &with_typical_ink, "character"_a,
             "The same character with typical ink, or as it is if it has ink of its own.");
  module.def("paper_example", &paper_example, py::return_value_policy::copy, "The character of Table 3.");

  add_struct<Provenance>(module, "Provenance", "Origin of characters, and the terms of their use.", &Provenance::source,
                         "source: author of the characters, one line", &Provenance::licence,
                         "licence: terms of use, one line", &Provenance::attribution,
                         "attribution: required attribution, one line", &Provenance::licence_text,
                         "licence_text: full text, if it must accompany the characters");

  py::class_<CharacterList> type(module, "CharacterList", "Characters and their provenance.");
  py::list fields;
  add_field(type, fields, &CharacterList::characters, "characters: list of Character, copied");
  add_field(type, fields, &CharacterList::provenance, "provenance: Provenance");
  type.def(py::init([](std::vector<Character> characters, Provenance provenance) {
             return CharacterList{std::move(provenance), std::move(characters)};
           }),
           "characters"_a = std::vector<Character>{}, "provenance"_a = Provenance{})
      .def("find", &find<CharacterList>, "code"_a, "order"_a = "",
           "The Character in the stroke order of this name (empty: the standard one), or None.")
      .def("__getitem__", &at<CharacterList>, "code"_a)
      .def(
          "__contains__", [](const CharacterList& self, char32_t code) { return self.find(code) != nullptr; }, "code"_a)
      .def("__len__", [](const CharacterList& self) { return self.characters.size(); })
      .def("__iter__",  // over a copy, because the list may change
           [](const CharacterList& self) {
             return py::typing::Iterator<Character>(py::iter(py::cast(std::vector<Character>(self.characters))));
           })
      .attr("__match_args__") = py::tuple(fields);
  module.def("built_in_characters", &built_in_characters, py::return_value_policy::copy,
             "The characters drawn for this library; every typical stroke occurs in at least one.");
  module.def("read_characters",
             released(+[](const std::filesystem::path& path) { return read_characters(path.string()); }), "path"_a,
             "Reads the text format of docs/character-format.md. Raises FileError, or FormatError naming the line.");
  module.def("write_characters", released(+[](const std::filesystem::path& path, const CharacterList& characters) {
               std::ostringstream out;
               write_characters(out, characters);
               write_file(path, out.str());
             }),
             "path"_a, "characters"_a, "Writes the text format, atomically. Raises FileError.");

  add_enum(module, "CoordinatePrecision", "Precision of the control points in a set file.", CoordinatePrecision::exact,
           "coarse standard fine exact");
  module.def(
      "encode_character_set",
      [](const CharacterList& list, CoordinatePrecision precision) {
        const std::vector<std::byte> bytes = released(&encode_character_set)(list, precision);
        return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      },
      "characters"_a, "precision"_a = CoordinatePrecision::standard, "The characters as the bytes of a set file.");

  py::class_<CharacterSet>(module, "CharacterSet",
                           "An immutable set of characters: a memory-mapped set file, characters in memory, or several "
                           "layered sets. Any number of threads may use it.")
      .def(py::init<>())
      .def(py::init(released(+[](const CharacterList& characters) { return CharacterSet(characters); })),
           "characters"_a)
      .def_static(
          "open", released(+[](const std::filesystem::path& path) { return CharacterSet::open(path.string()); }),
          "path"_a,
          "Opens a set file, reading only its index, or a file in the text format. Raises FileError or FormatError.")
      .def_static(
          "from_bytes",
          [](const py::bytes& bytes, const std::string& name) {
            const std::string_view view = bytes;
            const auto* const first = reinterpret_cast<const std::byte*>(view.data());
            return CharacterSet::from_bytes({first, first + view.size()}, name);
          },
          "bytes"_a, "name"_a = "bytes", "A set from the bytes of a set file; `name` is used in messages.")
      .def_static(
          "layered", [](const std::vector<CharacterSet>& sets) { return CharacterSet::layered(sets); }, "sets"_a,
          "Several sets as one. If several have a character, that of the first set is found.")
      .def("find", &find<CharacterSet>, "code"_a, "order"_a = "",
           "The Character, decoded, in the stroke order of this name (empty: the standard or else the first), or None. "
           "Raises FormatError.")
      .def("__getitem__", &at<CharacterSet>, "code"_a)
      .def(
          "__contains__", [](const CharacterSet& self, char32_t code) { return self.find(code).has_value(); }, "code"_a)
      .def("__len__", &CharacterSet::size)
      .def(
          "__iter__",
          [](const CharacterSet& self) {
            py::list codes;
            for (const StoredCharacter& stored : self) codes.append(stored.code());
            return py::typing::Iterator<py::str>(py::iter(codes));
          },
          "Every character once, as a str, in ascending code point order.")
      .def("orders", &CharacterSet::orders, "code"_a, "Names of the stroke orders of a character; '' is the standard.")
      .def("provenances", &CharacterSet::provenances, "Provenance of each layer.")
      .def("coordinate_error", &CharacterSet::coordinate_error,
           "Maximum distance between a stored control point and the original [em].")
      .def("list", released(+[](const CharacterSet& self) { return self.list(); }),
           "Every character in every order, decoded, as a CharacterList.")
      .def("check", released(+[](const CharacterSet& self) { self.check(); }),
           "Decodes every character in every order. Raises FormatError naming the damage.")
      .def("__repr__", [](const CharacterSet& self) { return told("CharacterSet({} characters)", self.size()); });
}

}  // namespace calligraphy::python
