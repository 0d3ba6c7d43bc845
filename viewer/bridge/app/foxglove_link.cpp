#include "viewer/bridge/app/foxglove_link.h"

#include <utility>

#include "runtime/config.h"
#include "runtime/log.h"
#include "viewer/bridge/app/listening_socket.h"

namespace tern {
namespace {

std::vector<foxglove::Channel> offered_channels() {
  std::vector<foxglove::Channel> offered;
  for (const ros::FeedTopic& topic : ros::feed_topics()) offered.push_back({topic.name, topic.type, topic.latched});
  for_each_channel([&]<class T>(const Channel<T>& channel) {
    offered.push_back({"/" + std::string(channel.name), &ros::own_type(kLcmType<T>), false});
  });
  return offered;
}

}  // namespace

FoxgloveLink::FoxgloveLink(const Options& options, const std::string& session)
    : feed_([this](const ros::FeedTopic& topic,
                   std::string cdr) { server_->publish(index_.find(topic.name)->second, at_, std::move(cdr)); },
            [this](std::string_view topic) { return server_->is_wanted(index_.find(topic)->second); }) {
  std::vector<foxglove::Channel> channels = offered_channels();
  for (std::size_t k = 0; k < channels.size(); ++k) index_[channels[k].topic] = k;
  const int fd = value_or_throw(open_listening_socket(options.listen, false));
  const std::string page_url = value_or_throw(listening_url(fd));
  url_ = "ws" + page_url.substr(page_url.find(':'));
  std::vector<std::string> names = options.names;
  names.push_back(host_of_url(page_url));
  server_ =
      std::make_unique<FoxgloveServer>(fd, Access(std::move(names)), options.origins, std::move(channels), session);
}

FoxgloveLink::~FoxgloveLink() {
  const FoxgloveCounters counters = server_->counters();
  log::info("Foxglove: {} messages sent, {} dropped for slow clients, {} connections and messages refused",
            counters.sent, counters.dropped, counters.refused);
}

}  // namespace tern
