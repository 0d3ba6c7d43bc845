// Reads single values from the YAML of a CONFIGURATION message.
#pragma once

#include <string>
#include <string_view>

namespace tern {

/// Returns the value at a path such as "uav.limits.v_max", spelled as in the YAML; empty if the YAML has none.
/// @param yaml  as processes publish it: indented by two spaces, a key a line
std::string setting(const std::string& yaml, std::string_view path);

}  // namespace tern
