// Controls a headless browser by the Chrome DevTools Protocol, over a pair of pipes.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace tern {

/// A browser process with one page. The destructor ends the process.
class Devtools {
 public:
  /// @param program  Chromium, searched in PATH
  /// @param profile  an empty folder that Chromium may write to
  /// @throws std::runtime_error if it cannot be started or stays silent
  Devtools(const std::string& program, const std::string& profile, int width, int height);
  ~Devtools();
  Devtools(const Devtools&) = delete;
  Devtools& operator=(const Devtools&) = delete;

  /// Opens a page and waits until the JavaScript expression `ready` is true. @throws std::runtime_error after 60 s
  void open(const std::string& url, const std::string& ready);
  /// Returns the value of a JavaScript expression. @throws std::runtime_error if the expression throws
  nlohmann::json evaluate(const std::string& expression);
  /// Returns the page as drawn at this moment: the bytes of a JPEG file.
  std::string picture();

 private:
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters);
  std::string read_message();

  pid_t browser_ = 0;
  int to_ = -1, from_ = -1;
  std::string unread_, session_;
  std::int64_t calls_ = 0;
};

}  // namespace tern
