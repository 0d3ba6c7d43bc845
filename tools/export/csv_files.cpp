#include "tools/export/csv_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "ros_messages/message_types.h"
#include "tools/export/columns.h"
#include "tools/export/message_json.h"

namespace tern::exporting {
namespace {

using ros::message_types;
using ros::MessageField;
using ros::MessageType;
using Form = MessageField::Form;

std::string head_of(const char* first_columns, const std::vector<std::string>& columns) {
  return fmt::format("{},{}", first_columns, fmt::join(columns, ","));
}

std::string csv_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + '"';
}

void append_cells(std::string& row, const Json& value) {
  if (value.is_structured()) {
    for (const Json& part : value) append_cells(row, part);
  } else if (value.is_string()) {
    row += "," + csv_text(value.get_ref<const std::string&>());
  } else if (value.is_number_float()) {
    fmt::format_to(std::back_inserter(row), ",{}", value.get<double>());
  } else {
    row += "," + value.dump();
  }
}

}  // namespace

CsvFiles::Table& CsvFiles::table(const std::string& name, const std::string& head) {
  Table& table = tables_[name];
  if (!table.file.is_open()) {
    table.file.open(outputs_.part_of(folder_ / (name + ".csv")));
    table.file << head << '\n';
  }
  return table;
}

void CsvFiles::add(const LoggedMessage& message) {
  const MessageType& type = message_types().find(message.type)->second;
  std::string head;
  if (!tables_.contains(message.channel)) head = head_of("message,received_us", column_names(type));
  Table& messages = table(message.channel, head);
  std::string row = fmt::format("{},{}", messages.rows, message.received_us);
  const Json fields = message_json(message.type, message.bytes);
  for (const MessageField& field : type.fields) {
    const Json& value = fields.at(field.name);
    if (field.form != Form::List) {
      append_cells(row, value);
      continue;
    }
    Table& list = table(message.channel + "." + field.name, head_of("message,index", column_names(field)));
    for (std::size_t k = 0; k < value.size(); ++k) {
      std::string element = fmt::format("{},{}", messages.rows, k);
      append_cells(element, value[k]);
      list.file << element << '\n';
    }
  }
  messages.file << row << '\n';
  ++messages.rows;
}

Result<void> CsvFiles::finish() {
  for (auto& [name, table] : tables_) {
    table.file.close();
    if (!table.file) return fail(fmt::format("{}: cannot be written", (folder_ / (name + ".csv")).string()));
  }
  return {};
}

}  // namespace tern::exporting
