#include "runtime/platform.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "core/wire/message_limits.h"

namespace tern {
namespace {

/// The features of the first CPU by which libm and BLAS choose their code, sorted.
std::string cpu_features() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    if (line.starts_with("flags") || line.starts_with("Features")) break;
  }
  std::set<std::string> chosen;
  std::istringstream words(line.substr(std::min(line.find(':') + 1, line.size())));
  for (std::string word; words >> word;) {
    for (const char* family : {"avx", "fma", "sse4", "asimd", "sve"}) {
      if (word.starts_with(family)) chosen.insert(word);
    }
  }
  std::string text;
  for (const std::string& word : chosen) text += " " + word;
  return text;
}

std::string machine() {
  utsname name{};
  return uname(&name) == 0 ? name.machine : "unknown machine";
}

/// The file that provides ddot, with Debian's alternatives resolved.
std::string blas() {
  Dl_info info{};
  void* const ddot = dlsym(RTLD_DEFAULT, "ddot_");
  if (ddot == nullptr || dladdr(ddot, &info) == 0 || info.dli_fname == nullptr) return "none";
  std::error_code failed;
  const auto file = std::filesystem::canonical(info.dli_fname, failed);
  return failed ? info.dli_fname : file.string();
}

std::string describe() {
  std::string text = fmt::format("{}; {}{}; glibc {}; BLAS {}", TERN_COMPILER, machine(), cpu_features(),
                                 gnu_get_libc_version(), blas());
  if (const char* tunables = std::getenv("GLIBC_TUNABLES")) text += fmt::format("; GLIBC_TUNABLES {}", tunables);
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.substr(0, kMaxPlatformText);
}

}  // namespace

const std::string& platform() {
  static const std::string text = describe();
  return text;
}

}  // namespace tern
