#include "launcher/app/flight_folder.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>
#include <cstdint>
#include <ctime>
#include <string>

#include "core/base/files.h"
#include "runtime/scenario_file.h"

namespace tern {
namespace {

namespace fs = std::filesystem;

/// The scenario's seed, for the folder's name; 1 if it cannot be read.
std::uint64_t seed_of(const LaunchOptions& options) try {
  ConfigDocument document = ConfigDocument::load(options.scenario, options.overrides);
  return read_scenario(document).seed;
} catch (const ConfigError&) {
  return 1;
}

Result<fs::path> make_new_folder(const LaunchOptions& options) {
  const auto now = fmt::gmtime(std::time(nullptr));
  const std::string scenario = fs::path(options.scenario).stem();
  const fs::path first =
      fs::path(options.flights) / fmt::format("{:%Y%m%dT%H%M%SZ}-{}-{}", now, scenario, seed_of(options));
  fs::path folder = first;
  std::error_code error;
  if (first.has_parent_path()) fs::create_directories(first.parent_path(), error);
  for (int k = 2; !error; ++k) {
    if (fs::create_directory(folder, error)) return folder;
    folder = fmt::format("{}-{}", first.string(), k);
  }
  return fail(fmt::format("{} cannot be made: {}", first.string(), error.message()));
}

Result<fs::path> make_named_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fail(fmt::format("{} cannot be made: {}", folder.string(), error.message()));
  return folder;
}

/// Locks the folder until this process ends. @return false if another process has locked it
bool hold(const fs::path& folder) {
  const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  return fd < 0 || flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;  // some file systems have no locks
}

}  // namespace

Result<fs::path> make_flight_folder(const LaunchOptions& options) {
  const Result<fs::path> folder = options.record.empty() ? make_new_folder(options) : make_named_folder(options.record);
  if (!folder) return folder;
  std::error_code error;
  if (!hold(*folder) || fs::exists(*folder / "command", error) || fs::exists(*folder / "flight.lcm", error)) {
    return fail(fmt::format("{} already holds a flight; choose another folder", folder->string()));
  }
  const fs::path probe = *folder / "failure.new";
  if (!write_text(probe, "")) return fail(folder->string() + " cannot be written");
  for (const fs::path& left : {probe, *folder / "failure", *folder / "summary.json"}) fs::remove(left, error);
  return fs::canonical(*folder);
}

}  // namespace tern
