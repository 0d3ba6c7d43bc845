// A campaign's summary, from its flights to its reader.
#pragma once

#include <cstdint>
#include <string>

namespace tern {

/// Reads FLIGHTS.csv, prints its summary on stdout and writes it as JSON. @param summary_file  "": none
/// @return the exit code: 0, or 3 when a file cannot be read or written (said on stderr).
int write_summary(const std::string& flights_file, const std::string& summary_file, const std::string& command);

/// How many flights of FLIGHTS.csv were audited; 0 where there is no such file.
std::int64_t count_audited(const std::string& flights_file);

/// This process's command line, quoted for a shell where it must be.
std::string command_line();

}  // namespace tern
