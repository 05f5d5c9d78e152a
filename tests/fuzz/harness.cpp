// SPDX-License-Identifier: Apache-2.0
// The ways in for libFuzzer. PROGRAM --seeds=FOLDER writes the seeds into the folder instead.
#include "tests/fuzz/harness.h"

#include "base/files.h"

#include <unistd.h>

namespace nephroid::fuzz {

void finding(const std::string& what) {
  fmt::print(stderr, "finding: {}\n", what);
  std::abort();
}

void judge(const Error& refusal) {
  constexpr std::size_t longest = 4096;
  const std::string line = refusal.line();
  if (refusal.kind() != ErrorKind::bad_input) finding("an error that is not of bad input: " + line);
  if (std::ranges::any_of(line, [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    finding("a refusal with control characters: " + line);
  if (line.size() > longest) finding(fmt::format("a refusal of {} characters: {}", line.size(), line));
}

const fs::path& folder() {
  static const fs::path made = [] {
    fs::path path = fs::temp_directory_path() / fmt::format("nephroid-fuzz-{}", ::getpid());
    fs::create_directories(path);
    return path;
  }();
  return made;
}

fs::path write(const std::string& name, std::string_view bytes) {
  fs::path file = folder() / name;
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

std::vector<std::string> parts_of(std::string_view input) {
  std::vector<std::string> parts;
  for (std::size_t end = 0; (end = input.find(between)) != std::string_view::npos;
       input.remove_prefix(end + between.size()))
    parts.emplace_back(input.substr(0, end));
  parts.emplace_back(input);
  return parts;
}

std::vector<std::string> shipped(const std::string& name, const std::string& extension) {
  std::vector<std::string> texts;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(presets_folder() / name))
    if (entry.path().extension() == extension) texts.push_back(read_file(entry.path()));
  return texts;
}

} // namespace nephroid::fuzz

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  using namespace nephroid::fuzz;
  constexpr std::string_view flag = "--seeds=";
  const std::string_view last = (*arguments)[*count - 1];
  const std::vector<std::string> first =
      seeds(); // with what every input needs, as a job that has begun: its time is no input's
  if (!last.starts_with(flag)) return 0;
  const nephroid::fs::path into = last.substr(flag.size());
  nephroid::fs::create_directories(into);
  int number = 0;
  for (const std::string& seed : first)
    std::ofstream(into / fmt::format("seed-{}", number++), std::ios::binary) << seed;
  std::exit(0);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace nephroid::fuzz;
  using nephroid::test::processor_seconds;
  const double began = processor_seconds();
  accepts([&] { read({reinterpret_cast<const char*>(bytes), size}); });
  if (const double seconds = processor_seconds() - began; seconds > 5)
    finding(fmt::format("{:.1f} s of processor time", seconds));
  return 0;
}
