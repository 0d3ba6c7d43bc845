// The names of a world's obstacles, which messages leave out, from a process's configuration.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace tern {

/// Returns the names of a world's obstacles, by id, from the YAML of CONFIGURATION. Obstacles without a name are left
/// out. O(length of the text).
///
/// * Every process lists the scenario's obstacles. Ids count the generated obstacles first (`world.count`), then the
///   listed ones. The generator `step_aside` draws its number, so with it the ids of listed obstacles are unknown.
/// * tern-simulator adds a name_note() for each obstacle of its world, recorded ones included.
/// @param yaml  as ConfigDocument::effective() writes it: a key per line, two spaces per level; then the notes
std::map<std::int64_t, std::string> obstacle_names(const std::string& yaml);

/// Returns the note on an obstacle's name, without the comment's "# ": "obstacle 3: gate".
std::string name_note(std::int64_t id, const std::string& name);

/// Returns "3 'gate'", or "3" without a name.
std::string with_name(std::int64_t id, const std::map<std::int64_t, std::string>& names);

}  // namespace tern
