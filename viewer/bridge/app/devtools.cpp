#include "viewer/bridge/app/devtools.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/child_process.h"

namespace tern {
namespace {

using nlohmann::json;

constexpr int kPatienceMs = 60'000;
constexpr int kLookMs = 100;

/// @pre whole groups of four digits
std::string from_base64(const std::string& text) {
  using boost::archive::iterators::binary_from_base64, boost::archive::iterators::transform_width;
  using Bytes = transform_width<binary_from_base64<std::string::const_iterator>, 8, 6>;
  std::string bytes(Bytes(text.begin()), Bytes(text.end()));
  bytes.resize(bytes.size() - static_cast<std::size_t>(std::count(text.begin(), text.end(), '=')));
  return bytes;
}

}  // namespace

Devtools::Devtools(const std::string& program, const std::string& profile, int width, int height) {
  int commands[2], answers[2];
  if (pipe2(commands, O_CLOEXEC) != 0 || pipe2(answers, O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe can be made");
  to_ = commands[1];
  from_ = answers[0];
  // The browser reads descriptor 3 and writes 4.
  const std::string redirect = fmt::format("exec \"$0\" \"$@\" 3<&{} 4>&{} 2>/dev/null", commands[0], answers[1]);
  std::vector<std::string> command = {"sh",
                                      "-c",
                                      redirect,
                                      program,
                                      "--headless",
                                      "--remote-debugging-pipe",
                                      "--no-first-run",
                                      "--hide-scrollbars",
                                      "--use-gl=angle",
                                      "--use-angle=swiftshader",
                                      "--enable-unsafe-swiftshader",
                                      fmt::format("--window-size={},{}", width, height),
                                      "--user-data-dir=" + profile};
  if (geteuid() == 0) command.emplace_back("--no-sandbox");  // Chromium has none for root
  browser_ = start_child({.command = std::move(command), .inherited = {commands[0], answers[1]}, .own_group = true});
  close(commands[0]);
  close(answers[1]);
  const json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_ = call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}}).at("sessionId");
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

Devtools::~Devtools() {
  close(to_);
  close(from_);
  kill(-browser_, SIGKILL);
  (void)await_child(browser_);
}

std::string Devtools::read_message() {
  while (true) {
    const std::size_t end = unread_.find('\0');
    if (end != std::string::npos) {
      std::string message = unread_.substr(0, end);
      unread_.erase(0, end + 1);
      return message;
    }
    pollfd answer{from_, POLLIN, 0};
    std::vector<char> buffer(1U << 16U);
    const ssize_t n = poll(&answer, 1, kPatienceMs) > 0 ? read(from_, buffer.data(), buffer.size()) : 0;
    if (n <= 0) throw std::runtime_error("the browser does not answer");
    unread_.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

json Devtools::call(const std::string& method, const json& parameters) {
  json command = {{"id", ++calls_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) command["sessionId"] = session_;
  const std::string text = command.dump() + '\0';
  if (write(to_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    throw std::runtime_error("the browser does not start: is it installed?");
  }
  while (true) {
    const json message = json::parse(read_message());
    if (message.value("id", std::int64_t{0}) != calls_) continue;
    if (message.contains("error")) throw std::runtime_error(method + ": " + message["error"].dump());
    return message.at("result");
  }
}

void Devtools::open(const std::string& url, const std::string& ready) {
  call("Page.navigate", {{"url", url}});
  for (int waited = 0; evaluate(ready) != true; waited += kLookMs) {
    if (waited >= kPatienceMs) throw std::runtime_error("the page does not start to draw");
    usleep(kLookMs * 1000);
  }
}

json Devtools::evaluate(const std::string& expression) {
  const json answer =
      call("Runtime.evaluate", {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails")) throw std::runtime_error(answer["exceptionDetails"].dump());
  return answer.at("result").value("value", json());
}

std::string Devtools::picture() {
  return from_base64(call("Page.captureScreenshot", {{"format", "jpeg"}, {"quality", 92}}).at("data"));
}

}  // namespace tern
