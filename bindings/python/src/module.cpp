// The extension module calligraphy._calligraphy: the rooms from the ground up, and the errors.
#include "rooms.hpp"

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>

#include <calligraphy/base/error.hpp>

namespace py = pybind11;

namespace calligraphy::python {
namespace {

PyObject* error_type = nullptr;
PyObject* value_type = nullptr;
PyObject* file_type = nullptr;
PyObject* format_type = nullptr;
PyObject* device_type = nullptr;

/// An error of this library that is also the built-in one that Python programs expect. Lives as long as the process.
PyObject* make_error(py::module_& module, const char* name, PyObject* base, PyObject* built_in, const char* doc) {
  py::list bases;
  if (base != nullptr) bases.append(py::handle(base));
  bases.append(py::handle(built_in));
  const std::string full = std::string("calligraphy._calligraphy.") + name;
  PyObject* const type = PyErr_NewExceptionWithDoc(full.c_str(), doc, py::tuple(bases).ptr(), nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.attr(name) = py::handle(type);
  return type;
}

/// What is quoted from a file or a path may be any bytes: those that are no UTF-8 are escaped.
void raise(PyObject* type, const std::exception& error) {
  const std::string_view text = error.what();
  PyObject* const message = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace");
  if (message == nullptr) return;
  PyErr_SetObject(type, message);
  Py_DECREF(message);
}

/// pybind11 before 2.12 reads the arrays of NumPy 2 as if they were those of NumPy 1, without a word.
void check_numpy() {
#if PYBIND11_VERSION_MAJOR == 2 && PYBIND11_VERSION_MINOR < 12
  const auto version = py::module_::import("numpy").attr("__version__").cast<std::string>();
  if (std::stoi(version) >= 2) {
    throw py::import_error(
        "calligraphy was built with pybind11 " PYBIND11_TOSTRING(PYBIND11_VERSION_MAJOR) "." PYBIND11_TOSTRING(
            PYBIND11_VERSION_MINOR) ", which knows NumPy 1 alone, not " +
        version + ": install numpy<2, or build calligraphy with pybind11 2.12 or later");
  }
#endif
}

[[noreturn]] void* refuse_unfinished(std::size_t) {
  throw py::type_error("this object is not finished: its __init__() has not been called");
}

/// Objects that __new__ alone made, or that a subclass uses before it calls super().__init__(), hold nothing: pybind11
/// would find room for them and let C++ read what is there. It makes that room by this function alone. And the oldest
/// two ways to pickle go round __new__, which pybind11 answers by abort().
void guard_classes(py::module_& module) {
  const py::object reduce = py::module_::import("builtins").attr("object").attr("__reduce_ex__");
  for (const auto& item : module.attr("__dict__").cast<py::dict>()) {
    if (PyType_Check(item.second.ptr()) == 0) continue;
    auto* const type = reinterpret_cast<PyTypeObject*>(item.second.ptr());
    py::detail::type_info* const info = py::detail::get_type_info(type);
    if (info == nullptr) continue;
    info->operator_new = refuse_unfinished;
    py::setattr(
        item.second, "__reduce_ex__",
        py::cpp_function([reduce](const py::object& self, int protocol) { return reduce(self, std::max(protocol, 2)); },
                         py::name("__reduce_ex__"), py::is_method(item.second)));
  }
}

}  // namespace

void add_errors(py::module_& module) {
  error_type = make_error(module, "Error", nullptr, PyExc_RuntimeError, "Base of everything that this library raises.");
  value_type = make_error(module, "InvalidValue", error_type, PyExc_ValueError,
                          "An argument or option outside its domain (calligraphy::ValueError in C++).");
  file_type = make_error(module, "FileError", error_type, PyExc_OSError,
                         "A file that cannot be opened, read, written or renamed.");
  format_type =
      make_error(module, "FormatError", error_type, PyExc_ValueError, "Text or data that is not what it should be.");
  device_type =
      make_error(module, "DeviceError", error_type, PyExc_OSError, "A device that cannot be opened or failed.");
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const ValueError& error) {
      raise(value_type, error);
    } catch (const FileError& error) {
      raise(file_type, error);
    } catch (const FormatError& error) {
      raise(format_type, error);
    } catch (const DeviceError& error) {
      raise(device_type, error);
    } catch (const Error& error) {
      raise(error_type, error);
    }
  });
}

}  // namespace calligraphy::python

PYBIND11_MODULE(_calligraphy, module) {
  using namespace calligraphy::python;
  check_numpy();
  module.attr("__version__") = CALLIGRAPHY_VERSION;
  module.attr("backends") = pybind11::make_tuple(CALLIGRAPHY_BACKENDS);
  module.doc() =
      "Haptic guidance for writing Chinese characters: the C++ library, thin. SI units; character shapes in em.";
  py::options options;
  options.disable_enum_members_docstring();
  add_errors(module);
  add_model(module);
  add_collision(module);
  add_devices(module);
  add_kinematics(module);
  add_phantom(module);
  add_openhaptics(module);
  add_render(module);
  add_practice(module);
  add_live(module);
  add_trials(module);
  guard_classes(module);
}
