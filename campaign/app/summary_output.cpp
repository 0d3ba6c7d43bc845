#include "campaign/app/summary_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "campaign/app/commands.h"
#include "campaign/records/campaign_summary.h"
#include "core/base/files.h"

namespace tern {
namespace {

std::string shell_word(const std::string& word) {
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           std::string_view("-_=./:,+%@").find(c) != std::string_view::npos;
  };
  bool plain = !word.empty();
  std::string quoted = "'";
  for (const char c : word) {
    plain = plain && is_plain(c);
    quoted += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return plain ? word : quoted + "'";
}

}  // namespace

int write_summary(const std::string& flights_file, const std::string& summary_file, const std::string& command) {
  const auto flights = read_flights(flights_file);
  if (!flights) {
    fmt::print(stderr, "{}\n", flights.error().message);
    return kExitFile;
  }
  const CampaignSummary summary = summarize(*flights);
  fmt::print("{}", to_text(summary));
  if (summary_file.empty() || write_text(summary_file, to_json(summary, command))) return 0;
  fmt::print(stderr, "{}: cannot be written\n", summary_file);
  return kExitFile;
}

std::int64_t count_audited(const std::string& flights_file) {
  const auto flights = read_flights(flights_file);
  if (!flights) return 0;
  return std::ranges::count_if(flights->records, [](const auto& record) { return !record.second.audit.empty(); });
}

std::string command_line() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string line;
  for (std::string word; std::getline(in, word, '\0');) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

}  // namespace tern
