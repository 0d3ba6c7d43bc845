#include "viewer/bridge/app/export_node.h"

#include <fmt/format.h>

#include <cstdlib>

#include "core/base/files.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/log.h"
#include "viewer/bridge/app/export_page.h"
#include "viewer/bridge/app/film.h"

namespace tern {
namespace {

class DoneNode final : public Node {
 public:
  [[nodiscard]] UTime next_wakeup() const override { return kNever; }
  void step(UTime) override {}
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Finished, ""}; }
  [[nodiscard]] std::optional<int> finished() const override { return 0; }
};

void write(const std::string& html, const std::string& file) {
  if (!write_text(file, html)) throw ConfigError(file + " cannot be written");
  log::info("{}: {:.1f} MB", file, static_cast<double>(html.size()) * 1e-6);
}

}  // namespace

void add_export_options(CommandLine& app, ViewerOptions& options) {
  app.add_option("--export", options.export_to, "Write the log as one page that plays the flight")
      ->type_name("FILE.html");
  const CommandOption video =
      app.add_option("--video", options.video_to, "Write the log as a film (needs Chromium and ffmpeg)")
          ->type_name("FILE.mp4|FILE.webp");
  app.add_option("--video-size", options.film.size, "Size in pixels, even numbers (default 1280 720)")
      ->type_name("WIDTH HEIGHT")
      ->expected(2)
      ->allow_extra_args(false)
      ->range(64, 4096)
      ->needs(video);
  app.add_option("--video-rate", options.film.rate, "Frames per second (default 25)")->range(1, 60)->needs(video);
  app.add_option("--video-part", options.film.part,
                 "Seconds since the vehicle's departure (default: from -0.5 to the end)")
      ->type_name("FROM TO")
      ->expected(2)
      ->allow_extra_args(false)
      ->needs(video);
}

void keep_logs_apart(CommandLine& app, const ViewerOptions& options) {
  app.final_callback([&app, &options] {
    if (options.log.empty()) return;
    const auto refuse = [&app](const char* name, const char* where) {
      if (app.has(name)) CommandLine::refuse(name, fmt::format("has no effect when {}", where));
    };
    for (const char* name : {"--config", "--set", "--lcm-url", "--clock-offset-us", "--allow-goals"}) {
      refuse(name, "a log is played");
    }
    for (const char* name : {"--key-file", "--key-fd"}) refuse(name, "a log is played (tern-key sift verifies one)");
    app.option("--lcm-url").set("memq://");
    if (options.export_to.empty() && options.video_to.empty()) return;
    for (const char* name : {"--listen", "--allow-host", "--url-file", "--looked-fd", "--foxglove"})
      refuse(name, "a file is written");
    if (std::getenv("TERN_PACE") == nullptr) refuse("--pace", "a file is written");
  });
}

std::unique_ptr<Node> make_viewer(Bus& bus, const Scenario& scenario, const ViewerOptions& options) {
  if (options.export_to.empty() && options.video_to.empty()) {
    return std::make_unique<ViewerNode>(bus, scenario, options);
  }
  if (options.log.empty()) throw ConfigError("--export and --video need a log: tern-viewer --export FILE.html LOG");
  const ExportedPage page = value_or_throw(export_page({options.log, options.ghost, bus.suffix(), options.page}));
  if (!options.export_to.empty()) {
    write(page.html, options.export_to);
    if (!page.left_out.empty()) log::warn("{} are left out: too large", page.left_out);
  }
  if (!options.video_to.empty()) {
    value_or_throw(make_film({page, options.video_to, options.film}));
    log::info("{} is written", options.video_to);
  }
  return std::make_unique<DoneNode>();
}

}  // namespace tern
