#include "python/log_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "flight_log/flight_log.h"
#include "messages/codec.h"
#include "ros_messages/message_types.h"
#include "ros_messages/wire_reader.h"
#include "tools/export/columns.h"
#include "tools/export/shortfalls.h"

namespace tern::python {
namespace {

using ros::message_types;
using ros::MessageField;
using ros::MessageType;
using ros::WireReader;
using Form = MessageField::Form;

/// Appends messages to their tables.
class TableWriter {
 public:
  explicit TableWriter(Tables& tables) : tables_(tables) {}

  void add(const std::string& channel, std::string_view type_name, std::int64_t received_us,
           std::span<const std::uint8_t> bytes) {
    const MessageType& type = message_types().find(type_name)->second;
    if (!tables_.contains(channel)) begin(channel, type);
    std::vector<Column>& table = tables_[channel];
    const auto message = static_cast<std::int64_t>(std::get<std::vector<std::int64_t>>(table[0].values).size());
    Cursor cursor(table);
    cursor.append(message);
    cursor.append(received_us);
    WireReader wire(bytes);
    std::map<std::string_view, std::size_t> counts;
    for (const MessageField& field : type.fields) {
      const std::size_t size = field.form == Form::FixedArray ? static_cast<std::size_t>(field.size)
                               : field.form == Form::Value    ? 1
                                                              : counts[field.count];
      if (field.form == Form::List) {
        add_list(channel + "." + field.name, field, message, size, wire);
      } else if (field.form == Form::Text) {
        const auto text = wire.take(size);
        cursor.append(std::string(text.begin(), text.end()));
      } else {
        for (std::size_t k = 0; k < size; ++k) {
          const std::int64_t value = add_value(field, wire, cursor);
          if (field.type == "int32_t") counts[field.name] = static_cast<std::size_t>(value);
        }
      }
    }
  }

 private:
  /// The next column of a row.
  class Cursor {
   public:
    explicit Cursor(std::vector<Column>& table) : next_(table.begin()) {}
    template <class T>
    void append(T value) {
      ColumnValues& values = (next_++)->values;
      if (!std::holds_alternative<std::vector<T>>(values)) values.emplace<std::vector<T>>();
      std::get<std::vector<T>>(values).push_back(std::move(value));
    }

   private:
    std::vector<Column>::iterator next_;
  };

  void begin(const std::string& channel, const MessageType& type) {
    begin_table(channel, {"message", "received_us"}, exporting::column_names(type));
    for (const MessageField& field : type.fields) {
      if (field.form != Form::List) continue;
      begin_table(channel + "." + field.name, {"message", "index"}, exporting::column_names(field));
    }
  }

  void begin_table(const std::string& name, std::vector<std::string> columns, const std::vector<std::string>& more) {
    columns.insert(columns.end(), more.begin(), more.end());
    std::vector<Column>& table = tables_[name];
    for (std::string& column : columns) table.push_back({std::move(column), std::vector<std::int64_t>()});
  }

  void add_list(const std::string& name, const MessageField& field, std::int64_t message, std::size_t size,
                WireReader& wire) {
    std::vector<Column>& table = tables_[name];
    for (std::size_t k = 0; k < size; ++k) {
      Cursor cursor(table);
      cursor.append(message);
      cursor.append(static_cast<std::int64_t>(k));
      add_value(field, wire, cursor);
    }
  }

  /// Appends one value, or the fields of a nested one. @return the value of an integer
  static std::int64_t add_value(const MessageField& field, WireReader& wire, Cursor& row) {
    const std::string& type = field.type;
    std::int64_t value = 0;
    if (type == "double") {
      row.append(std::bit_cast<double>(wire.unsigned_integer(8)));
    } else if (type == "float") {
      row.append(static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(wire.unsigned_integer(4)))));
    } else if (type == "boolean") {
      row.append(static_cast<std::uint8_t>(wire.unsigned_integer(1) != 0));
    } else if (field.digest) {
      row.append(fmt::format("{:#018x}", wire.unsigned_integer(8)));
    } else if (const auto nested = message_types().find(type); nested != message_types().end()) {
      for (const MessageField& inner : nested->second.fields) {
        const int size = inner.form == Form::FixedArray ? inner.size : 1;
        for (int k = 0; k < size; ++k) add_value(inner, wire, row);
      }
    } else {
      value = signed_integer(type, wire);
      row.append(value);
    }
    return value;
  }

  static std::int64_t signed_integer(std::string_view type, WireReader& wire) {
    if (type == "int64_t") return static_cast<std::int64_t>(wire.unsigned_integer(8));
    if (type == "int32_t") return static_cast<std::int32_t>(wire.unsigned_integer(4));
    if (type == "int16_t") return static_cast<std::int16_t>(wire.unsigned_integer(2));
    if (type == "int8_t") return static_cast<std::int8_t>(wire.unsigned_integer(1));
    return static_cast<std::int64_t>(wire.unsigned_integer(1));  // byte
  }

  Tables& tables_;
};

Result<void> check_names(const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted) {
    if (visit_channel(name, [](const auto&) {})) continue;
    std::string all;
    for_each_channel([&all](const auto& channel) { all += std::string(" ") + channel.name; });
    return fail(fmt::format("no channel {}; there are:{}", name, all));
  }
  return {};
}

}  // namespace

Result<LogTables> read_tables(const std::string& log, const std::string& suffix,
                              const std::vector<std::string>& wanted) {
  if (const auto known = check_names(wanted); !known) return tl::make_unexpected(known.error());
  LogTables result;
  TableWriter writer(result.tables);
  FlightLog reader(suffix);
  for_each_channel([&]<class T>(const Channel<T>& channel) {
    if (!wanted.empty() && std::ranges::find(wanted, channel.name) == wanted.end()) return;
    reader.on(channel, [&writer, name = std::string(channel.name)](const T& message, std::int64_t received_us) {
      writer.add(name, kLcmType<T>, received_us, encode(message));
    });
  });
  const auto contents = reader.read(log);
  if (!contents) return tl::make_unexpected(contents.error());
  result.shortfalls = exporting::shortfalls(*contents);
  return result;
}

}  // namespace tern::python
