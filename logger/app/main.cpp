#include <unistd.h>

#include <csignal>
#include <memory>
#include <optional>
#include <string>

#include "logger/app/logger_node.h"
#include "runtime/command_line.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  std::signal(SIGXFSZ,
              SIG_IGN);  // a log that reaches the limit of a file's size is a full disk, which the node reports
  std::string path = "flight.lcm";
  std::optional<int> listens_fd;
  const tern::ProcessDescription description{
      .name = "tern-logger",
      .section = "logger",
      .summary = "Records every message of every channel in a log, which LCM's tools can open",
      .add_options =
          [&](tern::CommandLine& app) {
            app.add_option("--record", path, "Log to write, or folder for flight.lcm. An existing log gets a new part")
                ->type_name("PATH")
                ->capture_default_str();
            app.add_option("--listens-fd", listens_fd, "Write a byte to this descriptor when recording has begun");
          },
      .read_section = tern::read_logger_config};
  bool is_whole = true;
  const auto make_node = [&](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    const tern::LoggerConfig config = tern::read_logger_config(context.section);
    auto node = std::make_unique<tern::LoggerNode>(context.bus, config, path, &is_whole);
    if (listens_fd) (void)!write(*listens_fd, "!", 1);
    return node;
  };
  const int code = tern::run_process(argc, argv, description, make_node);
  return code == 0 && !is_whole ? tern::kExitMessagesMissing : code;
}
