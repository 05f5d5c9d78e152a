// SPDX-License-Identifier: Apache-2.0
// Builds programs. The compiler gets one text with each included file once, in its place, whose lines still have their
// numbers.
#include "base/files.h"
#include "compute/embedded.h"
#include "compute/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <optional>
#include <set>
#include <sstream>

namespace nephroid::compute {
namespace {

namespace fs = std::filesystem;

std::string source_text(const fs::path& folder, const std::string& file, const Location& where) {
  if (!folder.empty()) {
    if (!fs::exists(folder / file))
      throw failed(where, fmt::format("there is no kernel source {}", (folder / file).string()));
    return read_file(folder / file);
  }
  std::string names;
  for (const EmbeddedSource& source : embedded_sources()) {
    if (source.name == file) return source.text;
    names += (names.empty() ? "" : ", ") + source.name;
  }
  throw failed(where, "there is no kernel source " + file, "there are: " + names);
}

/// FILE of a line `#include "FILE"`; empty for any other line.
std::string included_file(std::string_view line) {
  for (const std::string_view word : {"#", "include", "\""}) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with(word)) return {};
    line.remove_prefix(word.size());
  }
  if (line.starts_with("kernels/")) line.remove_prefix(std::string_view("kernels/").size());
  return std::string(line.substr(0, line.find('"')));
}

struct Joiner {
  const fs::path& folder;
  std::set<std::string> included = {};
  std::string text = {};

  void add(const std::string& file, const Location& where) {
    if (!included.insert(file).second) return;
    std::istringstream lines(source_text(folder, file, where));
    text += fmt::format("#line 1 \"{}\"\n", file);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const std::string other = included_file(line);
      if (other.empty()) {
        text += line + '\n';
        continue;
      }
      add(other, Location(file, number));
      text += fmt::format("#line {} \"{}\"\n", number + 1, file);
    }
  }
};

/// Vendors split options at white space in their own ways, so a definition must hold none.
void check_define(const std::string& name, const std::string& value) {
  const auto in_name = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  const bool identifier =
      !name.empty() && std::ranges::all_of(name, in_name) && !(name.front() >= '0' && name.front() <= '9');
  if (!identifier || value.find_first_of(" \t\n\v\f\r\"'\\") != std::string::npos)
    throw failed("-D" + name + "=" + value, "cannot be passed to a kernel compiler",
                 "a name, and a value without spaces and quotes");
}

/// Leaves out definitions that the source does not name, so that programs that differ in nothing else are built once.
std::string compiler_options(const DeviceInfo& device, const Defines& defines, const std::string& source) {
  std::string options = "-cl-std=CL1.2 -cl-kernel-arg-info";
  options += device.type == "cpu" ? " -DNEPHROID_CPU=1" : " -DNEPHROID_GPU=1";
  if (device.fp64) options += " -DNEPHROID_FP64=1";
  if (device.int64_atomics) options += " -DNEPHROID_INT64_ATOMICS=1";
  for (const auto& [name, value] : defines) {
    check_define(name, value);
    if (source.find(name) != std::string::npos) options += fmt::format(" -D{}={}", name, value);
  }
  return options;
}

/// The file and line that a line of the joined text is from.
Location place_in(const std::string& source, unsigned line) {
  std::istringstream lines(source);
  std::array<char, 256> file{};
  unsigned number = 0;
  for (std::string text; line > 0 && std::getline(lines, text); --line)
    if (std::sscanf(text.c_str(), "#line %9u \"%255[^\"]\"", &number, file.data()) == 2)
      --number;
    else
      ++number;
  return Location(file.data(), number);
}

/// Splits a line of the compiler's log into place and message; nothing if it names no place. NVIDIA's compiler does not
/// follow #line: it counts the lines of "<kernel>", the joined text.
std::optional<std::pair<Location, std::string>> located(std::string line, const std::string& source) {
  for (const std::string_view word : {"fatal error: ", "error: "})
    if (const std::size_t at = line.find(word); at != std::string::npos) line.erase(at, word.size());
  std::array<char, 256> file{};
  unsigned number = 0, column = 0;
  int end = 0;
  if (std::sscanf(line.c_str(), " %255[^: \t]:%9u:%u: %n", file.data(), &number, &column, &end) < 3)
    std::sscanf(line.c_str(), " %255[^: \t]:%9u: %n", file.data(), &number, &end);
  if (end == 0) return std::nullopt;
  const Location place = file[0] == '<' ? place_in(source, number) : Location(file.data(), number);
  return std::pair{place, line.substr(static_cast<std::size_t>(end))};
}

/// The log's first error. Compilers write "trace.cl:12:5: error: ...", PoCL 3 "error: trace.cl:12:5: ...".
BuildError build_error(const std::string& file, const std::string& source, const std::string& device,
                       const std::string& log) {
  std::istringstream lines(log);
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("error: ") == std::string::npos) continue;
    if (const auto error = located(line, source))
      return {error->first, fmt::format("{} (building {} for {})", error->second, file, device), log};
    if (first.empty()) first = line;
  }
  return {file,
          fmt::format("clBuildProgram gave CL_BUILD_PROGRAM_FAILURE for {}: {}", device, first.empty() ? log : first),
          log};
}

cl::Program build(detail::ContextState& context, const std::string& file, const std::string& source,
                  const std::string& options) {
  context.tell_of_compiling();
  context.cold = true;
  cl::Program program(context.context, source);
  try {
    program.build(context.device, options.c_str());
  } catch (const cl::BuildError& error) {
    const std::string log = error.getBuildLog().empty() ? "" : error.getBuildLog().front().second;
    if (log.find_first_not_of(" \n\t") == std::string::npos) throw detail::call_failed(error, file);
    throw build_error(file, source, context.info.name, log);
  }
  return program;
}

detail::KernelState::Parameter parameter_of(const cl::Kernel& kernel, cl_uint index) {
  detail::KernelState::Parameter parameter{
      kernel.getArgInfo<CL_KERNEL_ARG_NAME>(index), kernel.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(index),
      kernel.getArgInfo<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(index) != CL_KERNEL_ARG_ADDRESS_PRIVATE};
  const std::size_t end = parameter.type.find_first_of(" *"); // implementations write "float*" and "float *"
  if (end != std::string::npos) parameter.type.resize(end);
  return parameter;
}

} // namespace

Program::Program(const Context& context, const std::string& file, const Defines& defines) {
  detail::ContextState& s = *context.state;
  const std::string source = kernel_source(context, file);
  const std::string options = compiler_options(s.info, defines, source);
  try {
    detail::BuiltProgram& built = s.programs[{file, options}];
    if (built.source != source) built = {source, build(s, file, source, options)};
    state = std::make_shared<detail::ProgramState>(detail::ProgramState{context.state, file, built.program});
  } catch (const cl::Error& error) {
    throw detail::call_failed(error, file);
  }
}

Kernel Program::kernel(const std::string& name) const {
  Kernel kernel;
  kernel.state = std::make_shared<detail::KernelState>();
  kernel.state->context = state->context;
  kernel.state->name = state->file + ": " + name;
  try {
    kernel.state->kernel = cl::Kernel(state->program, name.c_str());
    const cl_uint count = kernel.state->kernel.getInfo<CL_KERNEL_NUM_ARGS>();
    for (cl_uint i = 0; i < count; ++i) kernel.state->parameters.push_back(parameter_of(kernel.state->kernel, i));
  } catch (const cl::Error& error) {
    if (error.err() != CL_INVALID_KERNEL_NAME) throw detail::call_failed(error, kernel.state->name);
    std::string names = state->program.getInfo<CL_PROGRAM_KERNEL_NAMES>();
    std::replace(names.begin(), names.end(), ';', ' ');
    throw failed(state->file, "has no kernel " + name, "there are: " + names);
  }
  return kernel;
}

std::string kernel_sources(const Context& context, std::string_view folder) {
  const fs::path& kernels = context.state->kernels;
  const std::string prefix = fmt::format("{}/", folder);
  std::set<std::string> files;
  if (kernels.empty()) {
    for (const EmbeddedSource& source : embedded_sources())
      if (source.name.starts_with(prefix)) files.insert(source.name);
  } else {
    std::error_code error;
    for (fs::directory_iterator entry(kernels / folder, error), end; !error && entry != end; entry.increment(error))
      files.insert(prefix + entry->path().filename().string());
    if (error && error != std::errc::no_such_file_or_directory)
      throw failed((kernels / folder).string(), "cannot be read: " + error.message());
  }
  std::string all;
  for (const std::string& file : files)
    if (file.ends_with(".cl")) all += kernel_source(context, file);
  return all;
}

std::string kernel_source(const Context& context, const std::string& file) {
  Joiner joiner{context.state->kernels};
  joiner.add(file, "kernels");
  return joiner.text;
}

KernelTimes kernel_times(const fs::path& folder) {
  KernelTimes times;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone; // a file that an editor replaces may vanish between the two calls
    const auto time = entry->last_write_time(gone);
    if (!gone) times[entry->path()] = time;
  }
  return times;
}

} // namespace nephroid::compute
