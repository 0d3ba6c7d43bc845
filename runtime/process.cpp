#include "runtime/process.h"

#include <fmt/format.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <optional>
#include <system_error>

#include "runtime/command_line.h"
#include "runtime/lcm_network.h"
#include "runtime/log.h"
#include "runtime/multicast_sockets.h"
#include "runtime/scenario_file.h"
#include "runtime/version.h"
#include "runtime/wall_runner.h"

namespace tern {
namespace {

/// SIGINT and SIGTERM as a readable descriptor. Made before LCM starts its thread, so that every thread inherits the
/// mask and no signal can arrive between a check and a wait.
class StopSignals {
 public:
  StopSignals() {
    // A shell starts background jobs of a script with SIGINT ignored.
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    fd_ = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
    if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
  }
  ~StopSignals() { close(fd_); }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  [[nodiscard]] int fd() const { return fd_; }

 private:
  int fd_ = -1;
};

struct Options {
  std::string config;
  std::vector<std::string> overrides;
  std::string lcm_url;
  std::int64_t clock_offset_us = 0;
  double pace = 1.0;
  std::string channel_suffix;
  std::string log_level = "info";
  std::optional<std::string> key_file;
  std::optional<int> key_fd;
  bool help_config = false, check_config = false;
};

void declare(CommandLine& app, Options& options, const ProcessDescription& description) {
  app.set_version_flag("--version", fmt::format("{} {}", description.name, build_id()));
  if (description.read_section) {
    app.add_flag("--help-config", options.help_config,
                 "Print every key of this process's section of the scenario file, and exit");
    app.add_flag("--check-config", options.check_config,
                 "Check the scenario and this process's section of it, and exit");
  }
  app.add_option("--config", options.config, "Scenario file (YAML); without it all keys have their defaults")
      ->type_name("FILE");
  app.add_option("--set", options.overrides,
                 "Override a value of the scenario file, as in uav.limits.v_max=3 (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--lcm-url", options.lcm_url,
                 fmt::format("LCM network (default: LCM_DEFAULT_URL, else {})", kDefaultLcmUrl))
      ->type_name("URL");
  app.add_option("--clock-offset-us", options.clock_offset_us,
                 "Microseconds added to the system clock, to test clock skew")
      ->type_name("N");
  app.add_option("--pace", options.pace,
                 "Seconds of flight per second of the system clock; the same for all processes of a flight")
      ->envname("TERN_PACE")
      ->type_name("P")
      ->range(0.01, 1.0);
  const auto plain = [](const std::string& suffix) {
    return Bus::is_channel_name(suffix) ? std::string() : suffix + ": only letters, digits, '_' and '-'";
  };
  app.add_option("--channel-suffix", options.channel_suffix, "Text appended to every channel name; one per vehicle")
      ->type_name("S")
      ->check(plain);
  app.add_option("--log-level", options.log_level, "Least level of the messages that are logged to stderr")
      ->one_of({"trace", "debug", "info", "warning", "error", "off"})
      ->capture_default_str();
  const CommandOption key_file =
      app.add_option("--key-file", options.key_file,
                     "Sign and verify every message with the keys of FILE (mode 600), made by tern-key")
          ->type_name("FILE")
          ->check([](const std::string& path) { return path.empty() ? "the name of the file is empty" : ""; });
  app.add_option("--key-fd", options.key_fd,
                 "Read the keys from open file descriptor N (no pipe) instead, and close it")
      ->type_name("N")
      ->non_negative()
      ->excludes(key_file);
  if (description.add_options) description.add_options(app);
}

/// Ends without destructors, which would wait for the stuck thread while SIGTERM is blocked.
[[noreturn]] void end_at_once(int code) {
  log::flush();
  std::_Exit(code);
}

/// @throws ConfigError if keys were requested and cannot be read.
std::optional<KeyRing> read_keys(const Options& options, const std::string& process) {
  if (!options.key_file && !options.key_fd) return std::nullopt;
  return value_or_throw(options.key_file ? read_key_file(*options.key_file, process)
                                         : read_key_fd(*options.key_fd, process));
}

/// Prints the tables of docs/reference/keys.md.
void print_knobs(const ProcessDescription& description) {
  ConfigDocument document = ConfigDocument::parse(description.example, "");
  description.read_section(document.root().section(description.section));
  std::string section;
  for (const Knob& knob : document.knobs()) {
    const std::size_t dot = knob.path.find('.');
    if (knob.path.substr(0, dot) != section) {
      section = knob.path.substr(0, dot);
      fmt::print("| key of `{}:` | default | range | meaning |\n|---|---|---|---|\n", section);
    }
    fmt::print("| `{}` | {} | {} | {} |\n", knob.path.substr(dot + 1), knob.fallback, knob.range, knob.meaning);
  }
}

int run(const Options& options, const ProcessDescription& description, const NodeFactory& make_node) {
  const std::int64_t epoch_us = unique_epoch(WallClock({}, options.pace).now().us, ::getpid());
  const WallClock clock(Duration{options.clock_offset_us}, options.pace);
  ConfigDocument document = ConfigDocument::load(options.config, options.overrides);
  const Scenario scenario = read_scenario(document);
  const ConfigSection section = description.section.empty() ? ConfigDocument::parse("", options.config).root()
                                                            : document.root().section(description.section);
  if (options.check_config) {
    description.read_section(section);
    return 0;
  }
  const std::optional<KeyRing> keys = read_keys(options, description.name);

  const StopSignals stop;
  const std::string url = choose_lcm_url(options.lcm_url, std::getenv("LCM_DEFAULT_URL"));
  const auto lcm = open_lcm(url);
  if (!lcm) {
    log::error("{}", lcm.error().message);
    return kExitNoNetwork;
  }
  MulticastSockets sockets(url);
  sockets.follow();
  Bus bus(*lcm, clock, epoch_us, options.channel_suffix, keys);
  ProcessContext context{scenario, section, bus, document};
  const std::unique_ptr<Node> node = make_node(context);
  NodeHost host(bus, *node, description.name, document.effective());
  log::info("{} started{}{}", build_id(), keys ? ", signs and verifies messages" : "",
            options.pace == 1.0 ? "" : fmt::format(", at a pace of {}", options.pace));
  const int code = run_on_wall_clock(**lcm, host, stop.fd(), &sockets);
  log::info("exits with code {}", code);
  if (code == kExitStuck) end_at_once(code);
  return code;
}

}  // namespace

std::int64_t unique_epoch(std::int64_t now_us, std::int64_t process_id) {
  constexpr std::int64_t kProcesses = 1024;
  return (now_us / kProcesses - 1) * kProcesses + process_id % kProcesses;
}

int run_process(int argc, char** argv, const ProcessDescription& description, const NodeFactory& make_node) {
  Options options;
  CommandLine app(description.summary, description.name);
  declare(app, options, description);
  if (const auto code = app.parse(argc, argv, kExitBadConfiguration)) return *code;
  if (options.help_config) {
    print_knobs(description);
    return 0;
  }
  log::start(description.name, options.log_level);
  try {
    return run(options, description, make_node);
  } catch (const ConfigError& e) {
    fmt::print(stderr, "{}: {}\n", description.name, e.what());
    return kExitBadConfiguration;
  } catch (const std::exception& e) {
    log::critical("internal error: {}", e.what());
    return kExitStuck;
  }
}

}  // namespace tern
