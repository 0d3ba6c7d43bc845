// Passes the messages that the viewer receives to Foxglove's clients.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "messages/codec.h"
#include "ros_messages/feed.h"
#include "ros_messages/own_messages.h"
#include "viewer/bridge/app/foxglove_server.h"

namespace tern {

/// Offers the feed's topics (docs/reference/ros_messages.md) and Tern's own messages. A topic without subscribers costs
/// nothing, except maps and goals: their newest one is kept for clients to come.
class FoxgloveLink {
 public:
  /// The options of the server; see FoxgloveServer.
  struct Options {
    std::string listen;                ///< "ADDRESS:PORT"
    std::vector<std::string> names;    ///< further hosts by which clients may address the server
    std::vector<std::string> origins;  ///< pages that may connect
  };

  /// @param session  names this run of the viewer
  /// @throws ConfigError if listening fails
  FoxgloveLink(const Options& options, const std::string& session);
  /// Logs the server's counters.
  ~FoxgloveLink();
  FoxgloveLink(const FoxgloveLink&) = delete;
  FoxgloveLink& operator=(const FoxgloveLink&) = delete;

  /// The feed takes complete messages. Call set_time() first.
  ros::Feed& feed() { return feed_; }
  /// Sets the time of the messages that follow: that of their receipt.
  void set_time(UTime at) { at_ = at; }
  /// Takes a message as it is, batches and chunks included.
  template <class T>
  void take(const tern::Channel<T>& channel, const T& message) {
    const std::size_t k = index_.find("/" + std::string(channel.name))->second;
    if (server_->is_wanted(k)) server_->publish(k, at_, ros::own_cdr(kLcmType<T>, encode(message)));
  }

  /// Returns "ws://127.0.0.1:8766/".
  [[nodiscard]] const std::string& url() const { return url_; }
  FoxgloveServer& server() { return *server_; }

 private:
  std::map<std::string, std::size_t, std::less<>> index_;  ///< of channels, by topic
  std::string url_;
  std::unique_ptr<FoxgloveServer> server_;
  ros::Feed feed_;
  UTime at_;
};

}  // namespace tern
