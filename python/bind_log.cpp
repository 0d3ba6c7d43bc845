#include <pybind11/stl.h>

#include <utility>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/log_tables.h"

namespace tern::python {
namespace {

py::object array_of_column(ColumnValues values) {
  if (auto* flags = std::get_if<std::vector<std::uint8_t>>(&values)) {
    return array_of(std::move(*flags)).attr("view")("bool");
  }
  if (auto* texts = std::get_if<std::vector<std::string>>(&values)) {
    return py::module_::import("numpy").attr("array")(py::cast(*texts), py::arg("dtype") = "object");
  }
  if (auto* integers = std::get_if<std::vector<std::int64_t>>(&values)) return array_of(std::move(*integers));
  return array_of(std::move(std::get<std::vector<double>>(values)));
}

py::tuple read(const std::string& log, const std::string& suffix, const std::vector<std::string>& channels) {
  Result<LogTables> read;
  {
    const py::gil_scoped_release release;
    read = read_tables(log, suffix, channels);
  }
  if (!read) throw FileError(read.error().message);
  py::dict tables;
  for (auto& [name, columns] : read->tables) {
    py::dict table;
    for (Column& column : columns) table[py::str(column.name)] = array_of_column(std::move(column.values));
    tables[py::str(name)] = table;
  }
  return py::make_tuple(tables, read->shortfalls);
}

}  // namespace

void bind_log(py::module_& m) {
  using namespace py::literals;
  m.def("read_tables", &read, "log"_a, "suffix"_a = "", "channels"_a = std::vector<std::string>(),
        "The tables of a log, by name and column, and the messages that could not be read, as text. See read_log().");
}

}  // namespace tern::python
