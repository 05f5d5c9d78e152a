// SPDX-License-Identifier: Apache-2.0
// The layout: version, sizes, wall and measuring seconds, column names, rows, the job's bytes.
#include "measure/history_record.h"

#include "base/error.h"

#include <cstdint>
#include <cstring>

namespace nephroid::measure {
namespace {

constexpr std::uint64_t record_version = 1;

class Writer {
public:
  template <class T>
  void add(const T& value)
  {
    add(&value, sizeof value);
  }
  void add(const void* from, std::size_t count)
  {
    const auto* bytes = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), bytes, bytes + count);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

private:
  std::vector<std::byte> bytes_;
};

class Reader {
public:
  explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}
  template <class T>
  T get()
  {
    T value;
    std::memcpy(&value, some(sizeof value).data(), sizeof value);
    return value;
  }
  std::span<const std::byte> some(std::size_t count)
  {
    if (count > left_.size()) throw bad_input("checkpoint", "is cut", "", "delete it and start again");
    const std::span<const std::byte> taken = left_.first(count);
    left_ = left_.subspan(count);
    return taken;
  }
  std::span<const std::byte> rest() const { return left_; }

private:
  std::span<const std::byte> left_;
};

} // namespace

std::vector<std::byte> with_history(std::vector<std::byte> job, const job::History& history, double wall_seconds)
{
  Writer to;
  to.add(record_version);
  to.add(static_cast<std::uint64_t>(history.columns.size()));
  to.add(static_cast<std::uint64_t>(history.rows.size()));
  to.add(wall_seconds);
  to.add(history.measuring_seconds);
  for (const std::string& column : history.columns) {
    to.add(static_cast<std::uint64_t>(column.size()));
    to.add(column.data(), column.size());
  }
  for (const job::HistoryRow& row : history.rows) {
    to.add(row.seconds);
    to.add(row.wall_seconds);
    to.add(row.step);
    to.add(row.work);
    for (const double error : row.errors) to.add(error);
  }
  to.add(job.data(), job.size());
  return to.take();
}

SavedHistory split_history(std::span<const std::byte> checkpoint)
{
  Reader from(checkpoint);
  if (from.get<std::uint64_t>() != record_version)
    throw bad_input("checkpoint", "was written by another version of the program", "", "delete it and start again");
  SavedHistory saved;
  const auto columns = from.get<std::uint64_t>(), rows = from.get<std::uint64_t>();
  saved.wall_seconds = from.get<double>();
  saved.history.measuring_seconds = from.get<double>();
  for (std::uint64_t i = 0; i < columns; ++i) {
    const auto letters = from.some(from.get<std::uint64_t>());
    saved.history.columns.emplace_back(reinterpret_cast<const char*>(letters.data()), letters.size());
  }
  for (std::uint64_t i = 0; i < rows; ++i) {
    job::HistoryRow row;
    row.seconds = from.get<double>();
    row.wall_seconds = from.get<double>();
    row.step = from.get<std::int64_t>();
    row.work = from.get<std::uint64_t>();
    for (std::uint64_t c = 0; c < columns; ++c) row.errors.push_back(from.get<double>());
    saved.history.rows.push_back(std::move(row));
  }
  saved.job = from.rest();
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
