// SPDX-License-Identifier: Apache-2.0
// The verbs of the command line: one file a verb, each adding its subcommand here; those that only list what there is are in lists.cpp. A
// verb's callback does the work and throws Error; it sets the exit code where that is not 0. Results go to standard output, everything else
// to standard error. A verb that ends in order on Ctrl-C makes an Interrupts (base/interrupts.h).
#pragma once
#include <string>

namespace CLI {
class App;
}
namespace nephroid::compute {
struct DeviceInfo;
}

namespace nephroid::cli {

struct Session {
  int exit_code = 0;
};

void add_run(CLI::App& program, Session& session);
void add_plan(CLI::App& program, Session& session);
void add_dispersion(CLI::App& program, Session& session);
void add_clusters(CLI::App& program, Session& session);
void add_importance(CLI::App& program, Session& session);
void add_segment(CLI::App& program, Session& session);
void add_report(CLI::App& program, Session& session);
void add_compare(CLI::App& program, Session& session);
void add_import(CLI::App& program, Session& session);
void add_presets(CLI::App& program, Session& session);
void add_devices(CLI::App& program, Session& session);
void add_check(CLI::App& program, Session& session);
void add_manual(CLI::App& program, Session& session);
void add_schema(CLI::App& program, Session& session);
void add_version(CLI::App& program, Session& session);

/// "0  NAME  (cpu, 2 compute units, 8.1 GB, PLATFORM DRIVER, no fp64)"
std::string device_line(const compute::DeviceInfo& device);

} // namespace nephroid::cli
