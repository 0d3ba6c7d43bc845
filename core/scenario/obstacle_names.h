// The names of a world's obstacles, which messages leave out, from a process's configuration.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace tern {

/// Returns the names of the obstacles that a scenario lists, by id, from the YAML of CONFIGURATION. Obstacles without a
/// name are left out.
///
/// Ids count the generated obstacles first (`world.count`), then the listed ones. The generator `step_aside` draws its
/// number, so beside it no name is known. O(length of the text).
/// @param yaml  as ConfigDocument::effective() writes it: a key per line, two spaces per level
std::map<std::int64_t, std::string> obstacle_names(const std::string& yaml);

/// Returns "3 'gate'", or "3" without a name.
std::string with_name(std::int64_t id, const std::map<std::int64_t, std::string>& names);

}  // namespace tern
