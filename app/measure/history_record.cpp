// SPDX-License-Identifier: Apache-2.0
// The layout: version, wall and measuring seconds, column names, rows.
#include "measure/history_record.h"

#include "base/error.h"

#include <cstdint>
#include <span>

namespace nephroid::measure {
namespace {

constexpr std::uint64_t record_version = 2;

Error is_cut() { return bad_input("checkpoint", "is cut", "", "delete it and start again"); }

/// A count of items of at least so many bytes each, which the rest of the checkpoint has to hold: so that no wrong count takes all memory.
std::size_t load_count(ByteSource& from, std::size_t bytes_each)
{
  std::uint64_t count = 0;
  from.value(count);
  if (count > from.left() / bytes_each) throw is_cut();
  return static_cast<std::size_t>(count);
}

} // namespace

void save_history(const job::History& history, double wall_seconds, ByteSink& to)
{
  to.value(record_version);
  to.value(wall_seconds);
  to.value(history.measuring_seconds);
  to.value(std::uint64_t{history.columns.size()});
  for (const std::string& column : history.columns) {
    to.value(std::uint64_t{column.size()});
    to.write(std::as_bytes(std::span(column)));
  }
  to.value(std::uint64_t{history.rows.size()});
  for (const job::HistoryRow& row : history.rows) {
    to.value(row.seconds);
    to.value(row.wall_seconds);
    to.value(row.step);
    to.value(row.work);
    to.write(std::as_bytes(std::span(row.errors)));
  }
}

SavedHistory load_history(ByteSource& from)
{
  std::uint64_t version = 0;
  from.value(version);
  if (version != record_version)
    throw bad_input("checkpoint", "was written by another version of the program", "", "delete it and start again");
  SavedHistory saved;
  from.value(saved.wall_seconds);
  from.value(saved.history.measuring_seconds);
  saved.history.columns.resize(load_count(from, sizeof(std::uint64_t)));
  for (std::string& column : saved.history.columns) {
    column.resize(load_count(from, 1));
    from.read(std::as_writable_bytes(std::span(column)));
  }
  saved.history.rows.resize(load_count(from, (4 + saved.history.columns.size()) * sizeof(double)));
  for (job::HistoryRow& row : saved.history.rows) {
    from.value(row.seconds);
    from.value(row.wall_seconds);
    from.value(row.step);
    from.value(row.work);
    row.errors.resize(saved.history.columns.size());
    from.read(std::as_writable_bytes(std::span(row.errors)));
  }
  return saved;
}

std::vector<job::HistoryRow> rows_in_columns(const job::History& history, const std::vector<std::string>& columns)
{
  std::vector<job::HistoryRow> rows = history.rows;
  for (job::HistoryRow& row : rows) {
    std::vector<double> errors;
    for (const std::string& column : columns) errors.push_back(job::error_in(history, row, column));
    row.errors = std::move(errors);
  }
  return rows;
}

} // namespace nephroid::measure
