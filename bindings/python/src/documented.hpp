// What make_docs.py takes from the C++ headers: names and documentation, the fields of structs, the members of
// enumerations.
#pragma once

#include <string_view>
#include <tuple>

namespace calligraphy::python {

/// Documentation of a public name.
struct Text {
  std::string_view owner;  ///< its class, or empty
  std::string_view name;
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
};
template <class Struct, class Type>
Field(Type Struct::*, const char*) -> Field<Struct, Type>;

// The generated header specialises these for the classes, structs and enumerations of the library. It also defines
// `texts`, ordered by owner and name.
template <class Type>
inline constexpr const char* name_of = "";
template <class Struct>
inline constexpr auto fields_of = std::tuple();
template <class Enum>
inline constexpr auto members_of = nullptr;
template <class Enum>
inline constexpr bool is_flags = false;

template <class Type>
inline constexpr bool has_fields = std::tuple_size_v<std::remove_cvref_t<decltype(fields_of<Type>)>> > 0;

/// Calls visit(field) for each field of a struct, in order.
template <class Struct, class Visit>
void each_field(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, fields_of<Struct>);
}

/// Documentation of a name in the headers; empty if there is none.
const char* text_of(std::string_view owner, std::string_view name);

}  // namespace calligraphy::python

#include "generated_docs.hpp"
