// Enums of C++ as Python classes.
#include "enumeration.hpp"

#include <string>

#include <calligraphy/base/error.hpp>

namespace calligraphy::python {

long long number_of_member(py::handle type, py::handle value) {
  const auto name = type.attr("__name__").cast<std::string>();
  if (PyIndex_Check(value.ptr()) == 0) {
    throw py::type_error(name + ": an integer is expected, not " + py::repr(value).cast<std::string>());
  }
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!number) throw py::error_already_set();
  std::string members;
  for (const auto& [member, each] : type.attr("__members__").cast<py::dict>()) {
    const py::int_ own(py::reinterpret_borrow<py::object>(each));
    if (own.equal(number)) return own.cast<long long>();
    members +=
        (members.empty() ? "" : ", ") + member.cast<std::string>() + " (" + py::repr(own).cast<std::string>() + ")";
  }
  throw ValueError(name + ": " + py::repr(number).cast<std::string>() + " is none of " + members);
}

}  // namespace calligraphy::python
