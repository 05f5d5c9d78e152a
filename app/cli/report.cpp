// SPDX-License-Identifier: Apache-2.0
// `nephroid report`: one page over finished runs, error against time first.
#include "report/report.h"
#include "base/files.h"
#include "cli/verb.h"
#include "plan/plan.h"

#include <fmt/format.h>

namespace nephroid::cli {
namespace fs = std::filesystem;
namespace {

struct ReportOptions {
  std::vector<fs::path> folders;
  fs::path output;
};

void write_report(const ReportOptions& options) {
  const fs::path file = !options.output.empty()      ? options.output
                        : options.folders.size() > 1 ? fs::path("report.html")
                                                     : options.folders.front() / "report.html";
  const std::string html = report::report_html(options.folders);
  write_file_whole(file, html);
  fmt::print("{}: {}, opens in a browser without a network\n", file.string(), plan::readable_bytes(html.size()));
}

} // namespace

void add_report(CLI::App& program, Session&) {
  const auto options = std::make_shared<ReportOptions>();
  Verb verb(program, "report", "One page over finished runs: error against time, speed-up at equal error, pictures",
            {{"nephroid run first-light --passes 8 -o out/optimal", ""},
             {"nephroid run first-light --passes 8 -o out/thesis --set spectral.method=thesis", ""},
             {"nephroid report out/optimal out/thesis", "writes report.html"}},
            "Compares runs that have a run.json; the folder of a sweep stands for all runs in it. Without -o the page "
            "of one\n"
            "folder is report.html in that folder, that of several is report.html in the current folder.");
  verb.option("DIR", options->folders, {.says = "Folders of finished runs or of sweeps", .required = true});
  verb.option("-o,--output", options->output, {.type = "FILE", .says = "The page's file"});
  verb.work([options] { write_report(*options); });
}

} // namespace nephroid::cli
