// Enums of C++ as Python classes.
#pragma once

#include <pybind11/pybind11.h>

namespace calligraphy::python {

namespace py = pybind11;

/// The number of a member. @throws InvalidValue naming the enum, the value and its members, where it is none of them;
/// TypeError where it is no integer
long long number_of_member(py::handle type, py::handle value);

/// pybind11's own takes any integer, which C++ would then run as whatever comes last in a branch. This one's values are
/// its members alone, whoever makes or unpickles them.
template <class Enum>
class Enumeration : public py::enum_<Enum> {
 public:
  template <class... Extra>
  Enumeration(py::handle scope, const char* name, const Extra&... extra) : py::enum_<Enum>(scope, name, extra...) {
    const auto of = [type = py::handle(*this)](const py::object& value) {  // a type of the module, which stays
      return static_cast<Enum>(number_of_member(type, value));
    };
    this->def(py::init(of), py::arg("value"), py::prepend());
    this->def(py::pickle([](const Enum& self) { return py::object(py::int_(static_cast<long long>(self))); }, of),
              py::prepend());
  }
};

}  // namespace calligraphy::python
