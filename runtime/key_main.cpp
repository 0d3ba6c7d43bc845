// tern-key: makes keys, and hands them on. A key is on no command line and in no environment.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "runtime/keys.h"

namespace tern {
namespace {

constexpr char kFdsVariable[] = "TERN_KEY_FDS";
constexpr int kExitMistake = 2, kExitNotRun = 127;

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

/// A file in memory without a name, sealed, that programs which are started inherit. @return its descriptor, or −1.
int hold_in_memory(std::string text) {
  const int fd = memfd_create("tern-keys", MFD_ALLOW_SEALING);
  if (fd < 0) return -1;
  const bool ok = write_all(fd, std::move(text)) &&
                  fcntl(fd, F_ADD_SEALS, F_SEAL_WRITE | F_SEAL_GROW | F_SEAL_SHRINK | F_SEAL_SEAL) == 0;
  return ok ? fd : -1;
}

int make(const std::string& path) { return write_file(path, to_hex(random_key()) + "\n"); }

int derive(const std::string& master_path, const std::string& process, const std::string& path) {
  if (!role_of_process(process)) return complain(process + ": not one of Tern's processes");
  const auto master = read_master_key(master_path);
  if (!master) return complain(master.error().message);
  return write_file(path, KeyRing::derive(*master, process).spell());
}

int hand(const std::string& master_path, std::vector<std::string> command) {
  {
    const Result<Key> master = master_path.empty() ? random_key() : read_master_key(master_path);
    if (!master) return complain(master.error().message);
    std::string fds;
    for (const Part& part : parts()) {
      const int fd = hold_in_memory(KeyRing::derive(*master, part.process).spell());
      if (fd < 0) return complain("a file in memory: " + reason());
      fds += fmt::format("{}{}={}", fds.empty() ? "" : " ", part.process, fd);
    }
    setenv(kFdsVariable, fds.c_str(), 1);
  }
  std::vector<char*> arguments;
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  fmt::print(stderr, "tern-key: {}: {}\n", command[0], reason());
  return kExitNotRun;
}

int run(int argc, char** argv) {
  CLI::App app("Makes the keys by which Tern's processes sign their messages", "tern-key");
  app.require_subcommand(1);
  std::string master, process, out;
  std::vector<std::string> command;
  auto* const make_command = app.add_subcommand("new", "Write a new random master key, mode 600");
  make_command->add_option("FILE", out)->required();
  auto* const derive_command = app.add_subcommand("derive", "Write what one process needs of a master key, mode 600");
  derive_command->add_option("MASTER", master)->required();
  derive_command->add_option("PROCESS", process, "As tern-planner")->required();
  derive_command->add_option("FILE", out)->required();
  auto* const hand_command = app.add_subcommand(
      "hand",
      fmt::format("Become COMMAND, which inherits each process's keys as an open file; {} says which", kFdsVariable));
  hand_command->add_option("--key", master, "The master key's file (default: a new key that is never written)");
  hand_command->add_option("COMMAND", command)->required();
  hand_command->prefix_command();
  CLI11_PARSE(app, argc, argv);
  if (*make_command) return make(out);
  if (*derive_command) return derive(master, process, out);
  return hand(master, std::move(command));
}

}  // namespace
}  // namespace tern

int main(int argc, char** argv) { return tern::run(argc, argv); }
