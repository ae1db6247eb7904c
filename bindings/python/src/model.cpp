// Characters, typical strokes, character sets.
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
  const bool is_none = stroke_ids.empty() && result.structure.control_points.empty();  // as in a new MatchResult
  if (!problems.empty() && !is_none) {
    throw ValueError("stroke " + std::to_string(problems[0].stroke) + ": " + problems[0].what);
  }
  return result;
}

Character decoded(const Character& character) { return character; }
Character decoded(const StoredCharacter& stored) { return stored.character(); }

/// Says how a character is read, in the form of Python.
void warn_of_reading(const TextCharacter& character, char32_t code) {
  const std::string note = reading_note(character, code);
  if (!note.empty() && PyErr_WarnEx(PyExc_UserWarning, note.c_str(), 1) != 0) throw py::error_already_set();
}

template <class Characters>
std::optional<Character> find(const Characters& characters, const std::string& text, const std::string& order) {
  const TextCharacter character = one_character(text, "character");
  const char32_t code = character.code_in(characters);
  const auto found = characters.find(code, order);
  if (!found) return std::nullopt;
  warn_of_reading(character, code);
  return decoded(*found);
}
template <class Characters>
Character at(const Characters& characters, const std::string& text) {
  if (const std::optional<Character> found = find(characters, text, "")) return *found;
  throw py::key_error(text + " is not in this set of characters");
}
template <class Characters>
bool contains(const Characters& characters, const std::string& text) {
  return static_cast<bool>(characters.find(one_character(text, "character").code_in(characters)));
}
template <class Characters>
std::vector<Character> text_in(const Characters& characters, const std::string& text) {
  std::vector<Character> found;
  for (const TextCharacter& each : text_characters(text)) {
    const char32_t code = each.code_in(characters);
    const auto character = characters.find(code);
    if (!character) throw py::key_error(encode_utf8(each.written) + " is not in this set of characters");
    warn_of_reading(each, code);
    found.push_back(decoded(*character));
  }
  return found;
}

void add_ink(py::module_& module) {
  py::class_<InkLine>(module, "InkLine")
      .def_property_readonly(
          "points", [](const InkLine& self) { return array_of_points(self.points); }, "+ (n, 2).")
      .def_property_readonly(
          "places", [](const InkLine& self) { return as_numbers(self.places); }, "+ (n,).")
      .def_property_readonly(
          "knots", [](const InkLine& self) { return as_numbers(self.knots); }, "+ (k,).")
      .def_property_readonly(
          "directions", [](const InkLine& self) { return array_of_points(self.directions); }, "+ (k, 2).")
      .def_readonly("corners", &InkLine::corners);
  module.def("ink_line", &ink_line, "stroke"_a, "spacing"_a = 0.004);
  module.def(
      "ink_discs",
      [](const Stroke& stroke, double spacing) {
        const std::vector<InkDisc> discs = ink_discs(stroke, spacing);
        Doubles result({static_cast<py::ssize_t>(discs.size()), py::ssize_t{3}});
        double* to = result.mutable_data();
        for (const InkDisc& disc : discs) {
          *to++ = disc.centre.x();
          *to++ = disc.centre.y();
          *to++ = disc.radius;
        }
        return result;
      },
      "stroke"_a, "spacing"_a = 0.004, "+ x, y, radius, (m, 3) [em].");
  module.def(
      "ink_outline",
      [](const Stroke& stroke, double tolerance) { return array_of_points(ink_outline(stroke, tolerance)); },
      "stroke"_a, "tolerance"_a = 5e-4, "+ (n, 2) [em].");
  module.def("typical_half_width", &typical_half_width, "id"_a, "stroke_count"_a, "length"_a);
  module.def("typical_ink", &typical_ink, "id"_a, "half_width"_a);
  module.def(
      "stroke_polyline",
      [](const Stroke& stroke, double tolerance) { return array_of_points(stroke_polyline(stroke, tolerance)); },
      "stroke"_a, "tolerance"_a = 1e-4, "+ (n, 2) [em].");
}

}  // namespace

void add_model(py::module_& module) {
  py::class_<TypicalStroke> typical(module, "TypicalStroke");
  each_field<TypicalStroke>([&](const auto& field) { typical.def_readonly(field.name, field.member); });
  typical.def_property_readonly("shape", array_within<TypicalStroke>(&TypicalStroke::shape), "+ (n, 2).")
      .def("__reduce__",
           [](const TypicalStroke& self) -> py::tuple {
             return py::make_tuple(py::module_::import("calligraphy").attr("typical_stroke"), py::make_tuple(self.id));
           })
      .def("__repr__",
           [](const TypicalStroke& self) { return formatted("TypicalStroke({}, {})", self.id, self.name); });
  module.def("typical_strokes", [] {
    py::typing::List<TypicalStroke> result;
    for (const TypicalStroke& stroke : typical_strokes()) {
      result.append(py::cast(&stroke, py::return_value_policy::reference));
    }
    return result;
  });
  module.def("typical_stroke", &typical_stroke, py::return_value_policy::reference, "id"_a);

  add_types<StrokeInk, Provenance, CoordinatePrecision>(module);
  py::class_<StrokeInput>(module, "StrokeInput")
      .def(py::init([](int id, const ArrayLike& control_points, const std::vector<double>& factors,
                       const std::string& elements, const std::optional<StrokeInk>& ink) {
             return StrokeInput{id, points(control_points, "control_points"), factors, elements, ink};
           }),
           "id"_a, "control_points"_a, "attraction_factors"_a = std::vector<double>{}, "elements"_a = "",
           "ink"_a = py::none())
      .def_readwrite("id", &StrokeInput::id)
      .def_property(
          "control_points", [](const StrokeInput& self) { return array_of_points(self.control_points); },
          [](StrokeInput& self, const ArrayLike& value) { self.control_points = points(value, "control_points"); },
          "(n, 2), copied [em]")
      .def_readwrite("attraction_factors", &StrokeInput::attraction_factors)
      .def_property(
          "elements", [](const StrokeInput& self) { return self.elements.elements(); },
          [](StrokeInput& self, const std::string& value) { self.elements = value; })
      .def_readwrite("ink", &StrokeInput::ink);

  py::class_<Stroke>(module, "Stroke", "+ A view that keeps the character alive.")
      .def_property_readonly(
          "type", [](const Stroke& self) { return self.type; }, py::return_value_policy::reference)
      .def_readonly("elements", &Stroke::elements)
      .def_readonly("curve_degree", &Stroke::curve_degree)
      .def("input", &input_of, "A copy as input to make_character.")
      .def_property_readonly("control_points", array_within<Stroke>(&Stroke::control_points), "(n, 2), read only [em]")
      .def_property_readonly("attraction_factors", array_within<Stroke>(&Stroke::attraction_factors))
      .def_property_readonly(
          "ink", [](const Stroke& self) { return self.ink == nullptr ? std::nullopt : std::optional(*self.ink); },
          "StrokeInk, copied, or None")
      .def("__repr__", [](const Stroke& self) {
        return formatted("Stroke({}, {} control points)", self.type->name, self.control_points.size());
      });

  add_ink(module);

  py::class_<Character>(module, "Character", "+ Immutable. Made by make_character, or read from a file.")
      .def(py::init(&character_of), "code"_a, "order"_a, "curve_degree"_a, "control_points"_a, "stroke_ids"_a,
           "feature_points"_a, "elements"_a, "attraction_factors"_a, "ink"_a = std::vector<StrokeInk>(),
           "From the fields below; make_character() is simpler.")
      .def_readonly("code", &Character::code)
      .def_readonly("order", &Character::order)
      .def_readonly("curve_degree", &Character::curve_degree)
      .def_property_readonly("stroke_count", &Character::stroke_count)
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
      .def("__repr__", [](const Character& self) {
        return formatted("Character({}, {} strokes)", encode_utf8(self.code), self.stroke_count());
      });

  module.def(
      "make_character",
      [](char32_t code, const std::vector<StrokeInput>& inputs, int curve_degree) {
        return make_character(code, inputs, curve_degree);
      },
      "code"_a, "strokes"_a, "curve_degree"_a = 3);
  module.def("with_quartic_curves", &with_quartic_curves, "character"_a);
  module.def("with_typical_ink", &with_typical_ink, "character"_a);
  module.def("paper_example", &paper_example, py::return_value_policy::copy);

  constexpr const char* text_doc =
      "The characters of a text, in order, without white space and code points that have no ink. Warns of those that "
      "are read as another one. Raises KeyError.";
  py::class_<CharacterList> type(module, "CharacterList");
  each_field<CharacterList>([&](const auto& field) { add_field(type, field); });
  type.def(py::init([](std::vector<Character> characters, Provenance provenance) {
             return CharacterList{std::move(provenance), std::move(characters)};
           }),
           "characters"_a = std::vector<Character>{}, "provenance"_a = Provenance{})
      .def("find", &find<CharacterList>, "character"_a, "order"_a = "",
           "The Character in the stroke order of this name (empty: the standard one), or None.")
      .def("__getitem__", &at<CharacterList>, "character"_a)
      .def("__contains__", &contains<CharacterList>, "character"_a)
      .def("text", &text_in<CharacterList>, "text"_a, text_doc)
      .def("__len__", [](const CharacterList& self) { return self.characters.size(); })
      .def("__iter__",  // over a copy, because the list may change
           [](const CharacterList& self) {
             return py::typing::Iterator<Character>(py::iter(py::cast(std::vector<Character>(self.characters))));
           });
  module.def("typical_stroke_code", &typical_stroke_code, "id"_a);
  module.def("typical_stroke_characters", &typical_stroke_characters, py::return_value_policy::copy);
  module.def("built_in_characters", &built_in_characters, py::return_value_policy::copy);
  module.def("read_characters", from_file(&read_characters), "path"_a);
  module.def("write_characters", to_file(&write_characters), "path"_a, "characters"_a,
             "+ Atomically. Raises FileError.");
  module.def(
      "encode_character_set",
      [](const CharacterList& list, CoordinatePrecision precision) {
        const std::vector<std::byte> bytes = released(&encode_character_set)(list, precision);
        return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      },
      "characters"_a, "precision"_a = CoordinatePrecision::standard, "The characters as the bytes of a set file.");

  py::class_<CharacterSet>(module, "CharacterSet")
      .def(py::init<>())
      .def(py::init(released(+[](const CharacterList& characters) { return CharacterSet(characters); })),
           "characters"_a)
      .def_static("open", from_file(&CharacterSet::open), "path"_a)
      .def_static(
          "from_bytes",
          [](const py::bytes& bytes, const std::string& name) {
            const std::string_view view = bytes;
            const auto* const first = reinterpret_cast<const std::byte*>(view.data());
            return CharacterSet::from_bytes({first, first + view.size()}, name);
          },
          "bytes"_a, "name"_a = "bytes")
      .def_static(
          "layered", [](const std::vector<CharacterSet>& sets) { return CharacterSet::layered(sets); }, "sets"_a)
      .def("find", &find<CharacterSet>, "character"_a, "order"_a = "")
      .def("__getitem__", &at<CharacterSet>, "character"_a)
      .def("__contains__", &contains<CharacterSet>, "character"_a)
      .def("text", &text_in<CharacterSet>, "text"_a, text_doc)
      .def("__len__", &CharacterSet::size)
      .def(
          "__iter__",
          [](const CharacterSet& self) {
            py::list codes;
            for (const StoredCharacter& stored : self) codes.append(stored.code());
            return py::typing::Iterator<py::str>(py::iter(codes));
          },
          "Every character once, as a str, in ascending code point order.")
      .def("orders", &CharacterSet::orders, "code"_a)
      .def(
          "forms",
          [](const CharacterSet& self, char32_t code) {
            std::vector<Character> forms;
            for (const StoredCharacter& form : self.forms(code)) forms.push_back(form.character());
            return forms;
          },
          "code"_a)
      .def("provenances", &CharacterSet::provenances)
      .def("coordinate_error", &CharacterSet::coordinate_error)
      .def("list", released(+[](const CharacterSet& self) { return self.list(); }))
      .def("check", released(+[](const CharacterSet& self) { self.check(); }))
      .def("__repr__", [](const CharacterSet& self) { return formatted("CharacterSet({} characters)", self.size()); });

  add_struct<Placement>(module).def(
      "to_page",
      [](const Placement& self, const ArrayLike& value) {
        std::vector<Point> result = points(value, "points");
        for (Point& each : result) each = self.to_page(each);
        return array_of_points(result);
      },
      "points"_a, "+ (n, 2) [em] to (n, 2) [m].");
  py::class_<PlacedCharacter>(module, "PlacedCharacter")
      .def(py::init<Character, Placement>(), "character"_a, "placement"_a = Placement{})
      .def_readonly("character", &PlacedCharacter::character)
      .def_readonly("placement", &PlacedCharacter::placement);
}

}  // namespace calligraphy::python
