// The log of a process on stderr. Its library (spdlog) is compiled in log.cpp alone: reading it takes 4 s a source.
#pragma once

#include <fmt/format.h>

#include <string>

namespace tern::log {

enum class Level { Info, Warning, Error, Critical };

/// Lines appear from here on as "HH:MM:SS.mmm PROCESS LEVEL: TEXT", if they are of `least_level` or above: trace,
/// debug, info, warning, error or off. Before, they appear on stdout in spdlog's own form.
void start(const std::string& process, const std::string& least_level);

/// Waits until all lines are written.
void flush();

/// Formats and writes one line, if its level is logged. May be called by any thread.
void write_formatted(Level level, fmt::string_view format, fmt::format_args values);

template <class... Values>
void write(Level level, fmt::format_string<Values...> format, Values&&... values) {
  write_formatted(level, format, fmt::make_format_args(values...));
}

template <class... Values>
void info(fmt::format_string<Values...> format, Values&&... values) {
  write_formatted(Level::Info, format, fmt::make_format_args(values...));
}

template <class... Values>
void warn(fmt::format_string<Values...> format, Values&&... values) {
  write_formatted(Level::Warning, format, fmt::make_format_args(values...));
}

template <class... Values>
void error(fmt::format_string<Values...> format, Values&&... values) {
  write_formatted(Level::Error, format, fmt::make_format_args(values...));
}

template <class... Values>
void critical(fmt::format_string<Values...> format, Values&&... values) {
  write_formatted(Level::Critical, format, fmt::make_format_args(values...));
}

}  // namespace tern::log
