#include "viewer/bridge/app/foxglove_server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "runtime/log.h"
#include "viewer/bridge/app/accept_loop.h"
#include "viewer/foxglove/waiting_messages.h"

namespace tern {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::asio::ip::tcp;
using Request = http::request<http::empty_body>;
using Payload = std::shared_ptr<const std::string>;

constexpr auto kRequestTimeout = std::chrono::seconds(10);
constexpr unsigned kMaxHeaderBytes = 8192;
/// Refused connections are logged until so many refusals are counted: a foreign page cannot fill the log.
constexpr std::int64_t kMaxRefusalsLogged = 20;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Returns the first of our subprotocols that the client offers.
std::optional<std::string> chosen_subprotocol(const Request& request) {
  const beast::string_view offered = request[http::field::sec_websocket_protocol];
  for (const char* ours : foxglove::kSubprotocols) {
    for (const auto& name : http::token_list(offered)) {
      if (view(name) == ours) return ours;
    }
  }
  return std::nullopt;
}

class Client;

/// The state that clients share. It belongs to the server's thread, except the members below the mutex.
struct Clients {
  Access access;
  std::vector<std::string> origins;
  std::vector<foxglove::Channel> channels;
  std::string session;
  std::map<std::int64_t, std::weak_ptr<Client>> connected;
  std::vector<std::pair<UTime, Payload>> newest;  ///< by channel; of latched ones only
  std::int64_t last_client = 0;
  std::vector<std::atomic<int>> subscribers;  ///< by channel

  mutable std::mutex mutex;
  std::vector<FoxglovePublished> inbox;
  FoxgloveCounters counters;

  template <class Change>
  void count(Change&& change) {
    const std::lock_guard lock(mutex);
    change(counters);
  }
  /// Returns the number of refusals so far.
  std::int64_t count_refused() {
    const std::lock_guard lock(mutex);
    return ++counters.refused;
  }
};

/// The connection to one client.
class Client : public std::enable_shared_from_this<Client> {
 public:
  Client(Clients& clients, tcp::socket socket) : clients_(clients), socket_(std::move(socket)) {}
  ~Client() {
    for (const auto& [subscription, channel] : subscriptions_) --clients_.subscribers[channel];
    clients_.connected.erase(id_);
  }

  /// Reads the request that asks for a WebSocket.
  void start() {
    id_ = ++clients_.last_client;
    clients_.connected[id_] = weak_from_this();
    parser_.header_limit(kMaxHeaderBytes);
    beast::get_lowest_layer(socket_).expires_after(kRequestTimeout);
    http::async_read(socket_.next_layer(), input_, parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) self->judge(self->parser_.release());
                     });
  }

  void publish(std::size_t channel, UTime at, const Payload& cdr) {
    for (const auto& [subscription, its_channel] : subscriptions_) {
      if (its_channel == channel) queue(message_of(subscription, channel, at, cdr));
    }
  }

  void tell(std::string text) { queue({{}, std::make_shared<const std::string>(std::move(text)), {}}); }

 private:
  [[nodiscard]] foxglove::WaitingMessage message_of(std::uint32_t subscription, std::size_t channel, UTime at,
                                                    const Payload& cdr) const {
    const bool latched = clients_.channels[channel].latched;
    return {foxglove::message_head(subscription, at), cdr, latched ? std::optional(subscription) : std::nullopt};
  }

  void judge(const Request& request) {
    const std::string_view host = view(request[http::field::host]);
    const std::string origin(view(request[http::field::origin]));
    const auto subprotocol = chosen_subprotocol(request);
    if (!websocket::is_upgrade(request)) return refuse(http::status::upgrade_required, "a WebSocket is served here");
    if (!clients_.access.allows_host(host)) return refuse(http::status::forbidden, "unknown Host");
    if (!origin.empty() && std::ranges::find(clients_.origins, origin) == clients_.origins.end()) {
      return refuse(http::status::forbidden, "foreign Origin: tern-viewer --allow-origin " + origin + " admits it");
    }
    if (!subprotocol) return refuse(http::status::bad_request, "the subprotocol is not foxglove.sdk.v1");
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.set_option(websocket::stream_base::decorator([name = *subprotocol](websocket::response_type& response) {
      response.set(http::field::sec_websocket_protocol, name);
    }));
    socket_.read_message_max(foxglove::kMaxClientMessageBytes);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->open();
    });
  }

  void refuse(http::status status, const std::string& why) {
    if (clients_.count_refused() <= kMaxRefusalsLogged) log::warn("a Foxglove client was refused: {}", why);
    auto response = std::make_shared<http::response<http::string_body>>(status, 11);
    response->set(http::field::content_type, "text/plain; charset=utf-8");
    response->body() = why + "\n";
    response->prepare_payload();
    http::async_write(socket_.next_layer(), *response,
                      [self = shared_from_this(), response](beast::error_code, std::size_t) {
                        beast::error_code ignored;
                        self->socket_.next_layer().socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  void open() {
    is_open_ = true;
    tell(foxglove::server_info(clients_.session));
    tell(foxglove::advertise(clients_.channels));
    input_.consume(input_.size());
    read();
  }

  void read() {
    socket_.async_read(input_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->close();
      const auto* data = static_cast<const std::uint8_t*>(self->input_.data().data());
      const std::span bytes(data, self->input_.size());
      self->socket_.got_text() ? self->receive_text({reinterpret_cast<const char*>(data), bytes.size()})
                               : self->receive_binary(bytes);
      self->input_.consume(self->input_.size());
      self->read();
    });
  }

  /// Ends the connection; the write that is under way ends with an error.
  void close() {
    is_open_ = false;
    socket_.next_layer().close();
  }

  void receive_text(std::string_view text) {
    const auto parsed = foxglove::parse_client_text(text);
    if (!parsed) return refuse_text(parsed.error().message);
    std::visit([this](const auto& operation) { execute(operation); }, *parsed);
  }

  void refuse_text(const std::string& why) {
    clients_.count_refused();
    tell(foxglove::status(foxglove::Level::Error, why));
  }

  void execute(const foxglove::Subscribe& subscribe) {
    for (const auto& [subscription, channel] : subscribe.entries) {
      if (channel >= clients_.channels.size()) return refuse_text("there is no channel " + std::to_string(channel));
      if (subscriptions_.size() >= foxglove::kMaxSubscriptions) return refuse_text("too many subscriptions");
      if (!subscriptions_.emplace(subscription, channel).second) continue;
      ++clients_.subscribers[channel];
      const auto& [at, newest] = clients_.newest[channel];
      if (newest) queue(message_of(subscription, channel, at, newest));
    }
  }

  void execute(const foxglove::Unsubscribe& unsubscribe) {
    for (const std::uint32_t subscription : unsubscribe.subscriptions) {
      const auto found = subscriptions_.find(subscription);
      if (found == subscriptions_.end()) continue;
      --clients_.subscribers[found->second];
      subscriptions_.erase(found);
      waiting_.end(subscription);
    }
  }

  void execute(const foxglove::ClientAdvertise& advertise) {
    for (const auto& entry : advertise.entries) {
      if (advertised_.size() >= foxglove::kMaxAdvertised) return refuse_text("too many channels");
      advertised_.insert_or_assign(entry.channel, entry);
    }
  }

  void execute(const foxglove::ClientUnadvertise& unadvertise) {
    for (const std::uint32_t channel : unadvertise.channels) advertised_.erase(channel);
  }

  void execute(const foxglove::Unsupported& unsupported) {
    refuse_text("tern-viewer does not offer " + unsupported.operation);
  }

  void receive_binary(std::span<const std::uint8_t> bytes) {
    const auto message = foxglove::parse_client_binary(bytes);
    if (!message) return refuse_text(message.error().message);
    const auto channel = advertised_.find(message->channel);
    if (channel == advertised_.end()) return refuse_text("the channel is not advertised");
    if (!take(channel->second, message->payload)) refuse_text("too many messages wait");
  }

  bool take(const foxglove::ClientAdvertise::Entry& channel, std::span<const std::uint8_t> payload) {
    const std::lock_guard lock(clients_.mutex);
    if (clients_.inbox.size() >= kMaxFoxgloveInbox) return false;
    clients_.inbox.push_back({id_, channel, {payload.begin(), payload.end()}});
    return true;
  }

  void queue(foxglove::WaitingMessage message) {
    if (!is_open_) return;
    const std::int64_t dropped = waiting_.add(std::move(message));
    if (dropped > 0) clients_.count([&](FoxgloveCounters& c) { c.dropped += dropped; });
    write();
  }

  void write() {
    if (writing_) return;
    auto next = waiting_.take();
    if (!next) return;
    sent_ = std::move(*next);
    writing_ = true;
    socket_.binary(!sent_.head.empty());
    const std::array<asio::const_buffer, 2> buffers{asio::buffer(sent_.head), asio::buffer(*sent_.body)};
    socket_.async_write(buffers, [self = shared_from_this()](beast::error_code error, std::size_t) {
      self->writing_ = false;
      if (error) return;
      self->clients_.count([](FoxgloveCounters& c) { ++c.sent; });
      self->write();
    });
  }

  Clients& clients_;
  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer input_;
  http::request_parser<http::empty_body> parser_;
  std::int64_t id_ = 0;
  std::map<std::uint32_t, std::uint32_t> subscriptions_;  ///< channel, by the client's id
  std::map<std::uint32_t, foxglove::ClientAdvertise::Entry> advertised_;
  foxglove::WaitingMessages waiting_{kMaxFoxgloveBacklog};
  foxglove::WaitingMessage sent_;  ///< being written
  bool is_open_ = false, writing_ = false;
};

}  // namespace

struct FoxgloveServer::Impl {
  void take(tcp::socket socket) {
    if (clients.connected.size() < kMaxFoxgloveClients) {
      std::make_shared<Client>(clients, std::move(socket))->start();
    } else {
      clients.count_refused();
    }
  }

  Clients clients;
  asio::io_context context{1};
  std::optional<AcceptLoop> connections;
  std::thread thread;
};

FoxgloveServer::FoxgloveServer(int listening_fd, Access access, std::vector<std::string> origins,
                               std::vector<foxglove::Channel> channels, std::string session)
    : impl_(std::make_unique<Impl>()) {
  Clients& clients = impl_->clients;
  clients.access = std::move(access);
  clients.origins = std::move(origins);
  clients.session = std::move(session);
  clients.newest.resize(channels.size());
  clients.subscribers = std::vector<std::atomic<int>>(channels.size());
  clients.channels = std::move(channels);
  impl_->connections.emplace(impl_->context, listening_fd, "a Foxglove client",
                             [impl = impl_.get()](tcp::socket socket) { impl->take(std::move(socket)); });
  impl_->thread = std::thread([impl = impl_.get()] { impl->context.run(); });
}

FoxgloveServer::~FoxgloveServer() {
  impl_->context.stop();
  impl_->thread.join();
}

bool FoxgloveServer::is_wanted(std::size_t channel) const {
  return impl_->clients.channels[channel].latched || impl_->clients.subscribers[channel] > 0;
}

void FoxgloveServer::publish(std::size_t channel, UTime at, std::string cdr) {
  auto payload = std::make_shared<const std::string>(std::move(cdr));
  asio::post(impl_->context, [impl = impl_.get(), channel, at, payload = std::move(payload)] {
    if (impl->clients.channels[channel].latched) impl->clients.newest[channel] = {at, payload};
    for (const auto& [id, weak] : std::map(impl->clients.connected)) {
      if (const auto client = weak.lock()) client->publish(channel, at, payload);
    }
  });
}

void FoxgloveServer::tell(std::int64_t client, foxglove::Level level, const std::string& message) {
  asio::post(impl_->context, [impl = impl_.get(), client, text = foxglove::status(level, message)]() mutable {
    const auto found = impl->clients.connected.find(client);
    if (found == impl->clients.connected.end()) return;
    if (const auto connected = found->second.lock()) connected->tell(std::move(text));
  });
}

std::vector<FoxglovePublished> FoxgloveServer::take_published() {
  const std::lock_guard lock(impl_->clients.mutex);
  return std::exchange(impl_->clients.inbox, {});
}

FoxgloveCounters FoxgloveServer::counters() const {
  const std::lock_guard lock(impl_->clients.mutex);
  return impl_->clients.counters;
}

}  // namespace tern
