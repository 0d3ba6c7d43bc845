#include "viewer/bridge/app/viewer_node.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <utility>

#include "core/world/flyable.h"
#include "messages/codec.h"
#include "runtime/config.h"
#include "runtime/log.h"
#include "runtime/version.h"
#include "viewer/bridge/app/foxglove_link.h"
#include "viewer/bridge/app/listening_socket.h"
#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/scene_json.h"
#include "viewer/bridge/topics.h"

namespace tern {
namespace {

constexpr Duration kStepPeriod{33'000};
/// Shortest interval between two texts of a topic.
Duration period(Topic topic) {
  switch (topic) {
    case Topic::Tracks:
    case Topic::Tracked:
    case Topic::Hulls: return Duration{200'000};
    case Topic::Sight: return Duration{100'000};
    case Topic::Chart:
    case Topic::Path:
    case Topic::Fields:
    case Topic::Events:
    case Topic::Ghost:
    case Topic::Health: return Duration{500'000};
    default: return kStepPeriod;
  }
}

}  // namespace

ViewerNode::ViewerNode(Bus& bus, const Scenario& scenario, ViewerOptions options)
    : bus_(bus),
      scenario_(scenario),
      options_(std::move(options)),
      scene_(options_.log.empty() ? &memory_ : nullptr, pace()),
      intake_(scene_),
      next_step_(bus.clock().now()) {
  if (!options_.foxglove.empty()) listen_for_foxglove();
  if (options_.log.empty()) {
    intake_.subscribe(bus);
  } else {
    player_ = value_or_throw(LogPlayer::open(options_.log, bus.suffix()));
    scene_ = Scene(nullptr, player_->note().pace);
    player_->seek(player_->begin(), scene_, intake_);
    player_->play(true, bus.clock().now());
  }
  if (!options_.ghost.empty()) ghost_ = value_or_throw(LogPlayer::open(options_.ghost, bus.suffix()));
  listen();
  post_session();
}

ViewerNode::~ViewerNode() {
  const WebCounters counters = server_->counters();
  log::info("{} frames sent, {} texts dropped for slow pages, {} requests refused, {} commands dropped",
            counters.frames, counters.dropped, counters.refused, counters.commands_dropped);
}

void ViewerNode::listen() {
  const char* inherited = std::getenv(kListenFdVariable);
  const int fd =
      inherited != nullptr ? std::atoi(inherited) : value_or_throw(open_listening_socket(options_.listen, false));
  url_ = value_or_throw(listening_url(fd));
  std::vector<std::string> names = options_.allow_hosts;
  names.push_back(host_of_url(url_));
  PageFiles files = value_or_throw(load_page(options_.page.empty() ? default_page_folder() : options_.page));
  server_ = std::make_unique<WebServer>(fd, std::move(files), Access(std::move(names)), board_);
  log::info("the page is at {}", url_);
  if (!options_.url_file.empty()) std::ofstream(options_.url_file) << url_ << '\n';
}

void ViewerNode::listen_for_foxglove() {
  const bool is_port = options_.foxglove.find(':') == std::string::npos;
  foxglove_ = std::make_unique<FoxgloveLink>(FoxgloveLink::Options{(is_port ? "127.0.0.1:" : "") + options_.foxglove,
                                                                   options_.allow_hosts, options_.allow_origins},
                                             std::to_string(bus_.epoch_us()));
  intake_.pass_to(foxglove_.get());
  log::info("Foxglove connects to {}", foxglove_->url());
}

double ViewerNode::pace() const {
  constexpr Duration kSecond{1'000'000};
  return 1.0 / bus_.clock().in_system_time(kSecond).seconds();
}

void ViewerNode::post_session() {
  JsonWriter json;
  json.begin_object().key("mode").text(player_ ? "log" : "live").key("goals").flag(options_.allow_goals && !player_);
  json.key("name").text(player_ ? options_.log : scenario_.name).key("build").text(build_id());
  json.key("pace").number(pace()).key("why").text(player_ ? player_->note().why : "");
  json.key("epoch").integer(bus_.epoch_us()).end_object();
  board_.post(Topic::Session, json.take());
}

void ViewerNode::step(UTime now) {
  if (now < next_step_) return;
  next_step_ = now + kStepPeriod;
  for (const ClientCommand& command : server_->take_commands()) execute(command, now);
  if (foxglove_) take_foxglove_goals(now);
  jump();
  subscriptions_.keep_only(server_->clients());
  if (player_) player_->advance(now, intake_);
  repeat_goal(now);
  if (server_->clients().empty()) return;
  if (const auto fd = std::exchange(options_.looked_fd, std::nullopt)) (void)!write(*fd, "!", 1);
  post(now);
  server_->wake();
}

void ViewerNode::execute(const ClientCommand& received, UTime now) {
  const auto command = parse_command(received.text);
  if (command) return std::visit([&](const auto& c) { execute(received.client, c, now); }, *command);
  JsonWriter json;
  server_->reply(received.client, json.begin_object().key("refused").text(command.error().message).end_object().take());
}

void ViewerNode::execute(std::int64_t client, const LayersCommand& layers, UTime) {
  subscriptions_.take(client, layers);
  for (const Topic topic : {Topic::Plan, Topic::Hulls, Topic::Tracked, Topic::Search}) scene_.mark(topic);
  if (player_ && layers.tracks) player_->remember_tracks();
}

void ViewerNode::execute(std::int64_t client, const SeriesCommand& series, UTime) {
  subscriptions_.take(client, series);
  posted_once_.reset(idx(Topic::Chart));
  scene_.mark(Topic::Chart);
}

void ViewerNode::execute(std::int64_t client, const PickCommand& pick, UTime) {
  JsonWriter json;
  server_->reply(client, json.begin_object().key("detail").raw(detail_json(scene_, pick)).end_object().take());
}

void ViewerNode::execute(std::int64_t, const PlayCommand& play, UTime now) {
  if (!player_) return;
  jump();
  const bool again = play.play && player_->position() == player_->end();
  if (again) player_->seek(player_->begin(), scene_, intake_);
  player_->play(play.play, now);
}

void ViewerNode::execute(std::int64_t, const SeekCommand& seek, UTime) {
  if (player_) jump_to_ = UTime{seek.at_us};
}

/// Stores the place to jump to. While the user scrubs, more places are asked for than shown; the last one is used.
void ViewerNode::jump() {
  if (jump_to_) player_->seek(*jump_to_, scene_, intake_);
  jump_to_.reset();
}

void ViewerNode::execute(std::int64_t, const StepCommand& step, UTime) {
  if (!player_) return;
  jump();
  player_->step(step.plans, scene_, intake_);
}

void ViewerNode::execute(std::int64_t, const SpeedCommand& speed, UTime) {
  if (player_) player_->set_speed(speed.factor);
}

void ViewerNode::execute(std::int64_t client, const GoalCommand& command, UTime now) {
  const auto refusal = send_goal(command, now);
  JsonWriter json;
  json.begin_object().key("goal").begin_object();
  refusal ? json.key("refused").text(*refusal) : json.key("sent").integer(page_goal_.newest_id());
  server_->reply(client, json.end_object().end_object().take());
}

/// Before the first request the box is that of the scenario.
bool ViewerNode::has_room_at(const Vec3& p) const {
  if (scene_.has_request()) return scene_.has_room_at(p);
  return centre_box(scenario_.uav.flight_box, scenario_.uav.body).contains(p);
}

std::optional<std::string> ViewerNode::send_goal(const GoalCommand& command, UTime now) {
  if (player_) return "a log is played";
  if (!options_.allow_goals) return "tern-viewer was started without --allow-goals";
  if (command.mode == GoalMode::Go && !has_room_at(command.position)) return "the body would leave the flight box";
  Goal goal;
  goal.id = page_goal_.next_id(scene_);
  goal.mode = command.mode;
  goal.position = command.position;
  page_goal_.set(goal, scene_, now);
  repeat_goal(now);
  log::info("goal {} is sent: {:.2f}, {:.2f}, {:.2f}", goal.id, goal.position.x(), goal.position.y(),
            goal.position.z());
  return std::nullopt;
}

void ViewerNode::take_foxglove_goals(UTime now) {
  for (const FoxglovePublished& published : foxglove_->server().take_published()) {
    auto position = foxglove::goal_position(published.channel, published.payload, ros::Frames().world);
    if (position && options_.keep_height && scene_.state()) position->z() = scene_.state()->motion.p.z();
    const auto refusal = position ? send_goal({GoalMode::Go, *position}, now) : std::optional(position.error().message);
    const auto level = refusal ? foxglove::Level::Error : foxglove::Level::Info;
    foxglove_->server().tell(published.client, level, refusal ? "goal refused: " + *refusal : "goal sent");
  }
}

void ViewerNode::repeat_goal(UTime now) {
  if (const auto goal = page_goal_.due(scene_, now)) bus_.publish(channels::kGoal, *goal);
}

void ViewerNode::post(UTime now) {
  for (int k = 0; k < kTopics; ++k) post_if_changed(static_cast<Topic>(k), now);
}

bool ViewerNode::is_wanted(Topic topic) const {
  switch (topic) {
    case Topic::Session: return false;
    case Topic::Hulls: return subscriptions_.layers().hulls;
    case Topic::Tracked: return subscriptions_.layers().tracks;
    case Topic::Search: return subscriptions_.layers().search;
    case Topic::Ghost: return ghost_.has_value();
    default: return true;
  }
}

void ViewerNode::post_if_changed(Topic topic, UTime now) {
  const auto k = idx(topic);
  if (!is_wanted(topic) || now < next_post_[k]) return;
  const bool is_told_once = topic == Topic::Ghost || (player_ && is_of_the_past(topic));
  if (is_told_once) {
    if (posted_once_[k]) return;
  } else if (topic != Topic::Player && !scene_.take_change(topic)) {
    return;
  }
  const std::string json = json_of(topic, player_ ? player_->position() : now);
  posted_once_[k] = json != "null";
  if (topic != Topic::Player || player_) board_.post(topic, json);
  next_post_[k] = now + period(topic);
}

std::string ViewerNode::json_of(Topic topic, UTime now) const {
  const Scene::Memory& memory = player_ ? player_->memory() : memory_;
  const UTime zero = player_ ? player_->zero() : memory_.zero();
  if (topic == Topic::Player) return player_ ? player_->json() : "null";
  if (topic == Topic::Ghost) {
    return ghost_json(options_.ghost, ghost_->body_radius(), ghost_->memory().history, memory.history, zero);
  }
  const UTime until = player_ ? player_->end() : scene_.state() ? scene_.state()->at : zero;
  return topic_json(topic, {scene_, memory, zero, until, now, subscriptions_.layers(), subscriptions_.series()});
}

}  // namespace tern
