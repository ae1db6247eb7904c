// The return type of a user's function, for templates that accept exactly one type and say so.
#pragma once

#include <concepts>
#include <type_traits>

namespace calligraphy::detail {

template <class Function, class... Arguments>
struct ReturnedBy {
  using type = void;
};
template <class Function, class... Arguments>
requires std::invocable<Function, Arguments...>
struct ReturnedBy<Function, Arguments...> {
  using type = std::remove_cvref_t<std::invoke_result_t<Function, Arguments...>>;
};

/// The return type of a call, without reference and const; void if the call is not possible.
template <class Function, class... Arguments>
using Returned = typename ReturnedBy<Function, Arguments...>::type;

}  // namespace calligraphy::detail
