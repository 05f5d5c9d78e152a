// SPDX-License-Identifier: Apache-2.0
#include "optics/tables.h"

#include "base/error.h"

#include <algorithm>
#include <charconv>

namespace nephroid::optics {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator)
{
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

double number(std::string_view text, std::string_view table)
{
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end != text.data() + text.size())
    throw failed(std::string(table), "the built-in table has a broken number", {}, "repair the file in app/optics/data");
  return value;
}

} // namespace

std::vector<Row> Table::rows(std::size_t column) const
{
  std::vector<Row> result(nm.size());
  for (std::size_t i = 0; i < nm.size(); ++i) result[i] = {nm[i], values[column][i]};
  return result;
}

Table read_table(std::string_view name)
{
  const auto& all = embedded_tables();
  const auto found = std::find_if(all.begin(), all.end(), [&](const EmbeddedTable& t) { return t.name == name; });
  if (found == all.end()) throw failed(std::string(name), "no such built-in table");

  Table table;
  for (std::string_view line : split(found->csv, '\n')) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.empty()) continue;
    const std::vector<std::string_view> fields = split(line, ',');
    if (table.columns.empty()) {
      table.columns.assign(fields.begin() + 1, fields.end());
      table.values.resize(table.columns.size());
      continue;
    }
    if (fields.size() != table.columns.size() + 1) throw failed(std::string(name), "the built-in table has a row of another length");
    table.nm.push_back(number(fields[0], name));
    for (std::size_t i = 1; i < fields.size(); ++i) table.values[i - 1].push_back(number(fields[i], name));
  }
  return table;
}

} // namespace nephroid::optics
