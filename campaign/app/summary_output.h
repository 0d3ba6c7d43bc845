// Prints and writes the summary of a campaign.
#pragma once

#include <cstdint>
#include <string>

namespace tern {

/// Reads FLIGHTS.csv, prints its summary on stdout and writes it as JSON.
/// @param summary_file  the JSON file; "": none
/// @param command       the command line that made the campaign; stated in the JSON
/// @return the exit code: 0, or 3 if a file cannot be read or written; the reason is printed on stderr
int write_summary(const std::string& flights_file, const std::string& summary_file, const std::string& command);

/// Returns how many flights of FLIGHTS.csv were audited; 0 if the file cannot be read.
std::int64_t count_audited(const std::string& flights_file);

/// Returns this process's command line, quoted for a shell where necessary.
std::string command_line();

}  // namespace tern
