// SPDX-License-Identifier: Apache-2.0
#include "ui/state/run_report.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/files.h"
#include "report/data.h"
#include "report/report.h"
#include "ui/state/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <system_error>
#include <vector>

namespace nephroid::ui {
namespace {

namespace fs = std::filesystem;

/// A folder beside the page that nobody had, made here. Throws failed where it cannot be made.
fs::path claim_new_folder(const fs::path& file)
{
  const std::string stem = file.stem().string() + "-runs";
  for (int n = 1;; ++n) {
    fs::path folder = file;
    folder.replace_filename(n == 1 ? stem : fmt::format("{}-{}", stem, n));
    std::error_code error;
    if (fs::create_directory(folder, error)) return folder;
    std::error_code none;
    if (!fs::exists(fs::symlink_status(folder, none))) throw failed(folder.string(), "cannot be made: " + error.message());
  }
}

std::string folder_name(std::size_t number, const std::string& name)
{
  constexpr std::size_t longest = 40;
  std::string plain = name.substr(0, longest);
  for (char& c : plain)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view("._-+=,").find(c) == std::string_view::npos) c = '-';
  return fmt::format("{:02}-{}", number, plain);
}

/// Whether the folder still holds the run that was read from it.
bool is_still_there(const RunRecord& record)
{
  if (record.folder.empty()) return false;
  try {
    return std::ranges::all_of(record.texts, [&](const auto& file) { return read_file(record.folder / file.first) == file.second; });
  } catch (const Error&) {
    return false;
  }
}

/// Removes what was written unless it is kept.
struct Written {
  fs::path folder; ///< claimed; empty while nothing was written
  bool keep = false;
  ~Written()
  {
    std::error_code ignored;
    if (!keep && !folder.empty()) fs::remove_all(folder, ignored);
  }
};

} // namespace

std::string write_report(const fs::path& file, std::span<const PinnedRun> runs)
{
  if (file.extension() != ".html") throw bad_input(file.string(), "a report is a page", "expected a name that ends in .html");
  std::string left_out;
  std::vector<const PinnedRun*> taken;
  for (const PinnedRun& run : runs) {
    std::string why = why_no_folder(run);
    if (taken.size() == report::max_runs) why = fmt::format("a page has at most {} runs", report::max_runs);
    if (why.empty())
      taken.push_back(&run);
    else
      left_out += fmt::format("{}\"{}\": {}", left_out.empty() ? "" : "; ", run.name, why);
  }
  if (taken.empty())
    throw bad_input(file.string(), "there is no run for a report" + (left_out.empty() ? "" : " (" + left_out + ")"),
                    "expected finished runs", "wait until the run is finished, or pin finished ones");
  Written written;
  std::vector<fs::path> folders;
  std::set<fs::path> seen;
  for (const PinnedRun* run : taken) {
    if (is_still_there(*run->record)) {
      if (seen.insert(run->record->folder).second) folders.push_back(run->record->folder); // else pinned twice
      continue;
    }
    if (written.folder.empty()) written.folder = claim_new_folder(file);
    folders.push_back(written.folder / folder_name(folders.size() + 1, run->name));
    write_run_folder(folders.back(), *run, run->name, true);
  }
  write_file_whole(file, report::report_html(folders));
  written.keep = true;
  std::string note = fmt::format("saved {}, a report over {}", file.string(), counted(folders.size(), "run"));
  if (!written.folder.empty()) note += fmt::format("; their files are in {}", written.folder.string());
  return left_out.empty() ? note : note + "; left out: " + left_out;
}

} // namespace nephroid::ui
