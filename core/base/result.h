// Expected failure is a value: Result<T> is T or an Error that a user can act on.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace tern {

/// What went wrong, in words for the person who must mend it (file, line, key, value, limit where they apply).
struct Error {
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string message) { return tl::unexpected<Error>(Error{std::move(message)}); }

}  // namespace tern
