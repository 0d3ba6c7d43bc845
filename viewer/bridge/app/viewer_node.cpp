#include "viewer/bridge/app/viewer_node.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "messages/codec.h"
#include "runtime/config.h"
#include "runtime/version.h"
#include "viewer/bridge/app/listening_socket.h"
#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

constexpr Duration kStepPeriod{33'000};
/// Hulls are of what may come as near as this to the plan, m; at most so many at a time (about 10 ms of work).
constexpr double kHullReach = 2.0;
constexpr int kMostHulls = 240;

/// How often a topic is told at most.
Duration period(Topic topic) {
  switch (topic) {
    case Topic::Tracks:
    case Topic::Hulls: return Duration{200'000};
    case Topic::Chart: return Duration{250'000};
    case Topic::Path:
    case Topic::Health: return Duration{500'000};
    default: return kStepPeriod;
  }
}

template <class T>
T or_refuse(Result<T> result) {
  if (!result) throw ConfigError(result.error().message);
  return std::move(*result);
}

}  // namespace

ViewerNode::ViewerNode(Bus& bus, const Scenario& scenario, ViewerOptions options)
    : bus_(bus),
      scenario_(scenario),
      options_(std::move(options)),
      scene_(options_.log.empty() ? &history_ : nullptr),
      intake_(scene_),
      next_step_(bus.clock().now()) {
  if (options_.log.empty()) {
    intake_.subscribe(bus);
  } else {
    player_ = or_refuse(LogPlayer::open(options_.log, bus.suffix()));
    player_->seek(player_->begin(), scene_, intake_);
    player_->play(true, bus.clock().now());
  }
  listen();
  post_session();
}

ViewerNode::~ViewerNode() {
  const WebCounters counters = server_->counters();
  spdlog::info("{} frames sent, {} texts dropped for slow pages, {} requests refused, {} commands dropped",
               counters.frames, counters.dropped, counters.refused, counters.commands_dropped);
}

void ViewerNode::listen() {
  const char* inherited = std::getenv(kListenFdVariable);
  const int fd = inherited != nullptr ? std::atoi(inherited) : or_refuse(open_listening_socket(options_.listen, false));
  url_ = or_refuse(listening_url(fd));
  std::vector<std::string> names = options_.allow_hosts;
  names.push_back(host_of_url(url_));
  PageFiles files = or_refuse(load_page(options_.page.empty() ? default_page_folder() : options_.page));
  server_ = std::make_unique<WebServer>(fd, std::move(files), Access(std::move(names)), board_);
  spdlog::info("the page is at {}", url_);
  if (!options_.url_file.empty()) std::ofstream(options_.url_file) << url_ << '\n';
}

void ViewerNode::post_session() {
  JsonWriter json;
  json.begin_object().key("mode").text(player_ ? "log" : "live").key("goals").flag(options_.allow_goals && !player_);
  json.key("name").text(player_ ? options_.log : scenario_.name).key("build").text(build_id());
  json.key("epoch").integer(bus_.epoch_us()).end_object();
  board_.post(Topic::Session, json.take());
}

void ViewerNode::step(UTime now) {
  if (now < next_step_) return;
  next_step_ = now + kStepPeriod;
  for (const ClientCommand& command : server_->take_commands()) obey(command, now);
  jump();
  forget_gone_pages();
  if (player_) player_->advance(now, intake_);
  repeat_goal(now);
  if (server_->clients().empty()) return;
  post(now);
  server_->wake();
}

void ViewerNode::obey(const ClientCommand& said, UTime now) {
  const auto command = parse_command(said.text);
  if (command) return std::visit([&](const auto& c) { obey(said.client, c, now); }, *command);
  JsonWriter json;
  server_->reply(said.client, json.begin_object().key("refused").text(command.error().message).end_object().take());
}

void ViewerNode::obey(std::int64_t client, const LayersCommand& layers, UTime) {
  layers_[client] = layers;
  wanted_ = {};
  for (const auto& [id, l] : layers_) {
    wanted_.hulls = wanted_.hulls || l.hulls;
    wanted_.planes = wanted_.planes || l.planes;
    wanted_.search = wanted_.search || l.search;
  }
  scene_.mark(Topic::Plan);
  scene_.mark(Topic::Hulls);
  scene_.mark(Topic::Search);
}

void ViewerNode::obey(std::int64_t client, const PickCommand& pick, UTime) {
  JsonWriter json;
  server_->reply(client, json.begin_object().key("detail").raw(detail_json(scene_, pick)).end_object().take());
}

void ViewerNode::obey(std::int64_t, const PlayCommand& play, UTime now) {
  if (!player_) return;
  jump();
  const bool again = play.play && player_->position() == player_->end();
  if (again) player_->seek(player_->begin(), scene_, intake_);
  player_->play(play.play, now);
}

void ViewerNode::obey(std::int64_t, const SeekCommand& seek, UTime) {
  if (player_) jump_to_ = UTime{seek.at_us};
}

/// Who scrubs asks for more places than are shown: the last one counts.
void ViewerNode::jump() {
  if (jump_to_) player_->seek(*jump_to_, scene_, intake_);
  jump_to_.reset();
}

void ViewerNode::obey(std::int64_t, const StepCommand& step, UTime) {
  if (!player_) return;
  jump();
  player_->step(step.plans, scene_, intake_);
}

void ViewerNode::obey(std::int64_t, const SpeedCommand& speed, UTime) {
  if (player_) player_->set_speed(speed.factor);
}

void ViewerNode::obey(std::int64_t client, const GoalCommand& command, UTime now) {
  JsonWriter json;
  json.begin_object().key("goal").begin_object();
  const char* refusal =
      player_                 ? "a log is played"
      : !options_.allow_goals ? "tern-viewer was started without --allow-goals"
      : command.mode == GoalMode::Go && scene_.request() && !scene_.request()->flight_box.contains(command.position)
          ? "outside the flight box"
          : nullptr;
  if (refusal != nullptr) {
    json.key("refused").text(refusal);
  } else {
    Goal goal;
    goal.id = (scene_.goal() ? scene_.goal()->id : 0) + 1;
    goal.mode = command.mode;
    goal.position = command.position;
    own_goal_.set(goal, scene_, now);
    repeat_goal(now);
    spdlog::info("a page sent goal {}: {:.2f}, {:.2f}, {:.2f}", goal.id, goal.position.x(), goal.position.y(),
                 goal.position.z());
    json.key("sent").integer(goal.id);
  }
  server_->reply(client, json.end_object().end_object().take());
}

void ViewerNode::forget_gone_pages() {
  const auto clients = server_->clients();
  std::erase_if(layers_, [&](const auto& entry) {
    return std::find(clients.begin(), clients.end(), entry.first) == clients.end();
  });
}

void ViewerNode::repeat_goal(UTime now) {
  if (const auto goal = own_goal_.due(scene_, now)) bus_.publish(channels::kGoal, *goal);
}

void ViewerNode::post(UTime now) {
  for (int k = 0; k < kTopics; ++k) post_if_changed(static_cast<Topic>(k), now);
}

void ViewerNode::post_if_changed(Topic topic, UTime now) {
  if (topic == Topic::Session) return;
  if (topic == Topic::Hulls && !wanted_.hulls) return;
  if (topic == Topic::Search && !wanted_.search) return;
  UTime& due = next_post_[static_cast<std::size_t>(topic)];
  if (now < due) return;
  if (topic == Topic::Player) {
    if (player_) board_.post(topic, player_->json());
  } else if (scene_.take_change(topic)) {
    board_.post(topic, json_of(topic, player_ ? player_->position() : now));
  } else {
    return;
  }
  due = now + period(topic);
}

std::string ViewerNode::json_of(Topic topic, UTime now) const {
  const FlightHistory& history = player_ ? player_->history() : history_;
  const UTime until = scene_.state() ? scene_.state()->at : UTime{};
  switch (topic) {
    case Topic::State: return state_json(scene_);
    case Topic::Truth: return truth_json(scene_);
    case Topic::Tracks: return tracks_json(scene_);
    case Topic::Request: return request_json(scene_);
    case Topic::Plan: return plan_json(scene_, wanted_.planes);
    case Topic::Timing: return timing_json(scene_);
    case Topic::Hulls: return hulls_json(scene_, kHullReach, kMostHulls);
    case Topic::Search: return search_json(scene_);
    case Topic::Map: return map_json(scene_);
    case Topic::Health: return health_json(scene_, now);
    case Topic::Goal: return goal_json(scene_);
    case Topic::Result: return result_json(scene_);
    case Topic::Chart: return history.chart_json(until);
    case Topic::Path: return history.path_json(until);
    default: return "null";
  }
}

}  // namespace tern
