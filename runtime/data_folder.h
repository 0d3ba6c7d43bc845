// Where recorded data lies that is not part of the repository (tracks of people, point clouds).
#pragma once

#include <string>

namespace tern {

/// The folder in which relative data files are sought when they are not beside their scenario: TERN_DATA if it is set.
/// Else the first that exists of ../../shared/data from the scenario's folder (../shared/data from the project's root)
/// and ../shared/data from the working directory. "" when there is none.
/// @param environment  TERN_DATA's value, may be null
std::string data_folder(const std::string& scenario_file, const char* environment);

}  // namespace tern
