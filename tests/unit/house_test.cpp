// SPDX-License-Identifier: Apache-2.0
// The house rules that a machine can check: licence lines, file sizes, no trace of one machine, and that
// third_party/README.md and the install list name the dependencies that the build looks for.

#include "tests/support/test.h"

#include <regex>

namespace nephroid::house_test {

const fs::path root = NEPHROID_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Every file of the project, relative to its root: what .gitignore leaves out (build folders, output) is not the
/// project's.
std::vector<fs::path> project_files() {
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename().string();
    const bool top = entry.depth() == 0;
    if (entry->is_directory() &&
        (name == ".git" || name == ".cache" || (top && (name.starts_with("build") || name == "out")))) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file() && name != ".git" && name != "compile_commands.json") {
      files.push_back(fs::relative(entry->path(), root));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_source(const fs::path& file) {
  static const std::set<std::string> endings{".cpp", ".h", ".cl", ".cmake", ".sh", ".py"};
  return endings.contains(file.extension().string()) || file.filename() == "CMakeLists.txt" || file == ".ci/run";
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Line 1, or line 2 after a shebang, is the licence line and nothing else.
bool opens_with_licence(const std::string& text) {
  const std::vector<std::string> lines = lines_of(text);
  const std::size_t at = !lines.empty() && lines[0].starts_with("#!") ? 1 : 0;
  return lines.size() > at && (lines[at] == "// SPDX-License-Identifier: Apache-2.0" ||
                               lines[at] == "# SPDX-License-Identifier: Apache-2.0");
}

/// The first text that only one machine or one network has: a path below a home or mount folder, or a package
/// registry's address.
std::string machine_trace(const std::string& text) {
  static const std::regex trace(
      R"re((^|[\s"'`=(:,])/(home|root|Users|mnt|media|srv|work|farm|tmp)/[A-Za-z0-9])re"
      R"re(|https?://[A-Za-z0-9.-]*(pypi|debian|npm|registry|mirror|crates)[A-Za-z0-9.-]*)re");
  std::smatch match;
  for (const std::string& line : lines_of(text)) {
    if (std::regex_search(line, match, trace)) return line.substr(static_cast<std::size_t>(match.position()), 60);
  }
  return "";
}

/// The names that pattern's first group matches in text.
std::set<std::string> names_in(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::set<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    names.insert(match->str(1));
  return names;
}

/// The words of the bash arrays NAME_packages=(...) of third_party/packages.sh.
std::set<std::string> debian_packages() {
  std::set<std::string> packages;
  const std::string text = text_of(root / "third_party/packages.sh");
  for (const std::string& list : names_in(text, R"(\n[a-z]+_packages=\(([^)]*)\))")) {
    for (const std::string& name : names_in(list, R"(([a-z0-9+.-]+))")) packages.insert(name);
  }
  return packages;
}

/// Of every file of the project complaint() has nothing to say.
void expect_no(const std::function<std::string(const fs::path&)>& complaint) {
  std::vector<std::string> complaints;
  for (const fs::path& file : project_files())
    if (const std::string wrong = complaint(file); !wrong.empty()) complaints.push_back(file.string() + ": " + wrong);
  EXPECT_THAT(complaints, IsEmpty());
}

TEST(House, every_source_opens_with_its_licence) {
  int sources = 0;
  expect_no([&](const fs::path& file) {
    return is_source(file) && ++sources && !opens_with_licence(text_of(root / file)) ? "no licence" : "";
  });
  EXPECT_GT(sources, 40);
}

TEST(House, sources_are_one_subject_under_500_lines) {
  expect_no([](const fs::path& file) {
    const std::size_t lines = is_source(file) ? lines_of(text_of(root / file)).size() : 0;
    const bool ours = std::set<std::string>{"app", "ui", "kernels", "tests"}.contains(file.begin()->string());
    return ours && lines > 500 ? std::to_string(lines) + " lines" : "";
  });
}

// The tests' JSON stays on its lines.
TEST(House, lines_are_within_120_columns) {
  expect_no([](const fs::path& file) -> std::string {
    const bool has_json = *file.begin() == "tests" && (file.extension() == ".cpp" || file.extension() == ".h");
    if (!is_source(file) || has_json) return "";
    int number = 0;
    for (const std::string& line : lines_of(text_of(root / file))) {
      ++number;
      // Bytes that go on with a character of UTF-8 take no column.
      if (std::ranges::count_if(line, [](char c) { return (c & 0xc0) != 0x80; }) > 120)
        return fmt::format("line {}", number);
    }
    return "";
  });
}

// A long launch has rows (kernels/tracing/work_item.h).
TEST(House, kernels_number_their_items_by_work_item) {
  expect_no([](const fs::path& file) {
    const bool kernel = *file.begin() == "kernels" && file.filename() != "work_item.h";
    return kernel && text_of(root / file).find("get_global_id") != std::string::npos ? "get_global_id" : "";
  });
}

// Several are compiled as one, and a suite runs in one process: a fixture of the same name elsewhere would be
// another's.
TEST(House, tests_are_in_a_namespace_of_their_own_and_suites_in_one_file) {
  std::vector<std::string> wrong;
  std::map<std::pair<fs::path, std::string>, fs::path> file_of;
  for (const fs::path& file : project_files()) {
    if (!file.string().ends_with("_test.cpp")) continue;
    const std::string text = text_of(root / file),
                      own = "namespace nephroid(::[a-z]+)?::" + file.stem().string() + " \\{";
    if (!std::regex_search(text, std::regex(own)))
      wrong.push_back(file.string() + " has no namespace " + file.stem().string());
    for (const std::string& suite : names_in(text, R"(\nTEST(?:_[FP])?\((\w+),)"))
      if (!file_of.emplace(std::pair(file.parent_path(), suite), file).second)
        wrong.push_back(file.string() + " has a suite of another: " + suite);
  }
  EXPECT_THAT(wrong, IsEmpty());
}

TEST(House, no_file_over_a_megabyte) {
  expect_no([](const fs::path& file) { return fs::file_size(root / file) > 1'000'000 ? "too large" : ""; });
}

TEST(House, no_trace_of_one_machine) {
  expect_no([](const fs::path& file) -> std::string {
    const std::string text = text_of(root / file);
    const bool binary = text.find('\0') != std::string::npos, own_examples = file == "tests/unit/house_test.cpp";
    return binary || own_examples ? "" : machine_trace(text);
  });
}

TEST(House, third_party_readme_names_every_dependency) {
  const std::string readme = text_of(root / "third_party/README.md");
  std::string cmake;
  for (const fs::path& file : project_files()) {
    if (file.begin()->string() == "third_party" && file.extension() == ".cmake") cmake += text_of(root / file);
  }
  std::set<std::string> dependencies = names_in(cmake, R"(find_package\((\w[\w-]*))");
  dependencies.merge(names_in(cmake, R"(pkg_check_modules\((\w[\w-]*))"));
  ASSERT_THAT(dependencies, IsSupersetOf({"OpenCL", "OpenImageIO", "embree", "GTest"}));
  for (const std::string& name : dependencies) EXPECT_THAT(readme, HasSubstr("`" + name + "`"));
}

TEST(House, third_party_readme_names_every_debian_package) {
  const std::string readme = text_of(root / "third_party/README.md");
  const std::set<std::string> packages = debian_packages();
  ASSERT_THAT(packages, IsSupersetOf({"g++", "pocl-opencl-icd", "libgtest-dev"}));
  for (const std::string& name : packages) EXPECT_THAT(readme, HasSubstr("`" + name + "`"));
}

// Dependencies are found in third_party/, once: a find_package elsewhere would escape the table of licences.
TEST(House, dependencies_are_found_in_one_place) {
  expect_no([](const fs::path& file) {
    if (file.begin()->string() == "third_party" ||
        (file.extension() != ".cmake" && file.filename() != "CMakeLists.txt"))
      return "";
    const auto packages =
        names_in(text_of(root / file), R"(\b(find_package|pkg_check_modules|find_library|FetchContent_Declare)\()");
    return packages.empty() ? "" : "finds a dependency";
  });
}

// The checks themselves, on cases made up for them.
TEST(House, checks_see_what_they_are_for) {
  EXPECT_TRUE(opens_with_licence("// SPDX-License-Identifier: Apache-2.0\nint i;\n"));
  EXPECT_TRUE(opens_with_licence("#!/usr/bin/env bash\n# SPDX-License-Identifier: Apache-2.0\n"));
  EXPECT_FALSE(opens_with_licence("int i;\n// SPDX-License-Identifier: Apache-2.0\n"));
  EXPECT_FALSE(opens_with_licence(""));
  EXPECT_EQ(machine_trace("see /usr/share/glmark2/models and app/"
                          "work/x.h"),
            "");
  EXPECT_EQ(machine_trace("https://www.w3.org/TR/css-color-4/"), "");
  EXPECT_EQ(machine_trace("path = \"/home/ada/nephroid\""), "\"/home/ada/nephroid\"");
  EXPECT_NE(machine_trace("fetch http://deb."
                          "debian.org/x"),
            "");
}

} // namespace nephroid::house_test
