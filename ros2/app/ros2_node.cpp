#include "ros2/app/ros2_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>

#include "ros2/topics.h"
#include "runtime/config.h"
#include "runtime/log.h"

namespace tern::ros2 {
namespace {

constexpr Duration kPollPeriod{2'000}, kClockPeriod{10'000};
constexpr Duration kReportPeriod{5'000'000};
constexpr Duration kAlone{10'000'000};
constexpr std::size_t kMostTrouble = 900;  // bytes; HEARTBEAT takes kMaxWaitingText

std::vector<std::string> names_of(const std::vector<ros::FeedTopic>& topics) {
  std::vector<std::string> names;
  names.reserve(topics.size());
  for (const ros::FeedTopic& topic : topics) names.push_back(topic.name);
  return names;
}

/// Returns the topics that an option chooses.
std::set<std::string> chosen(const std::string& option, const std::string& text,
                             const std::vector<ros::FeedTopic>& topics) {
  const std::vector<std::string> known = names_of(topics);
  if (text == "all") return {known.begin(), known.end()};
  if (text == "none") return {};
  std::set<std::string> names;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::string name = word.starts_with('/') ? word : "/" + word;
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw ConfigError(
          fmt::format("{} {}: there is no such topic; there are {}", option, word, fmt::join(known, ", ")));
    }
    names.insert(name);
  }
  return names;
}

TopicNames names_from(const Ros2Options& options) {
  std::vector<std::string> known = names_of(sent_topics());
  for (const auto* more : {&received_topics(), &transform_topics()}) {
    for (const std::string& name : names_of(*more)) {
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
    }
  }
  return value_or_throw(TopicNames::parse(options.name_space, options.remaps, known));
}

std::set<std::string> received_by(const Ros2Options& options) {
  if (options.receive == "all") {
    throw ConfigError("--receive all: name the topics that may act on the flight, as goal_pose,detections");
  }
  std::set<std::string> received = chosen("--receive", options.receive, received_topics());
  if (received.contains(topics::kFollowing) && !received.contains(topics::kOdom)) {
    throw ConfigError("--receive following: it is a part of the vehicle, which odom reports; add odom");
  }
  return received;
}

/// Clocks of ROS are the system's, unless somebody publishes /clock. Only a slowed flight needs that.
std::set<std::string> sent_by(const Ros2Options& options, const Clock& clock) {
  std::set<std::string> sent = chosen("--send", options.send, sent_topics());
  constexpr Duration kSecond{1'000'000};
  if (clock.in_system_time(kSecond) == kSecond) sent.erase(topics::kClock);
  const std::set<std::string> received = received_by(options);
  for (const std::string& topic : received) sent.erase(topic);
  if (received.contains(topics::kOdom)) sent.erase(topics::kTf);
  return sent;
}

}  // namespace

int domain_of(const std::string& text) {
  constexpr int kLast = 232;
  int domain = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error != std::errc{} || end != text.data() + text.size() || domain < 0 || domain > kLast) {
    throw ConfigError(
        fmt::format("--domain or ROS_DOMAIN_ID is \"{}\": must be a whole number of 0 to {}", text, kLast));
  }
  return domain;
}

Ros2Node::Ros2Node(Bus& bus, const UavSpec& uav, const Ros2Options& options) try
    : bus_(bus),
      names_(names_from(options)),
      participant_(options.domain, options.network),
      outlet_(bus, participant_, names_, sent_by(options, bus.clock())),
      inlet_(bus, participant_, names_, received_by(options), options.in, uav),
      next_(bus.clock().now()),
      next_report_(next_ + kReportPeriod),
      alone_until_(next_ + kAlone) {
  log::info("ROS 2: domain {} on {}", options.domain, options.network.empty() ? "this host" : options.network);
} catch (const std::runtime_error& error) {
  throw ConfigError(error.what());
}

void Ros2Node::step(UTime now) {
  if (now < next_) return;
  next_ = now + (inlet_.is_empty() ? kClockPeriod : kPollPeriod);
  inlet_.step(now);
  if (now >= next_clock_) {
    next_clock_ = now + kClockPeriod;
    outlet_.write_clock(now);
  }
  if (now >= alone_until_) {
    alone_until_ = kNever;
    if (!participant_.has_met_others()) {
      log::info(
          "has met no ROS node that reads or writes its topics for {:.0f} s: do all shells have the same domain, "
          "and ROS_LOCALHOST_ONLY=1 or ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST (or --interface here)?",
          kAlone.seconds());
    }
  }
  if (now < next_report_) return;
  next_report_ = now + kReportPeriod;
  trouble_ = outlet_.take_trouble();
  for (const std::string& more : {inlet_.take_trouble(), Participant::take_log()}) {
    if (!trouble_.empty() && !more.empty()) trouble_ += "; ";
    trouble_ += more;
  }
  if (trouble_.size() > kMostTrouble) trouble_ = trouble_.substr(0, kMostTrouble) + " …";
  if (!trouble_.empty()) log::warn("{}", trouble_);
}

NodeHealth Ros2Node::health() const {
  const std::string lacks = inlet_.waiting_for(bus_.clock().now());
  if (!lacks.empty()) return {ProcessState::Waiting, lacks};
  return {ProcessState::Ready, trouble_};
}

}  // namespace tern::ros2
