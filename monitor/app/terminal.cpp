#include "monitor/app/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

#include "monitor/live_line.h"

namespace tern {
namespace {

std::size_t terminal_columns() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return 80;
  return size.ws_col;
}

}  // namespace

LiveOutput::LiveOutput() : terminal_(isatty(STDOUT_FILENO) == 1) {}

Duration LiveOutput::period() const { return terminal_ ? Duration{200'000} : Duration{5'000'000}; }

std::size_t LiveOutput::columns() const { return terminal_ ? terminal_columns() - 1 : std::string::npos; }

void LiveOutput::show(const std::string& line) {
  if (terminal_) {
    // Carriage return, erase to the end of the line.
    std::printf("\r\x1b[K%s", fit(line, columns()).c_str());
    line_open_ = true;
  } else {
    std::printf("%s\n", line.c_str());
  }
  std::fflush(stdout);
}

void LiveOutput::print(const std::string& text) {
  std::printf("%s%s", line_open_ ? "\n" : "", text.c_str());
  std::fflush(stdout);
  line_open_ = false;
}

}  // namespace tern
