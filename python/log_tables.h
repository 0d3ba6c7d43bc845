// Tables of a log's messages, column by column: the tables of tern-export's CSV files (tools/export/csv_files.h).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"

namespace tern::python {

/// Values of one type: numbers, integers, flags, or texts and digests.
using ColumnValues =
    std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::uint8_t>, std::vector<std::string>>;

struct Column {
  std::string name;  ///< as in the head of the CSV file
  ColumnValues values;
};

/// A table; its columns have one length. Names: "PLAN", and "PLAN.control_points" for a list in a message.
using Tables = std::map<std::string, std::vector<Column>>;

/// The content of a log.
struct LogTables {
  Tables tables;
  std::string shortfalls;  ///< messages that could not be read, a line each; may be empty
};

/// Reads all messages that their receivers would accept.
/// @param wanted  channels without suffix; empty: all
/// @return an Error if the log cannot be opened, or if `wanted` has an unknown name
Result<LogTables> read_tables(const std::string& log, const std::string& suffix,
                              const std::vector<std::string>& wanted);

}  // namespace tern::python
