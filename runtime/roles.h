// Who may speak on which channel, and who hears it: by the table of channels.
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

/// Whose channel it is; nothing for HEARTBEAT, CONFIGURATION and channels that are not Tern's: on these each role
/// speaks for itself.
/// @param channel  without a vehicle's suffix
std::optional<Role> role_of(std::string_view channel);

/// The role of one of Tern's processes ("tern-planner"); nothing for other names.
std::optional<Role> role_of_process(std::string_view process);

/// What one of Tern's processes takes part in, besides HEARTBEAT and CONFIGURATION, which all say and hear (clocks are
/// compared by heartbeats).
struct ProcessRole {
  std::string_view process;
  Role role;
  std::vector<std::string_view> channels;  ///< that it says or hears and that are one role's
};

/// All of Tern's processes.
const std::vector<ProcessRole>& process_roles();

}  // namespace tern
