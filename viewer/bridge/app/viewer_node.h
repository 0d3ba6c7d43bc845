// tern-viewer's node: the bus, or a log, on a page in the browser.
#pragma once

#include <bitset>
#include <optional>
#include <string>

#include "core/world/scenario.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "viewer/bridge/app/film.h"
#include "viewer/bridge/app/log_player.h"
#include "viewer/bridge/app/scene_intake.h"
#include "viewer/bridge/app/web_server.h"
#include "viewer/bridge/commands.h"
#include "viewer/bridge/page_goal.h"
#include "viewer/bridge/subscriptions.h"

namespace tern {

struct ViewerOptions {
  std::string listen = "127.0.0.1";      ///< address, perhaps with :PORT; not read when TERN_LISTEN_FD names a socket
  std::string page;                      ///< the built page's folder; empty: default_page_folder()
  std::vector<std::string> allow_hosts;  ///< names besides loopback by which browsers may call this host
  bool allow_goals = false;              ///< pages may send goals
  std::string log;                       ///< plays this log; empty: live
  std::string export_to;                 ///< writes the log as one page there; empty: does not
  std::string video_to;                  ///< likewise, as a film
  FilmForm film;                         ///< of video_to
  std::string ghost;                     ///< another log, drawn over it; empty: none
  std::optional<int> looked_fd;          ///< a byte is written there when the first page looks
  std::string url_file;                  ///< the page's URL is written there; empty: nowhere
};

/// Posts each topic to the board no more often than it is looked at, and nothing while nobody looks. Never waits for a
/// browser.
class ViewerNode final : public Node {
 public:
  /// @throws ConfigError when it cannot listen, or the log or page cannot be read.
  ViewerNode(Bus& bus, const Scenario& scenario, ViewerOptions options);
  ~ViewerNode() override;

  [[nodiscard]] UTime next_wakeup() const override { return next_step_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }
  [[nodiscard]] const std::string& url() const { return url_; }

 private:
  void listen();
  void post_session();
  void execute(const ClientCommand& command, UTime now);
  void execute(std::int64_t client, const LayersCommand& layers, UTime now);
  void execute(std::int64_t client, const SeriesCommand& series, UTime now);
  void execute(std::int64_t client, const PickCommand& pick, UTime now);
  void execute(std::int64_t client, const PlayCommand& play, UTime now);
  void execute(std::int64_t client, const SeekCommand& seek, UTime now);
  void execute(std::int64_t client, const StepCommand& step, UTime now);
  void execute(std::int64_t client, const SpeedCommand& speed, UTime now);
  void execute(std::int64_t client, const GoalCommand& goal, UTime now);
  void jump();
  void repeat_goal(UTime now);
  void post(UTime now);
  void post_if_changed(Topic topic, UTime now);
  [[nodiscard]] bool is_wanted(Topic topic) const;
  [[nodiscard]] std::string json_of(Topic topic, UTime now) const;

  Bus& bus_;
  Scenario scenario_;
  ViewerOptions options_;
  Scene::Memory memory_;  ///< live
  Scene scene_;
  SceneIntake intake_;
  std::optional<LogPlayer> player_, ghost_;
  std::optional<UTime> jump_to_;
  Board board_;
  std::string url_;
  std::unique_ptr<WebServer> server_;  ///< after the board that it reads
  Subscriptions subscriptions_;
  std::bitset<kTopics> posted_once_;
  PageGoal page_goal_;
  UTime next_step_;
  std::array<UTime, kTopics> next_post_{};
};

}  // namespace tern
