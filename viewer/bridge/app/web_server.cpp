#include "viewer/bridge/app/web_server.h"

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "runtime/log.h"
#include "viewer/bridge/app/accept_loop.h"

namespace tern {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::asio::ip::tcp;
using Request = http::request<http::string_body>;

constexpr char kStreamPath[] = "/stream";
constexpr auto kRequestTimeout = std::chrono::seconds(10);
constexpr unsigned kMaxHeaderBytes = 8192;
constexpr unsigned kMaxBodyBytes = 1024;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Returns the n of {"seen":n}, by far the most frequent message of a page.
std::optional<std::int64_t> seen_frame(std::string_view text) {
  constexpr std::string_view kHead = R"({"seen":)";
  if (!text.starts_with(kHead) || !text.ends_with('}')) return std::nullopt;
  std::int64_t n = 0;
  const char* last = text.data() + text.size() - 1;
  const auto [stop, error] = std::from_chars(text.data() + kHead.size(), last, n);
  return error == std::errc{} && stop == last ? std::optional(n) : std::nullopt;
}

class Stream;

/// The state that connections share. Everything except the inbox belongs to the server's thread.
struct Shared {
  PageFiles files;
  Access access;
  const Board& board;
  std::map<std::int64_t, std::weak_ptr<Stream>> streams;
  std::int64_t last_client = 0;
  int connections = 0;

  mutable std::mutex mutex;  ///< guards the members below
  std::vector<ClientCommand> inbox;
  std::vector<std::int64_t> clients;
  WebCounters counters;

  void count_refused() {
    const std::lock_guard lock(mutex);
    ++counters.refused;
  }
};

/// The stream to one page.
class Stream : public std::enable_shared_from_this<Stream> {
 public:
  Stream(Shared& shared, beast::tcp_stream socket) : shared_(shared), socket_(std::move(socket)) {}

  ~Stream() {
    if (id_ == 0) return;
    shared_.streams.erase(id_);
    const std::lock_guard lock(shared_.mutex);
    std::erase(shared_.clients, id_);
  }

  void start(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(kMaxCommandBytes);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->open();
    });
  }

  void push() {
    if (writing_ || id_ == 0) return;
    if (!replies_.empty()) {
      text_ = std::move(replies_.front());
      replies_.pop_front();
    } else {
      if (reader_.frame - seen_ >= kFramesAhead) return;
      const std::int64_t dropped = reader_.dropped;
      text_ = shared_.board.take(reader_);
      if (text_.empty()) return;
      const std::lock_guard lock(shared_.mutex);
      ++shared_.counters.frames;
      shared_.counters.dropped += reader_.dropped - dropped;
    }
    writing_ = true;
    socket_.text(true);
    socket_.async_write(asio::buffer(text_), [self = shared_from_this()](beast::error_code error, std::size_t) {
      self->writing_ = false;
      if (!error) self->push();
    });
  }

  void reply(std::string json) {
    if (replies_.size() >= kMaxCommands) replies_.pop_front();
    replies_.push_back(std::move(json));
    push();
  }

 private:
  void open() {
    id_ = ++shared_.last_client;
    shared_.streams[id_] = weak_from_this();
    {
      const std::lock_guard lock(shared_.mutex);
      shared_.clients.push_back(id_);
    }
    push();
    read();
  }

  void read() {
    socket_.async_read(input_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->socket_.next_layer().close();
      self->receive(beast::buffers_to_string(self->input_.data()));
      self->input_.consume(self->input_.size());
      self->read();
    });
  }

  void receive(std::string text) {
    if (const auto n = seen_frame(text)) {
      seen_ = std::max(seen_, std::min(*n, reader_.frame));
      return push();
    }
    const std::lock_guard lock(shared_.mutex);
    if (shared_.inbox.size() >= kMaxCommands * shared_.clients.size()) {
      ++shared_.counters.commands_dropped;
    } else {
      shared_.inbox.push_back({id_, std::move(text)});
    }
  }

  Shared& shared_;
  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer input_;
  std::int64_t id_ = 0;
  Board::Reader reader_;
  std::int64_t seen_ = 0;
  std::deque<std::string> replies_;
  std::string text_;  ///< being written
  bool writing_ = false;
};

/// One HTTP connection, until it becomes a stream.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Shared& shared, tcp::socket socket) : shared_(shared), socket_(std::move(socket)) {
    ++shared_.connections;
  }
  ~Connection() { --shared_.connections; }

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(kMaxBodyBytes);
    socket_.expires_after(kRequestTimeout);
    http::async_read(socket_, input_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error) self->serve(self->parser_->release());
    });
  }

 private:
  void serve(const Request& request) {
    const std::string_view host = view(request[http::field::host]);
    if (!shared_.access.allows_host(host)) return refuse(request, http::status::forbidden, "unknown Host");
    const std::string_view target = view(request.target());
    if (target == kStreamPath && websocket::is_upgrade(request)) {
      if (!shared_.access.allows_origin(view(request[http::field::origin]), host)) {
        return refuse(request, http::status::forbidden, "foreign Origin");
      }
      if (shared_.streams.size() >= kMaxStreams) {
        return refuse(request, http::status::service_unavailable, "too many pages are connected");
      }
      return std::make_shared<Stream>(shared_, std::move(socket_))->start(request);
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return refuse(request, http::status::method_not_allowed, "GET only");
    }
    const auto file = shared_.files.find(target.substr(0, target.find('?')));
    if (file == shared_.files.end()) return refuse(request, http::status::not_found, "no such page");
    send(request, http::status::ok, file->second);
  }

  void refuse(const Request& request, http::status status, const std::string& why) {
    shared_.count_refused();
    send(request, status, {"text/plain; charset=utf-8", why + "\n"});
  }

  void send(const Request& request, http::status status, const PageFile& file) {
    auto response = std::make_shared<http::response<http::string_body>>(status, request.version());
    response->set(http::field::content_type, file.type);
    response->set(http::field::cache_control, "no-cache");
    response->set("Content-Security-Policy",
                  "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; frame-ancestors 'none'");
    response->set("X-Content-Type-Options", "nosniff");
    response->set("Referrer-Policy", "no-referrer");
    response->keep_alive(request.keep_alive());
    response->body() = file.bytes;
    response->prepare_payload();
    if (request.method() == http::verb::head) response->body().clear();
    http::async_write(socket_, *response, [self = shared_from_this(), response](beast::error_code error, std::size_t) {
      if (!error && response->keep_alive()) return self->read();
      beast::error_code ignored;
      self->socket_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  Shared& shared_;
  beast::tcp_stream socket_;
  beast::flat_buffer input_{kMaxHeaderBytes + kMaxBodyBytes};
  std::optional<http::request_parser<http::string_body>> parser_;
};

}  // namespace

struct WebServer::Impl {
  Impl(int fd, PageFiles files, Access access, const Board& board)
      : shared{std::move(files), std::move(access), board, {}, 0, 0, {}, {}, {}, {}},
        connections(context, fd, "a browser", [this](tcp::socket socket) { take(std::move(socket)); }) {}

  void take(tcp::socket socket) {
    if (shared.connections < kMaxConnections) {
      std::make_shared<Connection>(shared, std::move(socket))->read();
    } else {
      shared.count_refused();
    }
  }

  Shared shared;
  asio::io_context context{1};
  AcceptLoop connections;
  std::atomic<bool> awake{false};
  std::thread thread;
};

WebServer::WebServer(int listening_fd, PageFiles files, Access access, const Board& board)
    : impl_(std::make_unique<Impl>(listening_fd, std::move(files), std::move(access), board)) {
  impl_->thread = std::thread([impl = impl_.get()] { impl->context.run(); });
}

WebServer::~WebServer() {
  impl_->context.stop();
  impl_->thread.join();
}

void WebServer::wake() {
  if (impl_->awake.exchange(true)) return;
  asio::post(impl_->context, [impl = impl_.get()] {
    impl->awake = false;
    for (const auto& [id, weak] : std::map(impl->shared.streams)) {
      if (const auto stream = weak.lock()) stream->push();
    }
  });
}

void WebServer::reply(std::int64_t client, std::string json) {
  asio::post(impl_->context, [impl = impl_.get(), client, json = std::move(json)]() mutable {
    const auto found = impl->shared.streams.find(client);
    if (found == impl->shared.streams.end()) return;
    if (const auto stream = found->second.lock()) stream->reply(std::move(json));
  });
}

std::vector<ClientCommand> WebServer::take_commands() {
  const std::lock_guard lock(impl_->shared.mutex);
  return std::exchange(impl_->shared.inbox, {});
}

std::vector<std::int64_t> WebServer::clients() const {
  const std::lock_guard lock(impl_->shared.mutex);
  return impl_->shared.clients;
}

WebCounters WebServer::counters() const {
  const std::lock_guard lock(impl_->shared.mutex);
  return impl_->shared.counters;
}

}  // namespace tern
