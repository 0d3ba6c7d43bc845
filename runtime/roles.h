// The role that owns each channel, and the channels that each process publishes or receives (messages/channels.h).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "messages/channels.h"

namespace tern {

inline constexpr Role kRoles[] = {Role::Vehicle,  Role::Predictor, Role::Planner, Role::Mapper,
                                  Role::Operator, Role::Observer,  Role::Executor};

/// "vehicle", "predictor", "planner", "mapper", "operator", "observer", "executor".
const char* to_string(Role role);
/// @return the role of that name, or nullopt if there is none.
std::optional<Role> role_named(std::string_view name);

/// The role that owns a channel. Nullopt for HEARTBEAT, CONFIGURATION and channels that are not Tern's: on these each
/// role publishes with its own key.
/// @param channel  without a vehicle's suffix
std::optional<Role> role_of(std::string_view channel);

/// The role of one of Tern's processes ("tern-planner"); nullopt for other names.
std::optional<Role> role_of_process(std::string_view process);

/// One of Tern's processes. All of them also publish and receive HEARTBEAT and CONFIGURATION.
struct ProcessRole {
  std::string_view process;
  Role role;
  std::vector<std::string_view> channels;  ///< channels owned by one role that it publishes or receives
};

/// All of Tern's processes.
const std::vector<ProcessRole>& process_roles();

}  // namespace tern
