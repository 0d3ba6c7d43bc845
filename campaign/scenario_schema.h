// The scenario file as a JSON schema, for editors that complete keys and mark mistakes.
#pragma once

#include <string>

namespace tern {

/// JSON Schema (2020-12), made from what the readers of all sections read: keys, defaults, ranges, words, meanings.
/// Every file that the readers take fits; they refuse more (integers with a point, rules between keys).
std::string scenario_schema();

}  // namespace tern
