#include "tools/export/csv_files.h"

#include <fmt/format.h>

#include <string_view>

namespace tern::exporting {
namespace {

using Form = MessageField::Form;

void append_columns(std::string& head, const std::string& name, const MessageField& field, const std::string& unit);

/// @param prefix  "" or ends with a dot
void append_columns(std::string& head, const std::string& prefix, const MessageType& type, const std::string& unit) {
  for (const MessageField& field : type.fields) {
    const std::string own = field.unit.empty() ? unit : field.unit;
    if (field.form == Form::FixedArray) {
      for (int k = 0; k < field.size; ++k)
        append_columns(head, fmt::format("{}{}.{}", prefix, field.name, k), field, own);
    } else if (field.form != Form::List) {
      append_columns(head, prefix + field.name, field, own);
    }
  }
}

void append_columns(std::string& head, const std::string& name, const MessageField& field, const std::string& unit) {
  const auto nested = message_types().find(field.type);
  if (nested != message_types().end()) {
    append_columns(head, name.empty() ? "" : name + ".", nested->second, unit);
  } else {
    head += "," + (name.empty() ? field.name : name) + (unit.empty() ? "" : " [" + unit + "]");
  }
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
    table.file.open(folder_ / (name + ".csv"));
    table.file << head << '\n';
  }
  return table;
}

void CsvFiles::add(const LoggedMessage& message) {
  const MessageType& type = message_types().find(message.type)->second;
  std::string head = "message,received_us";
  if (!tables_.contains(message.channel)) append_columns(head, "", type, "");
  Table& messages = table(message.channel, head);
  std::string row = fmt::format("{},{}", messages.rows, message.received_us);
  for (const MessageField& field : type.fields) {
    const Json& value = message.fields.at(field.name);
    if (field.form != Form::List) {
      append_cells(row, value);
      continue;
    }
    std::string list_head = "message,index";
    append_columns(list_head, "", field, field.unit);
    Table& list = table(message.channel + "." + field.name, list_head);
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
