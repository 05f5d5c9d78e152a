// SPDX-License-Identifier: Apache-2.0
// Kernel sources as the compiler gets them: one text with every include in its place, so that no file is needed at run time
// and messages still name the file and line that a person edits.
#include "base/files.h"
#include "compute/embedded.h"
#include "compute/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace nephroid::compute {
namespace {

namespace fs = std::filesystem;

std::string source_text(const fs::path& folder, const std::string& file, const Place& where)
{
  if (!folder.empty()) {
    if (!fs::exists(folder / file)) throw failed(where, fmt::format("there is no kernel source {}", (folder / file).string()));
    return read_file(folder / file);
  }
  std::string names;
  for (const EmbeddedSource& source : embedded_sources()) {
    if (source.name == file) return source.text;
    names += (names.empty() ? "" : ", ") + source.name;
  }
  throw failed(where, "there is no kernel source " + file, "there are: " + names);
}

/// FILE of a line `#include "FILE"`; empty of any other.
std::string included_file(std::string_view line)
{
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

  void add(const std::string& file, const Place& where)
  {
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
      add(other, Place(file, number));
      text += fmt::format("#line {} \"{}\"\n", number + 1, file);
    }
  }
};

} // namespace

std::string detail::full_source(const fs::path& folder, const std::string& file)
{
  Joiner joiner{folder};
  joiner.add(file, "kernels");
  return joiner.text;
}

std::string kernel_sources(const Context& context, std::string_view folder)
{
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

std::string kernel_source(const Context& context, const std::string& file) { return detail::full_source(context.state->kernels, file); }

} // namespace nephroid::compute
