// Conversion of NumPy arrays: shapes are checked, memory is shared where possible.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy::python {

namespace py = pybind11;
using namespace py::literals;

/// Anything that NumPy can convert to an array; the functions below check its contents.
class ArrayLike : public py::object {
  PYBIND11_OBJECT_DEFAULT(ArrayLike, py::object, any_object)

 private:
  static bool any_object(PyObject* value) { return value != nullptr; }
};

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// "(3, 2)"
inline std::string shape_of(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

/// NumPy's message with the argument's name. MemoryError and Ctrl-C keep their types.
[[noreturn]] inline void refuse(py::error_already_set& error, const char* name, const std::string& what) {
  const std::string message = std::string(name) + ": " + what + ": " + py::str(error.value()).cast<std::string>();
  if (error.matches(PyExc_MemoryError)) {
    PyErr_SetString(PyExc_MemoryError, message.c_str());
    throw py::error_already_set();
  }
  if (!error.matches(PyExc_Exception)) throw;
  throw ValueError(message);
}

[[noreturn]] inline void refuse_shape(const char* name, const std::string& expected, const py::array& given) {
  throw ValueError(std::string(name) + ": expected shape " + expected + ", got " + shape_of(given));
}

/// Whether any element is masked. Checks subclasses only, because every tick of a force law calls this.
inline bool is_masked(const py::array& array) {
  if (Py_TYPE(array.ptr()) == py::detail::npy_api::get().PyArray_Type_) return false;
  return py::module_::import("numpy.ma").attr("is_masked")(array).cast<bool>();
}

/// An array of real numbers that doubles represent without loss. @throws ValueError naming the argument
inline py::array real_numbers(py::handle value, const char* name) {
  py::array array;
  try {
    array = py::isinstance<py::array>(value) ? py::reinterpret_borrow<py::array>(value)
                                             : py::array(py::module_::import("numpy").attr("asarray")(value));
  } catch (py::error_already_set& error) {
    refuse(error, name, "expected an array of numbers");
  }
  if (is_masked(array)) {
    throw ValueError(std::string(name) + ": got a masked array, and C++ ignores masks: fill the masked elements first");
  }
  const char kind = array.dtype().kind();
  if ((kind != 'f' && kind != 'i' && kind != 'u') || array.itemsize() > 8) {
    throw ValueError(std::string(name) + ": expected real numbers (dtype float64 or convertible to it), got " +
                     py::str(array.dtype()).cast<std::string>());
  }
  return array;
}

/// The array as contiguous doubles, without a copy if it already is; aligned like points, so that rows of two can be
/// read as such. Doubles::ensure() would discard NumPy's error message.
inline Doubles contiguous(const py::array& array, const char* name) {
  Doubles result;
  if (Doubles::check_(array) && (array.flags() & py::array::c_style) != 0) {
    result = py::reinterpret_borrow<Doubles>(array);
  } else {
    try {
      result = py::module_::import("numpy").attr("ascontiguousarray")(array, py::dtype::of<double>()).cast<Doubles>();
    } catch (py::error_already_set& error) {
      refuse(error, name, "shape " + shape_of(array) + " cannot be copied");
    }
  }
  if (reinterpret_cast<std::uintptr_t>(result.data()) % alignof(Point) == 0) return result;
  return Doubles(std::vector<py::ssize_t>(result.shape(), result.shape() + result.ndim()), result.data());
}

/// Real numbers (n, columns), or (n,) for 0 columns, as contiguous doubles, copied only if necessary. An empty list
/// counts as an array without rows.
/// @throws ValueError naming the argument, the expected shape or type and the given one
inline Doubles doubles(py::handle value, const char* name, py::ssize_t columns = 0) {
  const py::array array = real_numbers(value, name);
  if (columns == 0) {
    if (array.ndim() != 1) refuse_shape(name, "(n,)", array);
    return contiguous(array, name);
  }
  if (array.ndim() == 1 && array.size() == 0) return Doubles(std::vector<py::ssize_t>{0, columns});
  if (array.ndim() != 2 || array.shape(1) != columns) refuse_shape(name, "(n, " + std::to_string(columns) + ")", array);
  return contiguous(array, name);
}

/// One row or many: (columns,) or (n, columns); for 0 columns, () or (n,). `one` tells which.
inline Doubles one_or_many(py::handle value, const char* name, py::ssize_t columns, bool& one) {
  const py::array array = real_numbers(value, name);
  one = columns == 0 ? array.ndim() == 0 : array.ndim() == 1 && array.size() == columns;
  if (!one) return doubles(array, name, columns);
  return doubles(columns == 0 ? array.attr("reshape")(1) : array.attr("reshape")(1, columns), name, columns);
}

/// (length,)
inline Doubles fixed_doubles(py::handle value, const char* name, py::ssize_t length) {
  const py::array array = real_numbers(value, name);
  if (array.ndim() != 1 || array.size() != length) refuse_shape(name, "(" + std::to_string(length) + ",)", array);
  return contiguous(array, name);
}

/// An Eigen vector, point or matrix.
template <class Matrix>
Matrix matrix_of(py::handle value, const char* name) {
  constexpr py::ssize_t rows = Matrix::RowsAtCompileTime, columns = Matrix::ColsAtCompileTime;
  if constexpr (columns == 1) {
    return Eigen::Map<const Matrix>(fixed_doubles(value, name, rows).data());
  } else {
    const py::array array = real_numbers(value, name);
    if (array.ndim() != 2 || array.shape(0) != rows || array.shape(1) != columns) {
      refuse_shape(name, "(" + std::to_string(rows) + ", " + std::to_string(columns) + ")", array);
    }
    return Eigen::Map<const Eigen::Matrix<double, rows, columns, Eigen::RowMajor>>(contiguous(array, name).data());
  }
}
inline Point point(py::handle value, const char* name) { return matrix_of<Point>(value, name); }
inline Eigen::Vector3d vector(py::handle value, const char* name) { return matrix_of<Eigen::Vector3d>(value, name); }

/// View of a row of an (n, 3) array of doubles.
inline Eigen::Map<const Eigen::Vector3d> vector_at(const double* data, py::ssize_t row) {
  return Eigen::Map<const Eigen::Vector3d>(data + 3 * row);
}

/// Points (n, 2), copied.
inline std::vector<Point> points(py::handle value, const char* name) {
  const Doubles array = doubles(value, name, 2);
  const auto* const first = reinterpret_cast<const Point*>(array.data());
  return {first, first + array.shape(0)};
}

/// A read-only view of C++ memory that `owner` keeps alive and never moves: (n,) for numbers, (n, 2) for points.
template <class Values>
auto view_of(const Values& values, py::handle owner) {
  using Value = std::remove_cvref_t<decltype(*values.data())>;
  using Number = std::conditional_t<std::is_arithmetic_v<Value>, Value, double>;
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(values.size())};
  if (sizeof(Value) == sizeof(Point)) shape.push_back(2);
  py::array_t<Number> result(shape, reinterpret_cast<const Number*>(values.data()), owner);
  result.attr("flags").attr("writeable") = false;
  return result;
}

/// A copy of a vector or point.
template <class Matrix>
Doubles array_of(const Matrix& value) {
  return Doubles(value.size(), value.eval().data());
}
/// A C++ value for Python; vectors are copied.
template <class Value>
auto as_python(const Value& value) {
  if constexpr (std::is_base_of_v<Eigen::EigenBase<Value>, Value>) {
    return array_of(value);
  } else {
    return value;
  }
}
template <class Points>
Doubles array_of_points(const Points& values) {
  Doubles result({static_cast<py::ssize_t>(values.size()), py::ssize_t{2}});
  double* to = result.mutable_data();
  for (const Point& value : values) *to++ = value.x(), *to++ = value.y();
  return result;
}

/// A copy of a sequence of numbers.
template <class Numbers>
Doubles as_numbers(const Numbers& values) {
  return Doubles(static_cast<py::ssize_t>(values.size()), values.data());
}

}  // namespace calligraphy::python

template <>
struct pybind11::detail::handle_type_name<calligraphy::python::ArrayLike> {
  static constexpr auto name = const_name("numpy.typing.ArrayLike");
};
