// The JSON schema of scenario files, for editors that complete keys and mark mistakes.
#pragma once

#include <string>

namespace tern {

/// Returns a JSON Schema (2020-12) with keys, defaults, ranges, words and meanings of every section. Every valid
/// scenario file satisfies it. The readers check more: integers written with a point, and rules between keys.
std::string scenario_schema();

}  // namespace tern
