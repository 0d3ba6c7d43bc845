// Names of the ASPRS point classes (LAS 1.4 – R15, tables 9 and 17), and groups of classes for configurations.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tern {

/// Returns the name of a class: "ground", "building" …; "class_<number>" if the number has no standard name.
std::string class_name(std::uint8_t number);

/// Returns the class numbers of a configured name; empty if there is no such name. A name is a standard name,
/// `class_<number>` or the number alone, or a group: `vegetation` (3–5), `wire` (13, 14, 16), `noise` (7, 18), `road`
/// (11).
std::vector<std::uint8_t> class_numbers(std::string_view name);

/// True if the name is a group. A standard name in the same table has priority over a group.
bool is_class_group(std::string_view name);

}  // namespace tern
