// The extension module calligraphy._calligraphy: errors and components, bottom up.
#include <cerrno>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// The Python class of a library error. Lives as long as the process.
template <class Exception>
py::handle type_of_error;

/// The Python class of a FileError for a file that does not exist.
py::handle file_not_found;

py::handle new_type(const char* name, const py::list& bases, const char* documentation) {
  const std::string full = std::string("calligraphy._calligraphy.") + name;
  py::dict members;  // str() of an OSError shows errno and filename, if it has them
  members["__str__"] = py::handle(PyExc_BaseException).attr("__str__");
  const py::handle type =
      PyErr_NewExceptionWithDoc(full.c_str(), documentation, py::tuple(bases).ptr(), members.ptr());
  if (!type) throw py::error_already_set();
  return type;
}

void raise(const Error&, py::handle type, const py::object& message) { PyErr_SetObject(type.ptr(), message.ptr()); }

void raise(const FileError& error, py::handle type, const py::object& message) {
  const py::handle chosen = error.code() == ENOENT ? file_not_found : type;
  const auto raised = py::reinterpret_steal<py::object>(PyObject_CallOneArg(chosen.ptr(), message.ptr()));
  if (!raised) return;
  if (error.code() != 0) raised.attr("errno") = error.code();
  const std::string& path = error.path();
  if (!path.empty()) {
    const auto size = static_cast<Py_ssize_t>(path.size());
    raised.attr("filename") = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefaultAndSize(path.data(), size));
  }
  PyErr_SetObject(chosen.ptr(), raised.ptr());
}

/// A library error that also derives from the built-in exception that Python programs expect. Messages may quote
/// arbitrary bytes of a file or path: those that are not UTF-8 are escaped.
template <class Exception>
void add_error(const py::module_& module, const char* name, PyObject* built_in, const char* documentation) {
  py::list bases;
  if (!std::is_same_v<Exception, Error>) bases.append(type_of_error<Error>);
  bases.append(py::handle(built_in));
  type_of_error<Exception> = new_type(name, bases, documentation);
  module.attr(name) = type_of_error<Exception>;
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      std::rethrow_exception(pointer);
    } catch (const Exception& error) {
      const std::string text = error.what();
      const auto size = static_cast<Py_ssize_t>(text.size());
      const auto message =
          py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(text.data(), size, "backslashreplace"));
      if (message) raise(error, type_of_error<Exception>, message);
    }
  });
}

void add_file_not_found(const py::module_& module) {
  py::list bases;
  bases.append(type_of_error<FileError>);
  bases.append(py::handle(PyExc_FileNotFoundError));
  file_not_found = new_type("FileNotFound", bases, "A file that does not exist.");
  module.attr("FileNotFound") = file_not_found;
}

}  // namespace
}  // namespace calligraphy::python

PYBIND11_MODULE(_calligraphy, module) {
  module.attr("__version__") = CALLIGRAPHY_VERSION;
  module.attr("backends") = pybind11::make_tuple(CALLIGRAPHY_BACKENDS);
  module.doc() = "Haptic guidance for writing Chinese characters: the C++ library. SI units; character shapes in em.";
  using namespace calligraphy;
  using namespace calligraphy::python;
  add_error<Error>(module, "Error", PyExc_RuntimeError, "Base of all errors that this library raises.");
  add_error<ValueError>(module, "InvalidValue", PyExc_ValueError,
                        "An argument or option out of range (calligraphy::ValueError in C++).");
  add_error<FileError>(module, "FileError", PyExc_OSError,
                       "A file that cannot be opened, read, written or renamed. `errno` and `filename` are None if they "
                       "are not known.");
  add_file_not_found(module);
  add_error<FormatError>(module, "FormatError", PyExc_ValueError, "Malformed text or data.");
  add_error<DeviceError>(module, "DeviceError", PyExc_OSError, "A device that cannot be opened or has failed.");
  add_model(module);
  add_judge(module);
  add_collision(module);
  add_devices(module);
  add_kinematics(module);
#ifdef CALLIGRAPHY_HAS_PHANTOM
  add_phantom(module);
#endif
#ifdef CALLIGRAPHY_HAS_OPENHAPTICS
  add_openhaptics(module);
#endif
  add_render(module);
  add_practice(module);
  add_lesson(module);
  add_live(module);
  add_experiments(module);
  finish(module);
}
