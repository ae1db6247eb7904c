// The extension module calligraphy._calligraphy: errors and components, bottom up.
#include <regex>

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

[[noreturn]] void* refuse_unfinished(std::size_t) {
  throw py::type_error("this object is not initialised: its __init__() has not been called");
}

/// A value as a literal, or "..." if it has none.
std::string literal(py::handle value) {
  const py::object text = py::repr(value);
  try {
    py::module_::import("ast").attr("literal_eval")(text);
    return text.cast<std::string>();
  } catch (const py::error_already_set&) {
    return "...";
  }
}

/// "(self, path, tolerance=0.0005)": what inspect.signature() reads, which refuses pybind11's annotations.
std::string parameters(const py::detail::function_record& function) {
  if (function.next != nullptr) return "(*args, **kwargs)";  // overloaded
  std::string text;
  for (std::size_t i = 0; i < function.nargs; ++i) {
    if (i > 0) text += ", ";
    if (i == function.nargs_pos) text += function.has_args ? "*" : "*, ";
    if (i >= function.args.size() || function.args[i].name == nullptr) {
      text += i == 0 && function.is_method ? "self" : "arg" + std::to_string(i - function.is_method);
      continue;
    }
    text += function.args[i].name;
    if (function.args[i].value) text += "=" + literal(function.args[i].value);
  }
  return "(" + text + ")";
}

/// Puts parameters in front of a documentation, where inspect.signature() finds them.
template <class Allocate, class Free>
void set_signature(const char*& documentation, const std::string& signature, Allocate allocate, Free free) {
  const std::string text = signature + "\n--\n\n" + (documentation != nullptr ? documentation : "");
  free(const_cast<char*>(documentation));
  documentation = std::strcpy(static_cast<char*>(allocate(text.size() + 1)), text.c_str());
}

/// Signatures of the functions of a class or module. Returns that of a constructor, without `self`.
std::string add_signatures(const py::object& owner) {
  std::string constructor = "()";
  for (const auto& item : owner.attr("__dict__").cast<py::dict>()) {
    const py::object member = owner.attr(item.first);
    const py::handle function = py::detail::get_function(member);  // of a method
    if (!function || PyCFunction_Check(function.ptr()) == 0) continue;
    const auto* const record = py::detail::function_record_ptr_from_PyObject(PyCFunction_GET_SELF(function.ptr()));
    if (record == nullptr) continue;
    const std::string given = parameters(*record);
    set_signature(record->def->ml_doc, record->name + given, std::malloc, std::free);
    if (record->is_constructor) constructor = std::regex_replace(given, std::regex("\\(self(, )?"), "(");
  }
  return constructor;
}

/// Objects created by __new__ alone, or used by a subclass before super().__init__(), are empty: pybind11 would
/// allocate memory for them on use and let C++ read it uninitialised. It allocates through operator_new only.
void finish_class(const py::object& type) {
  auto* const built = reinterpret_cast<PyTypeObject*>(type.ptr());
  py::detail::type_info* const info = py::detail::get_type_info(built);
  const bool is_error = PyType_IsSubtype(built, reinterpret_cast<PyTypeObject*>(PyExc_Exception)) != 0;
  if (info != nullptr) info->operator_new = refuse_unfinished;
  if (info == nullptr && !is_error) return;  // an enumeration
  const std::string name = type.attr("__name__").cast<std::string>();
  const std::string signature = name + (is_error ? "(*args)" : add_signatures(type));
  set_signature(built->tp_doc, signature, PyObject_Malloc, PyObject_Free);
}

}  // namespace
}  // namespace calligraphy::python

PYBIND11_MODULE(_calligraphy, extension) {
  calligraphy::python::Module module(extension);
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
  add_signatures(module);
  for (const auto& item : module.attr("__dict__").cast<py::dict>()) {
    if (PyType_Check(item.second.ptr()) != 0) finish_class(py::reinterpret_borrow<py::object>(item.second));
  }
}
