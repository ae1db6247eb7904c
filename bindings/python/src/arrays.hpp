// NumPy arrays in and out: checked against the shape that is expected, shared where the memory allows.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>

#include <calligraphy/model/point.hpp>

namespace calligraphy::python {

namespace py = pybind11;

/// Whatever NumPy can make an array of; what it may hold is checked by the functions below.
class ArrayLike : public py::object {
  PYBIND11_OBJECT_DEFAULT(ArrayLike, py::object, any_object)

 private:
  static bool any_object(PyObject* value) { return value != nullptr; }
};

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Real numbers as contiguous doubles: the array itself where it is that already, else a copy. `columns` 0: one
/// dimension. An empty list is taken for an array without rows.
/// @throws InvalidValue naming the argument, the shape or type expected and the one given
Doubles doubles(py::handle value, const char* name, py::ssize_t columns = 0);

/// The same of a fixed length.
Doubles fixed_doubles(py::handle value, const char* name, py::ssize_t length);
Point point(py::handle value, const char* name);
Eigen::Vector3d vector(py::handle value, const char* name);
Eigen::Matrix3d matrix(py::handle value, const char* name);

/// (n, 2), copied.
std::vector<Point> points(py::handle value, const char* name);

/// Rows of an (n, 2) or (n, 3) array of doubles where they are.
inline Eigen::Map<const Point> point_at(const double* data, py::ssize_t row) {
  return Eigen::Map<const Point>(data + 2 * row);
}
inline Eigen::Map<const Eigen::Vector3d> vector_at(const double* data, py::ssize_t row) {
  return Eigen::Map<const Eigen::Vector3d>(data + 3 * row);
}

/// A view of doubles that `owner` keeps alive; `owner` must not move them.
py::array_t<double> view(const double* data, std::vector<py::ssize_t> shape, py::handle owner, bool writable);

/// A copy.
py::array_t<double> array_of(const Point& value);
py::array_t<double> array_of(const Eigen::Vector3d& value);
template <class Points>
py::array_t<double> array_of_points(const Points& values) {
  py::array_t<double> result({static_cast<py::ssize_t>(values.size()), py::ssize_t{2}});
  double* to = result.mutable_data();
  for (const Point& value : values) *to++ = value.x(), *to++ = value.y();
  return result;
}

/// The columns of a structured array whose rows are structs in memory: each member with its name, type and place.
template <class Row>
class Columns {
 public:
  template <class Member>
  Columns& add(const char* name, const Row& row, const Member& member) {
    names_.append(name);
    formats_.append(format<Member>());
    offsets_.append(reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&row));
    return *this;
  }
  py::dtype dtype() const { return py::dtype(names_, formats_, offsets_, sizeof(Row)); }

 private:
  template <class Member>
  static std::string format() {
    if constexpr (std::is_same_v<Member, bool>) {
      return "?";
    } else if constexpr (std::is_enum_v<Member>) {
      return std::string(std::is_signed_v<std::underlying_type_t<Member>> ? "i" : "u") + std::to_string(sizeof(Member));
    } else if constexpr (std::is_floating_point_v<Member>) {
      return "f" + std::to_string(sizeof(Member));
    } else if constexpr (std::is_integral_v<Member>) {
      return "i" + std::to_string(sizeof(Member));
    } else {
      return "(" + std::to_string(Member::RowsAtCompileTime) + ",)f8";
    }
  }

  py::list names_, formats_, offsets_;
};

/// A structured array over the rows, which it owns from now on.
template <class Row>
py::array structured(const py::dtype& dtype, std::vector<Row>&& rows) {
  auto* const owned = new std::vector<Row>(std::move(rows));
  const py::capsule owner(owned, [](void* pointer) { delete static_cast<std::vector<Row>*>(pointer); });
  return py::array(dtype, {static_cast<py::ssize_t>(owned->size())}, {static_cast<py::ssize_t>(sizeof(Row))},
                   owned->data(), owner);
}

}  // namespace calligraphy::python

template <>
struct pybind11::detail::handle_type_name<calligraphy::python::ArrayLike> {
  static constexpr auto name = const_name("numpy.typing.ArrayLike");
};
