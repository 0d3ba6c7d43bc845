#include "runtime/data_folder.h"

#include <filesystem>

namespace tern {

std::string data_folder(const std::string& scenario_file, const char* environment) {
  namespace fs = std::filesystem;
  if (environment != nullptr && *environment != '\0') return environment;
  const fs::path shared = fs::path("shared") / "data";
  for (const fs::path& place :
       {fs::path(scenario_file).parent_path() / ".." / ".." / shared, fs::path("..") / shared}) {
    std::error_code ignored;
    if (fs::is_directory(place, ignored)) return place.lexically_normal().string();
  }
  return "";
}

}  // namespace tern
