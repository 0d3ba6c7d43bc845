#include "runtime/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <iterator>

namespace tern::log {
namespace {

spdlog::level::level_enum level_of(Level level) {
  switch (level) {
    case Level::Info: return spdlog::level::info;
    case Level::Warning: return spdlog::level::warn;
    case Level::Error: return spdlog::level::err;
    case Level::Critical: return spdlog::level::critical;
  }
  return spdlog::level::critical;
}

}  // namespace

void start(const std::string& process, const std::string& least_level) {
  // A process may be hosted several times in one test binary: the name is then taken already.
  spdlog::drop(process);
  spdlog::set_default_logger(spdlog::stderr_color_mt(process));
  spdlog::set_pattern("%H:%M:%S.%e %n %^%l%$: %v");
  spdlog::set_level(spdlog::level::from_str(least_level));
}

void flush() { spdlog::default_logger()->flush(); }

void write_formatted(Level level, fmt::string_view format, fmt::format_args values) {
  spdlog::logger& logger = *spdlog::default_logger_raw();
  const spdlog::level::level_enum severity = level_of(level);
  if (!logger.should_log(severity)) return;
  fmt::memory_buffer text;
  fmt::vformat_to(std::back_inserter(text), format, values);
  logger.log(severity, spdlog::string_view_t(text.data(), text.size()));
}

}  // namespace tern::log
