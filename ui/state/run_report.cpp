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

/// Beside the page, of a name that nothing has.
fs::path new_folder(const fs::path& file)
{
  fs::path folder = file;
  const std::string stem = file.stem().string() + "-runs";
  for (int n = 1; n == 1 || is_there(folder); ++n) folder.replace_filename(n == 1 ? stem : fmt::format("{}-{}", stem, n));
  return folder;
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
  fs::path folder;
  bool keep = false;
  ~Written()
  {
    std::error_code ignored;
    if (!keep) fs::remove_all(folder, ignored);
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
  Written written{new_folder(file)};
  std::vector<fs::path> folders;
  std::set<fs::path> seen;
  for (const PinnedRun* run : taken) {
    fs::path folder = written.folder / folder_name(folders.size() + 1, run->name);
    if (is_still_there(*run->record)) {
      folder = run->record->folder;
      if (!seen.insert(folder).second) continue; // pinned twice
    } else
      write_run_folder(folder, *run, run->name, true);
    folders.push_back(std::move(folder));
  }
  write_file_whole(file, report::report_html(folders));
  written.keep = true;
  std::string note = fmt::format("saved {}, a report over {}", file.string(), counted(folders.size(), "run"));
  if (is_there(written.folder)) note += fmt::format("; their files are in {}", written.folder.string());
  return left_out.empty() ? note : note + "; left out: " + left_out;
}

} // namespace nephroid::ui
