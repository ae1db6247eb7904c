// Plain structs and enumerations as Python classes. Common features of all structs (keyword arguments, comparison,
// representation, copies, pickling) are implemented in calligraphy/_struct.py.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/native_enum.h>
#include <pybind11/stl.h>

#include <Eigen/Geometry>

#include <calligraphy/devices/servo.hpp>
#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/model/character_text.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/render/guidance_law.hpp>

#include "arrays.hpp"
#include "documented.hpp"

/// Members of an enumeration, also by name.
template <class Enum>
struct pybind11::detail::type_caster_enum_type_enabled<Enum, std::enable_if_t<std::is_enum_v<Enum>>> : std::false_type {
};
template <class Enum>
class pybind11::detail::type_caster<Enum, std::enable_if_t<std::is_enum_v<Enum>>> : public type_caster_enum_type<Enum> {
 public:
  static constexpr auto name = const_name<Enum>() + io_name(" | str", "");

  /// @throws ValueError listing the names when given another one
  bool load(handle given, bool convert) {
    if (!convert || !isinstance<str>(given)) return type_caster_enum_type<Enum>::load(given, convert);
    const object members = type::of(pybind11::cast(Enum{})).attr("__members__");
    if (members.contains(given)) return type_caster_enum_type<Enum>::load(members[given], convert);
    throw calligraphy::ValueError("expected one of " + str(", ").attr("join")(members).template cast<std::string>() +
                                  ", got " + repr(given).cast<std::string>());
  }
};

namespace calligraphy::python {

/// Formats a one-line description by Python's str.format.
template <class... Values>
std::string formatted(const char* format, Values&&... values) {
  return py::str(format).format(std::forward<Values>(values)...).template cast<std::string>();
}

/// @throws ValueError naming the argument if the text is not one character
inline TextCharacter one_character(const std::string& text, const char* name) {
  const std::vector<TextCharacter> characters = text_characters(text);
  if (characters.size() == 1) return characters.front();
  throw ValueError(formatted("{}: expected one character, got '{}'", name, text));
}

/// A C++ enumeration. The text of each member also follows that of the class, because help() shows only this.
template <class Enum>
void add_enum(py::module_& module) {
  std::string documentation = text_of("", name_of<Enum>);
  for (const auto& member : members_of<Enum>) {
    if (*member.text != '\0') documentation += std::string("\n\n") + member.name + ": " + member.text;
  }
  const char* const base = is_flags<Enum> ? "enum.IntFlag" : "enum.IntEnum";
  py::native_enum<Enum> type(module, name_of<Enum>, base, documentation.c_str());
  for (const auto& member : members_of<Enum>) type.value(member.name, member.value, member.text);
  type.finalize();
}

template <class Type>
inline constexpr bool is_matrix = false;
template <int Rows, int Columns>
inline constexpr bool is_matrix<Eigen::Matrix<double, Rows, Columns>> = true;
template <>
inline constexpr bool is_matrix<Eigen::Isometry3d> = true;
template <class Type>
inline constexpr bool is_array = false;
template <std::size_t Size>
inline constexpr bool is_array<std::array<double, Size>> = true;
template <class Type>
inline constexpr bool is_vector = false;
template <class Element>
inline constexpr bool is_vector<std::vector<Element>> = true;

template <class Type>
inline constexpr bool is_optional = false;
template <class Value>
inline constexpr bool is_optional<std::optional<Value>> = true;

/// What can be converted to a type, in words: "a number", or "numbers" as elements of a list.
template <class Type>
std::string expectation(bool elements = false) {
  if constexpr (is_optional<Type>) {
    return expectation<typename Type::value_type>() + " or None";
  } else if constexpr (is_vector<Type>) {
    return "a list of " + expectation<typename Type::value_type>(true);
  } else if constexpr (std::is_same_v<Type, bool>) {
    return "True or False";
  } else if constexpr (std::is_same_v<Type, GuidanceFactory>) {
    return "linear, saturating, wang2006, a function, or a class or object with a method force";
  } else if constexpr (std::is_same_v<Type, ForceLaw>) {
    return "a function or None";
  } else if constexpr (std::is_same_v<Type, char32_t>) {
    return "a str of length 1";
  } else if constexpr (std::is_same_v<Type, std::string>) {
    return elements ? "str" : "a str";
  } else if constexpr (std::is_floating_point_v<Type>) {
    return elements ? "numbers" : "a number";
  } else if constexpr (std::is_integral_v<Type>) {
    using Limits = std::numeric_limits<Type>;
    return formatted(elements ? "integers from {} to {}" : "an integer from {} to {}", +Limits::min(), +Limits::max());
  } else {
    const auto name = py::type::of(py::cast(Type{})).attr("__name__").template cast<std::string>();
    if (elements) return name;
    return (std::string("AEIOU").find(name[0]) == std::string::npos ? "a " : "an ") + name;
  }
}

/// Any object; in signatures, what can be converted to the type.
template <class Type>
struct Given : ArrayLike {
  using ArrayLike::ArrayLike;
};

/// @throws TypeError naming the argument or field, what is expected and what was given; ValueError for a wrong name
template <class Type>
Type converted(const Given<Type>& given, const std::string& name) {
  try {
    // pybind11 takes the truth of anything for a bool, and bytes for a str.
    constexpr bool is_bool = std::is_same_v<Type, bool>, is_string = std::is_same_v<Type, std::string>;
    if (is_bool && !py::detail::make_caster<bool>().load(given, false)) throw py::cast_error();
    if (is_string && !py::isinstance<py::str>(given)) throw py::cast_error();
    return given.template cast<Type>();
  } catch (const ValueError& wrong) {
    throw ValueError(name + ": " + wrong.what());
  } catch (const py::builtin_exception&) {  // the conversion failed
  } catch (const py::error_already_set& raised) {
    if (!raised.matches(PyExc_TypeError)) throw;  // a TypeError: a sequence that cannot be iterated over
  }
  const py::object brief = py::module_::import("calligraphy._struct").attr("brief")(given);
  throw py::type_error(formatted("{}: expected {}, got {}", name, expectation<Type>(), brief));
}

/// Offset of a field within the objects of a class. The class is known only at run time, so that pybind11's templates
/// are instantiated once per field type instead of once per class and type.
class Place {
 public:
  template <class Struct, class Member>
  explicit Place(Member Struct::*member) : type_(&typeid(Struct)) {
    const Struct example{};
    offset_ = reinterpret_cast<const char*>(&(example.*member)) - reinterpret_cast<const char*>(&example);
  }

  /// @throws TypeError when `self` is of another class, or its __init__() has not been called
  template <class Member>
  Member& of(const py::object& self) const {
    py::detail::type_caster_generic caster(py::detail::get_type_info(*type_));
    if (!caster.load(self, false)) throw py::type_error("the field belongs to another class");
    return *reinterpret_cast<Member*>(static_cast<char*>(caster.value) + offset_);
  }

 private:
  const std::type_info* type_;
  std::ptrdiff_t offset_ = 0;
};

/// A writable field. Vectors and structs are views into the struct, which they keep alive, so that
/// `state.position[2] = 0.1` changes it. Lists, and arrays of points, are copies, because their elements may move.
template <class Struct, class Member>
void add_field(py::class_<Struct>& type, const Field<Struct, Member>& field) {
  const Place place(field.member);
  const char* const name = field.name;
  py::cpp_function get, set;
  if constexpr (is_matrix<Member>) {
    get = [place](const py::object& self) {
      auto& value = place.of<Member>(self).matrix().derived();
      constexpr py::ssize_t step = sizeof(double);  // column-major
      if (value.cols() == 1) return py::array_t<double>(value.rows(), value.data(), self);
      return py::array_t<double>({value.rows(), value.cols()}, {step, value.rows() * step}, value.data(), self);
    };
    set = [place, name](const py::object& self, const ArrayLike& value) {
      using Matrix = std::remove_cvref_t<decltype(std::declval<Member&>().matrix().derived())>;
      place.of<Member>(self).matrix() = matrix_of<Matrix>(value, name);
    };
  } else if constexpr (is_array<Member>) {
    get = [place](const py::object& self) {
      auto& value = place.of<Member>(self);
      return py::array_t<double>(static_cast<py::ssize_t>(value.size()), value.data(), self);
    };
    set = [place, name](const py::object& self, const ArrayLike& value) {
      auto& to = place.of<Member>(self);
      const Doubles numbers = fixed_doubles(value, name, static_cast<py::ssize_t>(to.size()));
      std::copy_n(numbers.data(), to.size(), to.begin());
    };
  } else if constexpr (std::is_same_v<Member, std::vector<Point>>) {
    get = [place](const py::object& self) { return array_of_points(place.of<Member>(self)); };
    set = [place, name](const py::object& self, const ArrayLike& value) {
      place.of<Member>(self) = points(value, name);
    };
  } else {
    if constexpr (is_vector<Member>) {
      get = [place](const py::object& self) { return Member(place.of<Member>(self)); };
    } else {
      get = py::cpp_function([place](const py::object& self) -> Member& { return place.of<Member>(self); },
                             py::return_value_policy::reference_internal);
    }
    set = [place, name](const py::object& self, const Given<Member>& value) {
      place.of<Member>(self) = converted(value, name);
    };
  }
  type.def_property(name, get, set);
}

template <class Type>
struct ElementOf : std::type_identity<Type> {};
template <class Type>
requires(is_vector<Type> || is_optional<Type>) struct ElementOf<Type> : std::type_identity<typename Type::value_type> {
};

/// Structs whose class is not made by add_struct().
template <class Struct>
inline constexpr bool is_bound_by_hand = false;
template <>
inline constexpr bool is_bound_by_hand<Character> = true;
template <>
inline constexpr bool is_bound_by_hand<PlacedCharacter> = true;
template <>
inline constexpr bool is_bound_by_hand<PenTrace> = true;
template <>
inline constexpr bool is_bound_by_hand<Recording> = true;

template <class Struct>
py::class_<Struct> add_struct(py::module_& module);

/// Structs and enumerations, unless the module has them already.
template <class... Types>
void add_types(py::module_& module) {
  const auto add = [&]<class Type>(std::type_identity<Type>) {
    if constexpr (std::is_enum_v<Type>) {
      if (!py::hasattr(module, name_of<Type>)) add_enum<Type>(module);
    } else if constexpr (has_fields<Type> && !is_bound_by_hand<Type>) {
      if (!py::hasattr(module, name_of<Type>)) add_struct<Type>(module);
    }
  };
  (add(std::type_identity<Types>()), ...);
}

/// The class of a struct, with all its fields, after the types of these.
template <class Struct>
py::class_<Struct> add_struct(py::module_& module) {
  each_field<Struct>(
      [&]<class Type>(const Field<Struct, Type>&) { add_types<typename ElementOf<Type>::type>(module); });
  py::class_<Struct> type(module, name_of<Struct>);
  type.def(py::init<>());
  py::list names;
  each_field<Struct>([&](const auto& field) {
    add_field<Struct>(type, field);
    names.append(field.name);
  });
  type.attr("fields") = py::tuple(names);
  return type;
}

template <class Structs>
py::list as_dicts(const Structs& structs);

/// The fields of a struct by name: lists of structs as lists of such dicts, enumerations in words, counts of faults by
/// DeviceFault.
template <class Struct>
py::dict as_dict(const Struct& results) {
  py::dict dict;
  each_field<Struct>([&](const auto& field) {
    const auto& value = results.*field.member;
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (has_fields<Value>) {
      dict[field.name] = as_dict(value);
    } else if constexpr (std::is_enum_v<Value>) {
      dict[field.name] = to_string(value);
    } else if constexpr (requires { requires has_fields<typename Value::value_type>; }) {
      dict[field.name] = as_dicts(value);
    } else if constexpr (std::is_same_v<Value, std::array<std::uint64_t, device_fault_count>>) {
      py::dict counts;
      for (std::size_t i = 0; i < value.size(); ++i) counts[py::cast(static_cast<DeviceFault>(i))] = value[i];
      dict[field.name] = counts;
    } else {
      dict[field.name] = as_python(value);
    }
  });
  return dict;
}

template <class Structs>
py::list as_dicts(const Structs& structs) {
  py::list result;
  for (const auto& each : structs) result.append(as_dict(each));
  return result;
}

/// Passes results of as_dict() to a function of calligraphy/_tables.py.
template <class... Arguments>
py::object in_tables(const char* function, const Arguments&... arguments) {
  return py::module_::import("calligraphy._tables").attr(function)(arguments...);
}

/// Documentation of what as_dict() returns, or of the columns of rows of structs.
template <class Struct>
std::string fields_text(const std::string& what = "A dict") {
  std::string text = what;
  each_field<Struct>([&](const auto& field) {
    std::string_view meaning = text_of(name_of<Struct>, field.name);
    if (meaning.ends_with('.')) meaning.remove_suffix(1);
    text += (text == what ? ": " : "; ") + std::string(field.name) + " (" + std::string(meaning) + ")";
  });
  return text + '.';
}

/// The columns of a structured array whose rows are C++ structs: name, type and offset of each member.
template <class Row>
class Columns {
 public:
  /// A struct becomes a column for each of its members, of which one whose name is taken is of the tip of the pen.
  template <class Member>
  void add(const char* name, const Row& row, const Member& member) {
    if constexpr (has_fields<Member>) {
      each_field<Member>([&](const auto& field) { add(field.name, row, member.*field.member); });
    } else {
      names_.append(names_.contains(name) ? std::string("tip_") + name : name);
      formats_.append(format<Member>());
      offsets_.append(reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&row));
    }
  }
  py::dtype dtype() const { return py::dtype(names_, formats_, offsets_, sizeof(Row)); }

 private:
  template <class Member>
  static std::string format() {
    if constexpr (std::is_same_v<Member, bool>) {
      return "?";
    } else if constexpr (std::is_enum_v<Member>) {
      return (std::is_signed_v<std::underlying_type_t<Member>> ? "i" : "u") + std::to_string(sizeof(Member));
    } else if constexpr (std::is_arithmetic_v<Member>) {
      const char* const kind = std::is_floating_point_v<Member> ? "f" : std::is_unsigned_v<Member> ? "u" : "i";
      return kind + std::to_string(sizeof(Member));
    } else {
      return "(" + std::to_string(Member::RowsAtCompileTime) + ",)f8";
    }
  }

  py::list names_, formats_, offsets_;
};

/// The dtype of an array whose rows are the structs as in memory.
template <class Row>
py::dtype dtype_of_struct() {
  const Row row{};
  Columns<Row> columns;
  each_field<Row>([&](const auto& field) { columns.add(field.name, row, row.*field.member); });
  return columns.dtype();
}

/// A structured array that takes ownership of the rows.
template <class Row>
py::array structured(std::vector<Row>&& rows, const py::dtype& dtype = dtype_of_struct<Row>()) {
  auto* const owned = new std::vector<Row>(std::move(rows));
  const py::capsule owner(owned, [](void* pointer) { delete static_cast<std::vector<Row>*>(pointer); });
  return py::array(dtype, owned->size(), owned->data(), owner);
}

}  // namespace calligraphy::python

template <class Type>
struct pybind11::detail::handle_type_name<calligraphy::python::Given<Type>> {
  static constexpr auto name = make_caster<Type>::name;
};
