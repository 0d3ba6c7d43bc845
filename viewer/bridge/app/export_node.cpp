#include "viewer/bridge/app/export_node.h"

#include <spdlog/spdlog.h>

#include <fstream>

#include "runtime/config.h"
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
  std::ofstream out(file, std::ios::binary);
  out << html;
  out.close();
  if (!out) throw ConfigError(file + " cannot be written");
  spdlog::info("{}: {:.1f} MB", file, static_cast<double>(html.size()) * 1e-6);
}

}  // namespace

std::unique_ptr<Node> make_viewer(Bus& bus, const Scenario& scenario, const ViewerOptions& options) {
  if (options.export_to.empty() && options.video_to.empty()) {
    return std::make_unique<ViewerNode>(bus, scenario, options);
  }
  if (options.log.empty()) throw ConfigError("--export and --video need a log: tern-viewer --export FILE.html LOG");
  const auto page = export_page({options.log, options.ghost, bus.suffix(), options.page});
  if (!page) throw ConfigError(page.error().message);
  if (!options.export_to.empty()) {
    write(page->html, options.export_to);
    if (!page->left_out.empty()) spdlog::warn("{} are left out: too large", page->left_out);
  }
  if (!options.video_to.empty()) {
    const auto made = make_film({page->html, options.video_to, page->seconds});
    if (!made) throw ConfigError(made.error().message);
    spdlog::info("{}: {:.1f} s", options.video_to, page->seconds);
  }
  return std::make_unique<DoneNode>();
}

}  // namespace tern
