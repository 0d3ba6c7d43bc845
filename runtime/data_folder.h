// Finds the folder of recorded data that is not part of the repository (tracks of people, point clouds).
#pragma once

#include <string>

namespace tern {

/// Returns the folder in which relative data files are sought if they are not beside their scenario. It is the first of
/// these that applies, else "":
///  1. TERN_DATA, if it is set;
///  2. ../../shared/data from the scenario's folder (../shared/data from the project's root), if it exists;
///  3. ../shared/data from the working directory, if it exists.
///
/// @param environment  TERN_DATA's value, may be null
std::string data_folder(const std::string& scenario_file, const char* environment);

}  // namespace tern
