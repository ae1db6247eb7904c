// NumPy arrays in and out: checked against the shape that is expected.
#include "arrays.hpp"

#include <cstdint>

#include <calligraphy/base/error.hpp>

namespace calligraphy::python {
namespace {

std::string shape_of(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

/// What NumPy says, with the argument's name. Ctrl-C and a lack of memory stay what they are.
[[noreturn]] void refuse(py::error_already_set& error, const char* name, const std::string& what) {
  const std::string message = std::string(name) + ": " + what + ": " + py::str(error.value()).cast<std::string>();
  if (error.matches(PyExc_MemoryError)) {
    PyErr_SetString(PyExc_MemoryError, message.c_str());
    throw py::error_already_set();
  }
  if (!error.matches(PyExc_Exception)) throw;
  throw ValueError(message);
}

/// Whether something of it is masked: asked of subclasses alone, as each tick of a law comes by.
bool is_masked(const py::array& array) {
  if (Py_TYPE(array.ptr()) == py::detail::npy_api::get().PyArray_Type_) return false;
  return py::module_::import("numpy.ma").attr("is_masked")(array).cast<bool>();
}

/// An array of real numbers that doubles hold without loss, or an error that names the argument.
py::array real_numbers(py::handle value, const char* name) {
  py::array array;
  try {
    if (py::isinstance<py::array>(value)) {
      array = py::reinterpret_borrow<py::array>(value);
    } else {
      array = py::module_::import("numpy").attr("asarray")(value).cast<py::array>();
    }
  } catch (py::error_already_set& error) {
    refuse(error, name, "an array of numbers is expected");
  }
  if (is_masked(array)) {
    throw ValueError(std::string(name) +
                     ": a masked array is given, whose masked numbers C++ would take as they are: fill them first");
  }
  const char kind = array.dtype().kind();
  const bool real = (kind == 'f' || kind == 'i' || kind == 'u') && array.itemsize() <= 8;
  if (!real) {
    throw ValueError(std::string(name) + ": real numbers are expected (dtype float64 or what converts to it), not " +
                     py::str(array.dtype()).cast<std::string>());
  }
  return array;
}

[[noreturn]] void refuse_shape(const char* name, const std::string& expected, const py::array& given) {
  throw ValueError(std::string(name) + ": shape " + expected + " is expected, not " + shape_of(given));
}

/// Not Doubles::ensure(), which forgets why NumPy could not.
Doubles doubles_of(const py::array& array, const char* name) {
  if (Doubles::check_(array) && (array.flags() & py::array::c_style) != 0)
    return py::reinterpret_borrow<Doubles>(array);
  try {
    return py::module_::import("numpy").attr("ascontiguousarray")(array, py::dtype::of<double>()).cast<Doubles>();
  } catch (py::error_already_set& error) {
    refuse(error, name, "shape " + shape_of(array) + " cannot be copied");
  }
}

/// Aligned as points are, so that rows of two may be read as such.
Doubles contiguous(const py::array& array, const char* name) {
  Doubles result = doubles_of(array, name);
  if (reinterpret_cast<std::uintptr_t>(result.data()) % alignof(Point) == 0) return result;
  return Doubles(std::vector<py::ssize_t>(result.shape(), result.shape() + result.ndim()), result.data());
}

}  // namespace

Doubles doubles(py::handle value, const char* name, py::ssize_t columns) {
  const py::array array = real_numbers(value, name);
  if (columns == 0) {
    if (array.ndim() != 1) refuse_shape(name, "(n,)", array);
    return contiguous(array, name);
  }
  if (array.ndim() == 1 && array.size() == 0) return Doubles(std::vector<py::ssize_t>{0, columns});
  if (array.ndim() != 2 || array.shape(1) != columns) refuse_shape(name, "(n, " + std::to_string(columns) + ")", array);
  return contiguous(array, name);
}

Doubles fixed_doubles(py::handle value, const char* name, py::ssize_t length) {
  const py::array array = real_numbers(value, name);
  if (array.ndim() != 1 || array.size() != length) refuse_shape(name, "(" + std::to_string(length) + ",)", array);
  return contiguous(array, name);
}

Point point(py::handle value, const char* name) { return point_at(fixed_doubles(value, name, 2).data(), 0); }

Eigen::Vector3d vector(py::handle value, const char* name) {
  return vector_at(fixed_doubles(value, name, 3).data(), 0);
}

Eigen::Matrix3d matrix(py::handle value, const char* name) {
  const py::array array = real_numbers(value, name);
  if (array.ndim() != 2 || array.shape(0) != 3 || array.shape(1) != 3) refuse_shape(name, "(3, 3)", array);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(contiguous(array, name).data());
}

std::vector<Point> points(py::handle value, const char* name) {
  const Doubles array = doubles(value, name, 2);
  std::vector<Point> result(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = point_at(array.data(), static_cast<py::ssize_t>(i));
  return result;
}

py::array_t<double> view(const double* data, std::vector<py::ssize_t> shape, py::handle owner, bool writable) {
  py::array_t<double> result(std::move(shape), data, owner);
  if (!writable) result.attr("flags").attr("writeable") = false;
  return result;
}

py::array_t<double> array_of(const Point& value) { return py::array_t<double>(2, value.data()); }

py::array_t<double> array_of(const Eigen::Vector3d& value) { return py::array_t<double>(3, value.data()); }

}  // namespace calligraphy::python
