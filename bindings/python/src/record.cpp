// What records have in common, whatever their fields.
#include "record.hpp"

namespace calligraphy::python {

void set_fields(py::handle record, const py::dict& values) {
  const py::object type = py::type::of(record);
  const py::tuple fields = type.attr("fields");
  for (const auto& [name, value] : values) {
    if (!fields.contains(name)) {
      throw py::type_error(py::str(type.attr("__name__")).cast<std::string>() + " has no field " +
                           py::repr(name).cast<std::string>() + "; it has " +
                           py::str(", ").attr("join")(fields).cast<std::string>());
    }
    py::setattr(record, name, value);
  }
}

py::dict fields_of(py::handle record) {
  py::dict result;
  for (const py::handle name : py::type::of(record).attr("fields")) {
    py::object value = py::getattr(record, name);
    result[name] = py::isinstance<py::array>(value) ? value.attr("copy")() : value;
  }
  return result;
}

bool equal_fields(py::handle one, py::handle other) {
  const py::object same_array = py::module_::import("numpy").attr("array_equal");
  for (const py::handle name : py::type::of(one).attr("fields")) {
    const py::object a = py::getattr(one, name), b = py::getattr(other, name);
    const bool same =
        py::isinstance<py::array>(a) ? same_array(a, b, py::arg("equal_nan") = true).cast<bool>() : a.equal(b);
    if (!same) return false;
  }
  return true;
}

namespace {

/// For people who look at many records: of long lists and texts the beginning, and how much there is.
std::string shortened(const py::object& value) {
  constexpr std::size_t max_elements = 8, max_letters = 80;
  if (py::isinstance<py::list>(value) && py::len(value) > max_elements) {
    const auto some = py::repr(value[py::slice(0, 3, 1)]).cast<std::string>();
    return some.substr(0, some.size() - 1) + ", ... " + std::to_string(py::len(value)) + " in all]";
  }
  if (py::isinstance<py::str>(value) && py::len(value) > max_letters) {
    return py::repr(value[py::slice(0, max_letters / 2, 1)]).cast<std::string>() + "... " +
           std::to_string(py::len(value)) + " letters in all";
  }
  return py::repr(value).cast<std::string>();
}

}  // namespace

std::string representation(py::handle record) {
  const py::object type = py::type::of(record);
  std::string result = py::str(type.attr("__name__")).cast<std::string>() + "(";
  const char* separator = "";
  for (const py::handle name : type.attr("fields")) {
    const py::object value = py::getattr(record, name);
    const py::object shown = py::isinstance<py::array>(value) ? value.attr("tolist")() : value;
    result += separator + name.cast<std::string>() + "=" + shortened(shown);
    separator = ", ";
  }
  return result + ")";
}

}  // namespace calligraphy::python
