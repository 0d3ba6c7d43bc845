// tern-viewer's node: shows the bus, or a log, on a page in the browser.
#pragma once

#include <bitset>
#include <optional>
#include <string>

#include "core/scenario/scenario.h"
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

class FoxgloveLink;

/// The options of tern-viewer.
struct ViewerOptions {
  std::string listen = "127.0.0.1";  ///< address, optionally with :PORT; ignored if TERN_LISTEN_FD passes a socket
  std::string page;                  ///< folder of the built page; empty: default_page_folder()
  std::vector<std::string>
      allow_hosts;               ///< host names, in addition to loopback, by which browsers may address the bridge
  bool allow_goals = false;      ///< pages and Foxglove's clients may send goals
  bool keep_height = false;      ///< a goal of Foxglove gets the vehicle's height
  std::string log;               ///< log to play; empty: live
  std::string export_to;         ///< file for --export; empty: none
  std::string video_to;          ///< file for --video; empty: none
  FilmForm film;                 ///< of video_to
  std::string ghost;             ///< another log to draw over it; empty: none
  std::optional<int> looked_fd;  ///< the bridge writes a byte there when the first page connects
  std::string url_file;          ///< the bridge writes the page's URL there; empty: nowhere
  std::string foxglove;          ///< "PORT" or "ADDRESS:PORT" of the server for Foxglove; empty: none
  std::vector<std::string> allow_origins;  ///< pages that may connect to it
};

/// Posts topics to the board while a page is connected, each at most at its own rate. It never waits for a browser.
class ViewerNode final : public Node {
 public:
  /// @throws ConfigError if listening fails, or reading the log or the page
  ViewerNode(Bus& bus, const Scenario& scenario, ViewerOptions options);
  ~ViewerNode() override;

  [[nodiscard]] UTime next_wakeup() const override { return next_step_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }
  [[nodiscard]] const std::string& url() const { return url_; }

 private:
  void listen();
  void listen_for_foxglove();
  /// Returns the seconds of flight per second of the system's clock, of this process.
  [[nodiscard]] double pace() const;
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
  [[nodiscard]] bool has_room_at(const Vec3& p) const;
  /// Sends a goal, or returns why not.
  std::optional<std::string> send_goal(const GoalCommand& command, UTime now);
  void take_foxglove_goals(UTime now);
  void repeat_goal(UTime now);
  void post(UTime now);
  void post_if_changed(Topic topic, UTime now);
  [[nodiscard]] bool is_wanted(Topic topic) const;
  [[nodiscard]] std::string json_of(Topic topic, UTime now) const;

  Bus& bus_;
  Scenario scenario_;
  ViewerOptions options_;
  Scene::Memory memory_;  ///< of a live flight
  Scene scene_;
  std::unique_ptr<FoxgloveLink> foxglove_;  ///< null: not asked for. It outlives intake_, which passes it messages
  SceneIntake intake_;
  std::optional<LogPlayer> player_, ghost_;
  std::optional<UTime> jump_to_;
  Board board_;
  std::string url_;
  std::unique_ptr<WebServer> server_;  ///< declared after board_, which it reads
  Subscriptions subscriptions_;
  std::bitset<kTopics> posted_once_;
  PageGoal page_goal_;
  UTime next_step_;
  std::array<UTime, kTopics> next_post_{};
};

}  // namespace tern
