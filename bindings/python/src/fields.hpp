// Plain structs and enumerations as Python classes. What all structs share (keyword arguments, comparison,
// representation, copies, pickling) is Python's business: calligraphy/_struct.py.
#pragma once

#include <initializer_list>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/native_enum.h>
#include <pybind11/stl.h>

#include <Eigen/Geometry>

#include "arrays.hpp"

namespace calligraphy::python {

/// What a class that is no struct says of itself in a line, by Python's str.format.
template <class... Values>
std::string told(const char* format, Values&&... values) {
  return py::str(format).format(std::forward<Values>(values)...).template cast<std::string>();
}

/// An enumeration of C++ from its last member and the names of all, in the order of C++, which counts from 0; those of
/// flags from bit 0.
template <class Enum>
void add_enum(py::module_& module, const char* name, const char* documentation, Enum last, const std::string& names,
              bool flags = false) {
  py::native_enum<Enum> type(module, name, flags ? "enum.IntFlag" : "enum.IntEnum", documentation);
  std::istringstream words(names);
  int index = -1;
  for (std::string word; words >> word;) {
    ++index;
    type.value(word.c_str(), static_cast<Enum>(flags ? 1 << index : index));
  }
  type.finalize();
  if (static_cast<Enum>(flags ? 1 << index : index) != last) {
    throw py::import_error(std::string(name) + ": the module names other members than C++ has");
  }
}

template <class Type>
inline constexpr bool is_matrix = false;
template <int Rows, int Columns>
inline constexpr bool is_matrix<Eigen::Matrix<double, Rows, Columns>> = true;
template <>
inline constexpr bool is_matrix<Eigen::Isometry3d> = true;
template <class Type>
inline constexpr bool is_vector = false;
template <class Element>
inline constexpr bool is_vector<std::vector<Element>> = true;

/// Where a field lies within the objects of a class. It knows the class at run time only, so that what pybind11 makes
/// of a field is compiled once per type of field and not once per class as well.
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
    if (!caster.load(self, false)) throw py::type_error("a field of another class is asked for");
    return *reinterpret_cast<Member*>(static_cast<char*>(caster.value) + offset_);
  }

 private:
  const std::type_info* type_;
  std::ptrdiff_t offset_ = 0;
};

/// "name: what it is [unit]" or "name [unit]"
struct NamedText {
  explicit NamedText(const std::string& text)
      : name(text.substr(0, text.find_first_of(": "))), documentation(text.substr(text.find_first_of(' ') + 1)) {}

  std::string name, documentation;
};

/// A field that may be assigned to. Vectors are views into the struct, which they keep alive, so that
/// `state.position[2] = 0.1` does what it says; so are structs. Lists are copies, as theirs may move.
template <class Struct, class Member>
void add_field(py::class_<Struct>& type, py::list& names, Member Struct::*member, const char* text) {
  const NamedText named(text);
  const Place place(member);
  py::cpp_function get, set;
  if constexpr (is_matrix<Member>) {
    get = [place](const py::object& self) {
      auto& value = place.of<Member>(self).matrix().derived();
      constexpr py::ssize_t step = sizeof(double);  // columns first in memory
      if (value.cols() == 1) return py::array_t<double>(value.rows(), value.data(), self);
      return py::array_t<double>({value.rows(), value.cols()}, {step, value.rows() * step}, value.data(), self);
    };
    set = [place, name = named.name](const py::object& self, const ArrayLike& value) {
      using Matrix = std::remove_cvref_t<decltype(std::declval<Member&>().matrix().derived())>;
      place.of<Member>(self).matrix() = matrix_of<Matrix>(value, name.c_str());
    };
  } else {
    if constexpr (is_vector<Member>) {
      get = [place](const py::object& self) { return Member(place.of<Member>(self)); };
    } else {
      get = py::cpp_function([place](const py::object& self) -> Member& { return place.of<Member>(self); },
                             py::return_value_policy::reference_internal);
    }
    set = [place](const py::object& self, Member value) { place.of<Member>(self) = std::move(value); };
  }
  type.def_property(named.name.c_str(), get, set, named.documentation.c_str());
  names.append(named.name);
}

/// The class of a struct, from its fields: each a member and what add_field() takes.
template <class Struct, class... Fields>
py::class_<Struct> add_struct(py::module_& module, const char* name, const char* documentation, Fields... fields) {
  py::class_<Struct> type(module, name, documentation);
  type.def(py::init<>());
  py::list names;
  const auto add = [&](auto&& self, auto member, const char* text, auto... more) -> void {
    add_field<Struct>(type, names, member, text);
    if constexpr (sizeof...(more) > 0) self(self, more...);
  };
  add(add, fields...);
  type.attr("fields") = py::tuple(names);
  return type;
}

}  // namespace calligraphy::python
