// Names of the ASPRS classes (LAS 1.4 – R15, tables 9 and 17), and the groups by which a configuration may speak of
// them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tern {

/// "ground", "building" …; "class_<number>" for numbers without a standard name.
std::string class_name(std::uint8_t number);

/// The class numbers that a configured name means: a standard name; `class_<number>`; or a group: `vegetation` (3–5),
/// `wire` (13, 14, 16), `noise` (7, 18), `road` (11). Empty: no such name.
std::vector<std::uint8_t> class_numbers(std::string_view name);

/// Is the name a group? A standard name of the same table wins over it.
bool is_class_group(std::string_view name);

}  // namespace tern
