// What a user's function returns, for a template that takes exactly one type and says so.
#pragma once

#include <concepts>
#include <type_traits>

namespace calligraphy {

template <class Function, class... Arguments>
struct ReturnedBy {
  using type = void;
};
template <class Function, class... Arguments>
requires std::invocable<Function, Arguments...>
struct ReturnedBy<Function, Arguments...> {
  using type = std::remove_cvref_t<std::invoke_result_t<Function, Arguments...>>;
};

/// The type that a call returns, without reference and const; void if the call is not possible.
template <class Function, class... Arguments>
using Returned = typename ReturnedBy<Function, Arguments...>::type;

}  // namespace calligraphy
