// The extension module calligraphy._calligraphy: errors and components, bottom up.
#include "components.hpp"

namespace calligraphy::python {
namespace {

/// The Python class of a library error. Lives as long as the process.
template <class Exception>
py::handle type_of_error;

/// A library error that also derives from the built-in exception that Python programs expect. Messages may quote
/// arbitrary bytes of a file or path: those that are not UTF-8 are escaped.
template <class Exception>
void add_error(const py::module_& module, const char* name, PyObject* built_in, const char* documentation) {
  py::list bases;
  if (!std::is_same_v<Exception, Error>) bases.append(type_of_error<Error>);
  bases.append(py::handle(built_in));
  const std::string full = std::string("calligraphy._calligraphy.") + name;
  type_of_error<Exception> = PyErr_NewExceptionWithDoc(full.c_str(), documentation, py::tuple(bases).ptr(), nullptr);
  if (!type_of_error<Exception>) throw py::error_already_set();
  module.attr(name) = type_of_error<Exception>;
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      std::rethrow_exception(pointer);
    } catch (const Exception& error) {
      const std::string text = error.what();
      const auto size = static_cast<Py_ssize_t>(text.size());
      const auto message =
          py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(text.data(), size, "backslashreplace"));
      if (message) PyErr_SetObject(type_of_error<Exception>.ptr(), message.ptr());
    }
  });
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
  add_error<FileError>(module, "FileError", PyExc_OSError, "A file that cannot be opened, read, written or renamed.");
  add_error<FormatError>(module, "FormatError", PyExc_ValueError, "Malformed text or data.");
  add_error<DeviceError>(module, "DeviceError", PyExc_OSError, "A device that cannot be opened or has failed.");
  add_model(module);
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
  add_live(module);
  add_experiments(module);
  finish(module);
}
