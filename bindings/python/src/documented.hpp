// What make_docs.py takes from the C++ headers: names, documentation, fields and members; and pybind11's classes and
// modules with that documentation.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>

#include <pybind11/pybind11.h>

namespace calligraphy::python {

namespace py = pybind11;

/// Documentation of a name. The generated header defines `texts`, ordered by owner and name.
struct Text {
  std::string_view owner;  ///< its class, or empty
  std::string_view name;   ///< a function also as "name(Type)", by its first argument
  const char* text;
};

template <class Enum>
struct Member {
  Enum value;
  const char* name;
  const char* text;
};
template <class Enum>
Member(Enum, const char*, const char*) -> Member<Enum>;

template <class Struct, class Type>
struct Field {
  Type Struct::*member;
  const char* name;
  const char* text;
};
template <class Struct, class Type>
Field(Type Struct::*, const char*, const char*) -> Field<Struct, Type>;

// Defined by the generated header for the classes, structs and enumerations of the library.
template <class Type>
inline constexpr std::string_view name_of = "";
template <class Struct>
inline constexpr auto fields_of = std::tuple();
template <class Enum>
inline constexpr auto members_of = nullptr;
template <class Enum>
inline constexpr bool is_flags = false;

}  // namespace calligraphy::python

#include "generated_docs.hpp"

namespace calligraphy::python {

void there_is_no_such_name_in_the_headers();
void the_name_is_not_documented_in_the_headers();

consteval const char* text_of(std::string_view owner, std::string_view name) {
  const auto before = [=](const Text& each) { return each.owner != owner ? each.owner < owner : each.name < name; };
  const Text* const found = std::partition_point(std::begin(texts), std::end(texts), before);
  if (found == std::end(texts) || found->owner != owner || found->name != name) there_is_no_such_name_in_the_headers();
  return found->text;
}

/// A name that the C++ headers lack.
struct InPython {
  const char* name;
  const char* text;
};
/// A name with something to add to the text of the headers.
struct Also {
  const char* name;
  const char* more;
};
/// A name that the headers have as another, such as "name(Type)".
struct As {
  const char* name;
  const char* in_cpp;
};

/// A name and its documentation: from the headers, where the compiler refuses a name that they do not have.
template <class Owner>
struct Documented {
  consteval Documented(const char* called) : Documented(As{called, called}) {}
  consteval Documented(As known) : name(known.name) {
    if (!std::string_view(name).starts_with("__")) text = text_of(name_of<Owner>, known.in_cpp);
  }
  consteval Documented(Also known) : Documented(known.name) { more = known.more; }
  constexpr Documented(InPython own) : name(own.name), text(own.text) {}

  std::string documentation() const { return *more == '\0' ? text : std::string(text) + ' ' + more; }

  const char* name;
  const char* text = "";
  const char* more = "";
};

/// pybind11's class of a C++ class, documented.
template <class Type, class... Options>
class Class : public py::class_<Type, Options...> {
  using Base = py::class_<Type, Options...>;
  using Name = Documented<Type>;

 public:
  /// With the text of the headers, or one among the extra arguments.
  template <class... Extra>
  explicit Class(const py::module_& module, const Extra&... extra)
      : Base(module, name_of<Type>.data(), class_text<Extra...>(), extra...) {}

  template <class Constructor, class... Extra>
  requires requires(Constructor init, Base& type) { std::move(init).execute(type); }
  Class& def(Constructor init, const Extra&... extra) {
    Base::def(std::move(init), extra...);
    return *this;
  }
  template <class Function, class... Extra>
  Class& def(Name name, Function&& function, const Extra&... extra) {
    Base::def(name.name, function, name.documentation().c_str(), extra...);
    return *this;
  }
  template <class Function, class... Extra>
  Class& def_static(Name name, Function&& function, const Extra&... extra) {
    Base::def_static(name.name, function, name.documentation().c_str(), extra...);
    return *this;
  }
  template <class Get, class... Extra>
  Class& def_property_readonly(Name name, Get&& get, const Extra&... extra) {
    Base::def_property_readonly(name.name, get, name.documentation().c_str(), extra...);
    return *this;
  }
  template <class Get, class Set>
  Class& def_property(Name name, Get&& get, Set&& set) {
    Base::def_property(name.name, get, set, name.documentation().c_str());
    return *this;
  }
  template <class Member>
  Class& def_readonly(Name name, Member Type::*member) {
    Base::def_readonly(name.name, member, name.documentation().c_str());
    return *this;
  }
  template <class Member>
  Class& def_readwrite(Name name, Member Type::*member) {
    Base::def_readwrite(name.name, member, name.documentation().c_str());
    return *this;
  }

 private:
  template <class... Extra>
  static consteval const char* class_text() {
    if constexpr ((std::is_convertible_v<const Extra&, const char*> || ...)) {
      return "";
    } else {
      return text_of("", name_of<Type>);
    }
  }
};

/// pybind11's module, with documented functions.
class Module : public py::module_ {
 public:
  explicit Module(const py::module_& module) : py::module_(module) {}

  template <class Function, class... Extra>
  Module& def(Documented<void> name, Function&& function, const Extra&... extra) {
    py::module_::def(name.name, function, name.documentation().c_str(), extra...);
    return *this;
  }
};

}  // namespace calligraphy::python
