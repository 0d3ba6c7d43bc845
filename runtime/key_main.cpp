// tern-key: makes files of keys, and copies the verified messages of a log. Keys are never passed as arguments or
// variables.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "flight_log/flight_log.h"
#include "flight_log/log_reader.h"
#include "flight_log/log_writer.h"
#include "runtime/authentication.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/keys.h"
#include "runtime/tool.h"

namespace tern {
namespace {

std::string reason() { return std::strerror(errno); }

/// @return whether the whole text was written. Its memory is overwritten.
bool write_all(int fd, std::string text) {
  const bool ok = write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  wipe({reinterpret_cast<std::uint8_t*>(text.data()), text.size()});
  return ok;
}

/// Writes a new file that only its owner can read. Existing files are refused.
void write_file(const std::string& path, std::string text) {
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (fd < 0) throw ConfigError(path + ": cannot be made: " + reason());
  if (!write_all(fd, std::move(text)) || fsync(fd) != 0 || close(fd) != 0) throw ConfigError(path + ": " + reason());
}

void derive(const std::string& master_path, const std::string& process, const std::string& path) {
  if (!role_of_process(process)) throw ConfigError(process + ": not one of Tern's processes");
  write_file(path, KeyRing::derive(value_or_throw(read_master_key(master_path)), process).to_text());
}

/// Decides which messages of a log a holder of the flight's keys would have accepted.
class Sieve {
 public:
  Sieve(const Key& master, std::string suffix)
      : keys_(KeyRing::derive(master, "tern-key")), suffix_(std::move(suffix)) {}

  bool takes(const LogEvent& event) {
    if (!event.channel.ends_with(suffix_)) return false;
    const std::string channel = event.channel.substr(0, event.channel.size() - suffix_.size());
    const UTime received{event.received_us};
    return verify(event.data, keys_, guards_[event.channel], channel, event.channel, received).has_value();
  }

 private:
  KeyRing keys_;
  std::string suffix_;
  std::map<std::string, ReplayGuard> guards_;
};

/// Copies the messages that the key verifies into a new log. The others had no effect in flight, but tools that read
/// logs have no keys.
void sift(const std::string& master_path, const std::string& log, const std::string& out, const std::string& suffix) {
  Sieve sieve(value_or_throw(read_master_key(master_path)), suffix);
  const std::vector<std::string> parts = log_parts(log);
  for (const std::string& part : parts) value_or_throw(LogReader::open(part));
  if (std::filesystem::exists(out)) throw ConfigError(out + ": exists already; choose another name");
  LogWriter writer = value_or_throw(LogWriter::open(out, 0));
  std::int64_t taken = 0, all = 0;
  std::map<std::string, std::int64_t> refused;
  for (const std::string& part : parts) {
    LogReader reader = value_or_throw(LogReader::open(part));
    for (auto event = reader.next(); event; event = reader.next(), ++all) {
      if (!sieve.takes(*event)) {
        ++refused[event->channel];
        continue;
      }
      writer.append(event->channel, event->received_us, event->data);
      ++taken;
    }
    if (const LogDamage& damage = reader.damage(); damage.places > 0 || damage.truncated) {
      fmt::print("{}: damaged; {} bytes left out\n", part, damage.bytes);
    }
  }
  value_or_throw(writer.flush());
  fmt::print("{} of {} messages verify\n", taken, all);
  for (const auto& [channel, count] : refused) fmt::print("  {}: {} do not\n", channel, count);
}

}  // namespace
}  // namespace tern

int main(int argc, char** argv) {
  tern::CommandLine app(
      "Makes the keys with which Tern's processes sign their messages. Exit code: 0 written, 2 bad arguments or files.",
      "tern-key");
  app.require_subcommand(1, 1);
  std::string master, process, out;
  tern::CommandLine make_command = app.add_subcommand("new", "Write a new random master key to FILE (mode 600)");
  make_command->add_option("FILE", out, "New file")->required();
  tern::CommandLine derive_command =
      app.add_subcommand("derive", "Write the keys of one process, derived from a master key, to FILE (mode 600)");
  derive_command->add_option("MASTER", master, "File of the master key")->required();
  derive_command->add_option("PROCESS", process, "Name of the process, as in tern-planner")->required();
  derive_command->add_option("FILE", out, "New file")->required();
  std::string log, suffix;
  tern::CommandLine sift_command =
      app.add_subcommand("sift", "Copy the messages of a log whose tags a master key verifies");
  sift_command->add_option("MASTER", master, "File of the master key")->required();
  sift_command->add_option("LOG", log, "Log file (its further parts are found), or a folder with flight.lcm")
      ->required();
  sift_command->add_option("OUT", out, "New log")->required();
  sift_command->add_option("--channel-suffix", suffix, "End of the vehicle's channel names");
  return tern::run_tool(app, "tern-key", argc, argv, [&] {
    if (make_command) tern::write_file(out, tern::to_hex(tern::random_key()) + "\n");
    if (sift_command) tern::sift(master, log, out, suffix);
    if (derive_command) tern::derive(master, process, out);
    return 0;
  });
}
