// Expected failures are values: a Result<T> holds a T, or an Error that a user can act on.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace tern {

/// An explanation for the person who must mend the failure. It names file, line, key, value and limit where they
/// apply.
struct Error {
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

/// Returns an Error as the value of any Result<T>.
inline tl::unexpected<Error> fail(std::string message) { return tl::unexpected<Error>(Error{std::move(message)}); }

}  // namespace tern
