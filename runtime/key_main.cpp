// tern-key: makes files of keys. A key is on no command line and in no environment.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "runtime/keys.h"

namespace tern {
namespace {

constexpr int kExitMistake = 2;

int complain(const std::string& what) {
  fmt::print(stderr, "tern-key: {}\n", what);
  return kExitMistake;
}

std::string reason() { return std::strerror(errno); }

/// @return whether all of the text went into the descriptor. Its memory is overwritten.
bool write_all(int fd, std::string text) {
  const bool ok = write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  wipe({reinterpret_cast<std::uint8_t*>(text.data()), text.size()});
  return ok;
}

/// A new file that only its owner can read; what exists is never overwritten.
int write_file(const std::string& path, std::string text) {
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (fd < 0) return complain(path + ": cannot be made: " + reason());
  if (!write_all(fd, std::move(text)) || fsync(fd) != 0 || close(fd) != 0) return complain(path + ": " + reason());
  return 0;
}

int make(const std::string& path) { return write_file(path, to_hex(random_key()) + "\n"); }

int derive(const std::string& master_path, const std::string& process, const std::string& path) {
  if (!role_of_process(process)) return complain(process + ": not one of Tern's processes");
  const auto master = read_master_key(master_path);
  if (!master) return complain(master.error().message);
  return write_file(path, KeyRing::derive(*master, process).spell());
}

int run(int argc, char** argv) {
  CLI::App app("Makes the keys by which Tern's processes sign their messages", "tern-key");
  app.require_subcommand(1);
  std::string master, process, out;
  auto* const make_command = app.add_subcommand("new", "Write a new random master key, mode 600");
  make_command->add_option("FILE", out)->required();
  auto* const derive_command = app.add_subcommand("derive", "Write what one process needs of a master key, mode 600");
  derive_command->add_option("MASTER", master)->required();
  derive_command->add_option("PROCESS", process, "As tern-planner")->required();
  derive_command->add_option("FILE", out)->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitMistake;
  }
  if (*make_command) return make(out);
  return derive(master, process, out);
}

}  // namespace
}  // namespace tern

int main(int argc, char** argv) { return tern::run(argc, argv); }
