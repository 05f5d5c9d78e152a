// SPDX-License-Identifier: Apache-2.0
// A verb of the command line and its options. CLI11, which parses them, is known to verb.cpp, command_line.cpp,
// manual.cpp and completions.cpp only: each file that includes it takes seconds more to compile.
#pragma once
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nephroid::compute {
struct DeviceInfo;
}

namespace nephroid::cli {

struct Example {
  std::string command; ///< the command with "nephroid"
  std::string says;    ///< what it does; may be empty
};

/// "Examples:", then a line for each. `says` becomes a shell comment, so that a line can be pasted. tests/docs runs
/// each of them in order.
std::string examples(const std::vector<Example>& list);

struct Option {
  const char* type = nullptr; ///< name of a value in the help
  std::string says = {};
  std::vector<std::string> words = {}; ///< the valid words; empty: any
  bool required = false;
  char separator = 0; ///< may stand between several values in one argument
  /// Range of a number. Without `from` any number is valid, as CLI11 reads it: "nan", -1 as 2^64 - 1, and 1e30 as the
  /// largest whole number.
  double from = std::numeric_limits<double>::quiet_NaN(), to = std::numeric_limits<double>::infinity();
  const char* needs = nullptr; ///< another option that must be given too
};

/// Adds a verb to the program. The variables that options fill must live until the work is done.
class Verb {
public:
  Verb(CLI::App& program, const char* name, const char* says, const std::vector<Example>& examples,
       const char* more = "");
  /// The program itself. Its options stand under `group` in the help.
  Verb(CLI::App& program, const char* group) : app_(program), group_(group) {}

  /// names: "-o,--output", or "FILE" for an argument. Value: a number, a std::string, a path, a std::optional of these,
  /// a std::array, or a std::vector, for which the option may be repeated.
  template <class Value>
  void option(const char* names, Value& value, const Option& option);
  void flag(const char* name, bool& value, const std::string& says, const char* excludes = nullptr);
  /// --set KEY=VALUE
  void overrides(std::vector<std::string>& values,
                 const std::string& says = "Change a setting: scene.lights.0.power_w=2; may be repeated");
  /// --device SEL and --kernels DIR
  void device(std::string& selector, std::filesystem::path& kernels);
  void work(std::function<void()> work);

private:
  CLI::App& app_;
  const char* group_ = nullptr;
};

/// What `nephroid [FILE...]` does. Both functions are empty in a build without the window.
struct Window {
  std::function<void(CLI::App& program)> add_options;
  std::function<int(const std::vector<std::string>& files)> open; ///< returns the exit code
};

/// Parses and runs one command. Returns the exit code; every error is one line on standard error.
int run_command_line(int argc, const char* const* argv, const Window& window);

/// What a verb leaves behind beside its output.
struct Session {
  int exit_code = 0;
};

// The verbs, a file each; lists.cpp has those that only list. A verb's callback does the work and throws Error. Results
// go to standard output, everything else to standard error.

void add_run(CLI::App& program, Session& session);
void add_measure(CLI::App& program, Session& session);
void add_gem(CLI::App& program, Session& session);
void add_plan(CLI::App& program, Session& session);
void add_dispersion(CLI::App& program, Session& session);
void add_clusters(CLI::App& program, Session& session);
void add_importance(CLI::App& program, Session& session);
void add_segment(CLI::App& program, Session& session);
void add_pictures(CLI::App& program, Session& session);
void add_plate(CLI::App& program, Session& session);
void add_judge(CLI::App& program, Session& session);
void add_report(CLI::App& program, Session& session);
void add_compare(CLI::App& program, Session& session);
void add_import(CLI::App& program, Session& session);
void add_export(CLI::App& program, Session& session);
void add_presets(CLI::App& program, Session& session);
void add_devices(CLI::App& program, Session& session);
void add_check(CLI::App& program, Session& session);
void add_manual(CLI::App& program, Session& session);
void add_completions(CLI::App& program, Session& session);
void add_schema(CLI::App& program, Session& session);
void add_version(CLI::App& program, Session& session);

/// "0  NAME  (cpu, 2 compute units, 8.1 GB, PLATFORM DRIVER, no fp64)"
std::string device_line(const compute::DeviceInfo& device);

} // namespace nephroid::cli
