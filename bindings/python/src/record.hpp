// Plain structs as Python classes: keyword arguments, comparison, representation and pickling from a list of fields.
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"

namespace calligraphy::python {

/// Sets the fields named by keywords. @throws TypeError naming the class and a keyword that it has not
void set_fields(py::handle record, const py::dict& values);
/// All fields by name; arrays are copies.
py::dict fields_of(py::handle record);
/// Whether all fields are equal; NaN in an array equals NaN.
bool equal_fields(py::handle one, py::handle other);
/// As it would be written, but for long lists and texts, of which it has the beginning.
std::string representation(py::handle record);

/// What a class that is no record says of itself in a line, by Python's str.format.
template <class... Values>
std::string told(const char* format, Values&&... values) {
  return py::str(format).format(std::forward<Values>(values)...).template cast<std::string>();
}

/// Objects of a class are equal where `equal` says so, and have no hash.
template <class Struct, class Equal>
void compare(py::class_<Struct>& type, Equal&& equal) {
  type.def("__eq__", [equal](const py::object& self, const py::object& other) -> py::object {
    if (!py::isinstance<Struct>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(equal(self, other));
  });
  type.attr("__hash__") = py::none();
}

template <class Type>
inline constexpr bool is_fixed_array = false;
template <int Rows, int Columns>
inline constexpr bool is_fixed_array<Eigen::Matrix<double, Rows, Columns>> = true;

template <class Type>
inline constexpr bool is_vector = false;
template <class Element>
inline constexpr bool is_vector<std::vector<Element>> = true;

/// A struct of fields, all of which a person may read and write. Vectors are views into the struct, which they keep
/// alive, so that `state.position[2] = 0.1` does what it says.
template <class Struct>
class Record {
 public:
  Record(py::handle scope, const char* name, const char* documentation) : class_(scope, name, documentation) {
    class_.def(py::init([](const py::kwargs& values) {
      Struct result{};
      set_fields(py::cast(&result, py::return_value_policy::reference), values);
      return result;
    }));
    class_.def("__repr__", [](py::handle self) { return representation(self); });
    compare(class_, [](py::handle self, py::handle other) { return equal_fields(self, other); });
    class_.def("__copy__", [](const Struct& self) { return Struct(self); });
    class_.def("__deepcopy__", [](const Struct& self, const py::dict&) { return Struct(self); });
    class_.def(py::pickle([](py::handle self) { return fields_of(self); },
                          [](const py::dict& values) {
                            Struct result{};
                            set_fields(py::cast(&result, py::return_value_policy::reference), values);
                            return result;
                          }));
    class_.attr("fields") = py::tuple();
  }

  template <class Owner, class Member>
  Record& field(const char* name, Member Owner::*member, const char* documentation) {
    if constexpr (is_fixed_array<Member>) {
      class_.def_property(
          name,
          [member](const py::object& self) {
            Member& value = self.cast<Struct&>().*member;
            if constexpr (Member::ColsAtCompileTime == 1) {
              return view(value.data(), {value.size()}, self, true);
            } else {  // columns first in memory
              const auto rows = static_cast<py::ssize_t>(value.rows());
              return py::array_t<double>({rows, static_cast<py::ssize_t>(value.cols())},
                                         {py::ssize_t{sizeof(double)}, rows * py::ssize_t{sizeof(double)}},
                                         value.data(), self);
            }
          },
          [member, name](Struct& self, const ArrayLike& value) {
            if constexpr (Member::ColsAtCompileTime == 3) {
              self.*member = matrix(value, name);
            } else if constexpr (Member::RowsAtCompileTime == 3) {
              self.*member = vector(value, name);
            } else {
              self.*member = point(value, name);
            }
          },
          documentation);
    } else if constexpr (is_vector<Member>) {  // not def_readwrite, whose list would point into a vector that may move
      class_.def_property(
          name, [member](const Struct& self) { return Member(self.*member); },
          [member](Struct& self, Member value) { self.*member = std::move(value); }, documentation);
    } else {
      class_.def_readwrite(name, member, documentation);
    }
    class_.attr("fields") = py::object(class_.attr("fields")) + py::make_tuple(name);
    return *this;
  }

  /// A field that is neither a vector nor what pybind11 knows.
  template <class Get, class Set>
  Record& property(const char* name, Get&& get, Set&& set, const char* documentation) {
    class_.def_property(name, std::forward<Get>(get), std::forward<Set>(set), documentation);
    class_.attr("fields") = py::object(class_.attr("fields")) + py::make_tuple(name);
    return *this;
  }

  py::class_<Struct>& type() { return class_; }

 private:
  py::class_<Struct> class_;
};

}  // namespace calligraphy::python
