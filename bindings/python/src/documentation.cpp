// Documentation from the C++ headers, and signatures for inspect.signature().
#include <cstdlib>

#include "components.hpp"

namespace calligraphy::python {
namespace {

/// The text of the headers; a binding's own text replaces it, or follows it if it begins with "+ ".
/// @throws ImportError when there is neither, which fails the build too
std::string complete(const std::string& owner, const std::string& name, const std::string& own) {
  if (!own.empty() && own[0] != '+') return own;
  const std::string text = text_of(owner, name);
  if (text.empty())
    throw py::import_error(owner + "." + name + " has no documentation, as in the headers of the library");
  return text + (own.empty() ? own : own.substr(1));
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

/// "(self, path, tolerance=0.0005)": pybind11's own signature has types, which inspect.signature() refuses.
std::string parameters(const py::detail::function_record& function) {
  if (function.next != nullptr) return "(*args, **kwargs)";  // overloaded
  std::string text;
  for (std::size_t i = 0; i < function.nargs; ++i) {
    if (i > 0) text += ", ";
    if (i == function.nargs_pos) text += function.has_args ? "*" : "*, ";
    if (i >= function.args.size() || function.args[i].name == nullptr) {
      text += i == 0 && function.is_method ? "self" : i == function.nargs_pos ? "args" : "arg" + std::to_string(i);
      continue;
    }
    text += function.args[i].name;
    if (function.args[i].value) text += "=" + literal(function.args[i].value);
  }
  return "(" + text + ")";
}

/// Replaces a docstring, which begins with the signature so that inspect.signature() finds it.
template <class Allocate, class Free>
void replace(const char*& old, const std::string& signature, const std::string& text, Allocate allocate, Free free) {
  const std::string all = signature + "\n--\n\n" + text;
  free(const_cast<char*>(old));
  old = std::strcpy(static_cast<char*>(allocate(all.size() + 1)), all.c_str());
}

/// Completes the functions and properties of a class or module. Returns the parameters of a constructor without `self`.
std::string document_members(const py::object& owner, const std::string& name) {
  std::string constructor = "()";
  for (const auto& item : owner.attr("__dict__").cast<py::dict>()) {
    const auto called = item.first.cast<std::string>();
    if (py::isinstance(item.second, py::module_::import("builtins").attr("property"))) {
      item.second.attr("__doc__") = complete(name, called, py::str(item.second.attr("__doc__")));
    }
    const py::object member = owner.attr(item.first);
    const py::handle function = py::detail::get_function(member);  // of a method
    if (!function || PyCFunction_Check(function.ptr()) == 0) continue;
    const auto* const record = py::detail::function_record_ptr_from_PyObject(PyCFunction_GET_SELF(function.ptr()));
    if (record == nullptr || record->def->ml_doc == nullptr) continue;  // not of this module
    std::string text = record->def->ml_doc;                             // the types, and the text of the binding
    const std::string own = record->doc != nullptr ? record->doc : "";
    const std::string full = called.starts_with("__") ? own : complete(name, called, own);
    if (own.empty() && !full.empty()) text += '\n' + full + '\n';
    if (!own.empty()) text.replace(text.find(own), own.size(), full);
    const std::string given = parameters(*record);
    replace(record->def->ml_doc, called + given, text, std::malloc, std::free);
    if (!record->is_constructor) continue;
    const std::string_view self = given == "(self)" ? "(self" : "(self, ";
    constructor = given.starts_with(self) ? '(' + given.substr(self.size()) : given;
  }
  return constructor;
}

/// pydoc shows base classes and what functions are bound to: the names of pybind11 mean nothing to users.
void hide_names_of_pybind11(const py::module_& module) {
  const auto rename = [](const py::object& type, const char* name) {
    type.attr("__name__") = name;
    type.attr("__qualname__") = name;
    type.attr("__module__") = "builtins";
  };
  rename(py::reinterpret_borrow<py::object>(py::detail::get_internals().instance_base), "object");
  rename(py::type::of(module.attr("hint_text").attr("__self__")), "module");
}

[[noreturn]] void* refuse_unfinished(std::size_t) {
  throw py::type_error("this object is not initialised: its __init__() has not been called");
}

}  // namespace

const char* text_of(std::string_view owner, std::string_view name) {
  const std::tuple sought(owner, name);
  const auto before = [&](const Text& each) { return std::tuple(each.owner, each.name) < sought; };
  const Text* const found = std::partition_point(std::begin(texts), std::end(texts), before);
  return found != std::end(texts) && std::tuple(found->owner, found->name) == sought ? found->text : "";
}

void finish(const py::module_& module) {
  hide_names_of_pybind11(module);
  document_members(module, "");
  for (const auto& item : module.attr("__dict__").cast<py::dict>()) {
    if (PyType_Check(item.second.ptr()) == 0) continue;
    const auto type = py::reinterpret_borrow<py::object>(item.second);
    auto* const built = reinterpret_cast<PyTypeObject*>(type.ptr());
    const auto name = type.attr("__name__").cast<std::string>();
    if (py::detail::type_info* const info = py::detail::get_type_info(built)) {
      // Objects created by __new__ alone, or used by a subclass before super().__init__(), are empty: pybind11 would
      // allocate memory for them on use and let C++ read it uninitialised. It allocates through operator_new only.
      info->operator_new = refuse_unfinished;
      const py::object own = type.attr("__doc__");
      type.attr("__doc__") = complete("", name, own.is_none() ? "" : own.cast<std::string>());
      replace(built->tp_doc, name + document_members(type, name), "", PyObject_Malloc, PyObject_Free);
    } else if (PyType_IsSubtype(built, reinterpret_cast<PyTypeObject*>(PyExc_Exception)) != 0) {
      replace(built->tp_doc, name + "(*args)", "", PyObject_Malloc, PyObject_Free);
    }
  }
}

}  // namespace calligraphy::python
