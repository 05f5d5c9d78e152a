// SPDX-License-Identifier: Apache-2.0
// Dependencies point one way: every #include of app/, ui/ and kernels/ is held against the folder table of
// ARCHITECTURE.md, and every library's headers stay in the one folder that knows the library.

#include "tests/support/test.h"

#include <algorithm>
#include <regex>

namespace nephroid::includes_test {

using Folders = std::set<std::string>;
using FolderTable = std::map<std::string, Folders>;

/// The third cell of a table row as the folders it allows. `above` are the folders of the rows before.
/// Throws std::runtime_error on a name that is no row so far, so that a typing error in the table is seen.
Folders allowed_folders(const std::string& cell, const Folders& above) {
  if (cell == "nothing") return {};
  if (cell == "all of the above") return above;
  std::smatch match;
  Folders folders;
  if (std::regex_match(cell, match, std::regex("all but ([a-z]+)"))) {
    folders = above;
    if (folders.erase(match.str(1)) == 0) throw std::runtime_error("no such folder: " + match.str(1));
    return folders;
  }
  std::istringstream names(cell);
  for (std::string name; std::getline(names >> std::ws, name, ',');) {
    if (!above.contains(name)) throw std::runtime_error("no such folder above: " + name);
    folders.insert(name);
  }
  return folders;
}

/// Rows "| `app/NAME` | what | includes |" of a Markdown text; a folder may always include itself.
FolderTable read_table(std::istream& markdown) {
  const std::regex row(R"(\| `(?:app/)?([a-z]+)` \|.*\| ([^|]+) \|)");
  FolderTable table;
  Folders above;
  for (std::string line; std::getline(markdown, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    const std::string folder = match.str(1);
    table[folder] = allowed_folders(match.str(2), above);
    table[folder].insert(folder);
    above.insert(folder);
  }
  return table;
}

/// Which folders, with commas between, may include headers whose path starts with `prefix`.
struct LibraryRule {
  std::string prefix;
  std::string folders;
};

const std::vector<LibraryRule> library_rules{{"CL/", "compute"},      {"OpenImageIO/", "image"},
                                             {"lcms2.h", "image"},    {"assimp/", "scene"},
                                             {"embree", "scene"},     {"CLI/", "cli"},
                                             {"yaml-cpp/", "optics"}, {"GLFW/", "ui"},
                                             {"GL/", "ui"},           {"imgui", "ui"},
                                             {"implot", "ui"},        {"imcmd_", "ui"},
                                             {"FLIP.h", "measure"},   {"Eigen/", "optics, measure, inverse"},
                                             {"qrencode", "inverse"}, {"ImGuizmo", "ui"},
                                             {"date/", "base"},       {"STEPControl", "inverse"}};

/// What is wrong with one include of a file of `folder`; empty where nothing is.
std::string break_of(const std::string& folder, const std::string& included, const FolderTable& table) {
  for (const LibraryRule& rule : library_rules) {
    if (included.starts_with(rule.prefix) && (", " + rule.folders + ",").find(" " + folder + ",") == std::string::npos)
      return "only " + rule.folders + " may know this library";
  }
  if (included.find("../") != std::string::npos) return "include from the root of app/, not by a relative path";
  const std::string into = included.substr(0, included.find('/'));
  if (into == included || !table.contains(into)) return "";
  if (into == "kernels" && included.ends_with("_types.h") && folder != "base")
    return ""; // structs shared with the device
  if (!table.at(folder).contains(into)) return folder + " may not include " + into;
  return "";
}

/// The same between the folders of ui/: what panels share knows no panel, and panels not each other. An engine's list
/// of panels
/// ("spectral") knows those below ("spectral/dispersion").
std::string break_in_ui(const std::string& folder, const std::string& included) {
  if (!included.starts_with("ui/")) return "";
  const std::string into = fs::path(included).parent_path().string().substr(3);
  if (into == folder || into.starts_with(folder + "/") || folder == "shell" || folder == "actions" || into == "state")
    return "";
  if (into == "widgets" && folder != "state") return "";
  return "ui/" + folder + " may not include ui/" + into;
}

/// The same between the folders of kernels/: each of the first knows those before it, and all others know these.
std::string break_in_kernels(const std::string& folder, const std::string& included) {
  if (!included.starts_with("kernels/") || included.ends_with("_types.h")) return "";
  const std::string into = fs::path(included).parent_path().filename().string();
  const std::vector<std::string> shared{"tracing", "scatter", "lights", "transport"};
  if (into == folder || std::ranges::find(shared, into) < std::ranges::find(shared, folder)) return "";
  return "kernels/" + folder + " may not include kernels/" + into;
}

/// The engines by their folders: app/engines.cpp includes them.
Folders engine_folders() {
  std::ifstream list(fs::path(NEPHROID_SOURCE_DIR) / "app/engines.cpp");
  const std::regex include(R"re(#include "([a-z]+)/engine.h")re");
  Folders engines;
  std::smatch match;
  for (std::string line; std::getline(list, line);)
    if (std::regex_match(line, match, include)) engines.insert(match.str(1));
  return engines;
}

/// The engine in whose folder a file is (app/spectral, app/cli/spectral, ui/spectral/spectra, kernels/environment);
/// empty: in none.
std::string engine_of(const fs::path& file, const Folders& engines) {
  for (const fs::path& part : file.parent_path())
    if (engines.contains(part.string())) return part.string();
  return "";
}

/// Nobody includes what is an engine's own but the engine itself.
std::string break_of_engines(const fs::path& file, const std::string& included, const Folders& engines) {
  const std::string of = engine_of(included, engines);
  return of.empty() || of == engine_of(file, engines) ? "" : "this is of the engine " + of + " alone";
}

/// The folder of the table that a file belongs to; empty for app/main.cpp, which may include all.
std::string folder_of(const fs::path& relative) {
  auto part = relative.begin();
  if (*part == "app") ++part;
  return std::next(part) == relative.end() ? "" : part->string();
}

std::vector<std::string> breaks_of_file(const fs::path& file, const fs::path& relative, const FolderTable& table,
                                        const Folders& engines) {
  const std::regex include(R"re(\s*#\s*include\s*["<]([^">]+)[">].*)re");
  const std::string folder = folder_of(relative);
  std::vector<std::string> breaks;
  if (folder.empty()) return breaks;
  if (!table.contains(folder)) return {relative.string() + ": ARCHITECTURE.md's table has no row for " + folder};
  std::ifstream in(file);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::smatch match;
    if (!std::regex_match(line, match, include)) continue;
    std::string wrong = break_of(folder, match.str(1), table);
    if (folder == "ui" && wrong.empty()) wrong = break_in_ui(relative.parent_path().string().substr(3), match.str(1));
    if (folder == "kernels" && wrong.empty())
      wrong = break_in_kernels(relative.parent_path().filename().string(), match.str(1));
    if (wrong.empty()) wrong = break_of_engines(relative, match.str(1), engines);
    if (!wrong.empty())
      breaks.push_back(relative.string() + ":" + std::to_string(number) + ": " + match.str(1) + ": " + wrong);
  }
  return breaks;
}

FolderTable project_table() {
  std::ifstream markdown(fs::path(NEPHROID_SOURCE_DIR) / "ARCHITECTURE.md");
  return read_table(markdown);
}

TEST(Includes, point_one_way) {
  const fs::path root = NEPHROID_SOURCE_DIR;
  const FolderTable table = project_table();
  const Folders engines = engine_folders();
  ASSERT_FALSE(engines.empty());
  ASSERT_THAT(table.at("base"), ElementsAre("base")) << "ARCHITECTURE.md's table could not be read";
  const std::set<std::string> endings{".cpp", ".h", ".cl"};
  std::vector<std::string> breaks;
  int files = 0;
  for (const char* top : {"app", "ui", "kernels"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      if (!endings.contains(entry.path().extension().string())) continue;
      ++files;
      const auto of_file = breaks_of_file(entry.path(), fs::relative(entry.path(), root), table, engines);
      breaks.insert(breaks.end(), of_file.begin(), of_file.end());
    }
  }
  EXPECT_GT(files, 20);
  EXPECT_THAT(breaks, IsEmpty());
}

// An engine is known by its line in app/engines.cpp, and by the declaration and the call of its panels.
TEST(Includes, engines_are_named_where_they_are_listed) {
  const std::string script = (fs::path(NEPHROID_SOURCE_DIR) / "tests/unit/engine_names.sh").string();
  std::FILE* lines = popen(("'" + script + "'").c_str(), "r");
  ASSERT_TRUE(lines);
  std::string places;
  for (int c = std::fgetc(lines); c != EOF; c = std::fgetc(lines)) places += static_cast<char>(c);
  EXPECT_EQ(pclose(lines), 0);
  EXPECT_LE(std::count(places.begin(), places.end(), '\n'), 16) << places;
  EXPECT_THAT(places, HasSubstr("app/engines.cpp")) << "the script sees nothing";
}

TEST(Includes, every_row_of_the_table_is_a_folder) {
  for (const auto& [folder, allowed] : project_table()) {
    EXPECT_TRUE(fs::is_directory(fs::path(NEPHROID_SOURCE_DIR) / "app" / folder) ||
                fs::is_directory(fs::path(NEPHROID_SOURCE_DIR) / folder))
        << folder;
  }
}

// The engines must not know each other, and what knows no OpenCL must stay so, whatever the table is changed to.
TEST(Includes, the_table_keeps_the_promises_of_the_design) {
  const FolderTable table = project_table();
  for (const char* folder : {"base", "optics", "preset", "scatter", "scene", "plan", "job", "image"}) {
    EXPECT_FALSE(table.at(folder).contains("compute")) << folder;
  }
  for (const auto& [folder, allowed] : table) {
    for (const std::string& other : allowed) {
      EXPECT_TRUE(other == folder || !table.at(other).contains(folder))
          << folder << " and " << other << " include each other";
    }
    EXPECT_TRUE(folder == "ui" || !allowed.contains("ui")) << folder;
  }
}

/// What a source or header includes.
struct Source {
  std::string text;
  std::set<std::string> standard; ///< "algorithm"
  std::vector<std::string> ours;  ///< "base/error.h"
};

Source read_source(const fs::path& file) {
  static const std::regex include(R"re(\s*#\s*include\s*["<]([^">]+)[">].*)re");
  Source source;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    source.text += line.substr(0, line.find("//")) + '\n';
    std::smatch match;
    if (line.find("include") == std::string::npos || !std::regex_match(line, match, include)) continue;
    if (line.find('"') == std::string::npos)
      source.standard.insert(match.str(1));
    else
      source.ours.push_back(match.str(1));
  }
  return source;
}

// Then every header is compiled once with nothing before it.
TEST(Includes, a_file_begins_with_its_own_header) {
  const fs::path root = NEPHROID_SOURCE_DIR;
  int files = 0;
  for (const auto& [top, seen_from] : std::map<std::string, std::string>{{"app", "app"}, {"ui", ""}, {"python", ""}})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      const fs::path header = fs::path(entry.path()).replace_extension(".h");
      if (entry.path().extension() != ".cpp" || !fs::exists(header)) continue;
      ++files;
      const std::vector<std::string> ours = read_source(entry.path()).ours;
      EXPECT_EQ(ours.empty() ? "" : ours.front(), fs::relative(header, root / seen_from)) << entry.path();
    }
  EXPECT_GT(files, 100);
}

/// The standard headers that a file includes itself or by the project's own, which are named from the root, from app/
/// or from beside it.
std::set<std::string> standard_headers(const std::map<std::string, Source>& sources, const fs::path& file,
                                       std::set<fs::path>& seen) {
  const auto source = sources.find(file.string());
  if (source == sources.end() || !seen.insert(file).second) return {};
  std::set<std::string> headers = source->second.standard;
  for (const std::string& included : source->second.ours)
    for (const fs::path& candidate : {fs::path(included), "app" / fs::path(included), file.parent_path() / included})
      headers.merge(standard_headers(sources, candidate, seen));
  return headers;
}

/// Of a file of the program: what it includes itself or by the first of its includes, which is the header that it is
/// of. Functions are in nobody's interface, so a header that others include may lose theirs.
std::set<std::string> own_standard_headers(const std::map<std::string, Source>& sources, const fs::path& file) {
  const Source& source = sources.at(file.string());
  std::set<std::string> headers = source.standard;
  if (file.extension() != ".cpp" || source.ours.empty()) return headers;
  const fs::path first = source.ours.front();
  for (const fs::path& candidate : {first, "app" / first, file.parent_path() / first})
    if (const auto own = sources.find(candidate.string()); own != sources.end())
      headers.insert(own->second.standard.begin(), own->second.standard.end());
  return headers;
}

const std::set<std::string> headers_of_functions{"algorithm", "cmath",   "cstdlib", "cstring",
                                                 "limits",    "numeric", "sstream"};

/// Words that only one standard header promises.
const std::map<std::string, std::vector<std::string>> standard_words{
    {"algorithm",
     {"all_of(",      "any_of(",      "binary_search(", "clamp(",       "copy(",        "copy_if(",   "copy_n(",
      "count(",       "count_if(",    "equal(",         "fill(",        "fill_n(",      "find(",      "find_if(",
      "for_each(",    "generate(",    "is_sorted(",     "max(",         "max_element(", "min(",       "min_element(",
      "minmax(",      "mismatch(",    "none_of(",       "nth_element(", "remove(",      "remove_if(", "replace(",
      "reverse(",     "rotate(",      "search(",        "shuffle(",     "sort(",        "transform(", "unique(",
      "stable_sort(", "upper_bound(", "lower_bound("}},
    {"array", {"array<"}},
    {"chrono", {"chrono::"}},
    {"cmath",
     {"abs(", "exp(", "floor(", "hypot(", "isfinite(", "isnan(", "log(", "nextafter(", "pow(", "round(", "sqrt("}},
    {"cstdint", {"int32_t", "int64_t", "uint16_t", "uint32_t", "uint64_t", "uint8_t", "uintmax_t"}},
    {"cstdlib", {"getenv(", "strtod(", "strtoul(", "strtoull(", "system("}},
    {"cstring", {"memcmp(", "memcpy(", "strcmp(", "strerror(", "strlen("}},
    {"functional", {"function<"}},
    {"limits", {"numeric_limits<"}},
    {"numeric", {"accumulate(", "gcd(", "inner_product(", "iota(", "lcm(", "midpoint("}},
    {"sstream", {"istringstream", "ostringstream", "stringstream"}},
    {"thread", {"this_thread", "jthread", "thread("}},
};

TEST(Includes, files_include_what_they_use_of_the_standard_library) {
  const fs::path root = NEPHROID_SOURCE_DIR;
  std::map<std::string, Source> sources;
  for (const char* top : {"app", "ui", "python", "kernels", "tests"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h")
        sources[fs::relative(entry.path(), root).string()] = read_source(entry.path());
  EXPECT_GT(sources.size(), 500u);
  std::vector<std::string> missing;
  for (const auto& [file, source] : sources) {
    std::set<fs::path> seen;
    const std::set<std::string> all = standard_headers(sources, file, seen),
                                own = file.starts_with("tests/") ? all : own_standard_headers(sources, file);
    for (const auto& [header, words] : standard_words)
      if (!(headers_of_functions.contains(header) ? own : all).contains(header))
        for (const std::string& word : words)
          if (source.text.find("std::" + word) != std::string::npos)
            missing.push_back(file + ": std::" + word + " lacks <" + header + ">");
  }
  EXPECT_THAT(missing, IsEmpty());
}

// The check itself, on breaks made up for it.
TEST(Includes, breaks_are_seen) {
  std::istringstream markdown(
      "| folder | what | includes |\n|---|---|---|\n"
      "| `app/base` | x | nothing |\n| `app/optics` | x | base |\n| `app/compute` | x | base |\n"
      "| `app/cli` | x | all of the above |\n| `ui` | x | all but cli |\n| `kernels` | x | nothing |\n");
  const FolderTable table = read_table(markdown);
  EXPECT_EQ(break_of("optics", "base/error.h", table), "");
  EXPECT_EQ(break_of("optics", "optics/wavelength.h", table), "");
  EXPECT_EQ(break_of("ui", "compute/compute.h", table), "");
  EXPECT_EQ(break_of("compute", "kernels/tracing/shared_types.h", table), "");
  EXPECT_EQ(break_of("compute", "CL/opencl.hpp", table), "");
  EXPECT_EQ(break_of("base", "vector", table), "");
  EXPECT_EQ(break_of("ui", "cli/verb.h", table), "ui may not include cli");
  EXPECT_EQ(break_of("base", "optics/wavelength.h", table), "base may not include optics");
  EXPECT_EQ(break_of("optics", "compute/compute.h", table), "optics may not include compute");
  EXPECT_EQ(break_of("compute", "kernels/photons/photon_map_types.h", table), "");
  EXPECT_EQ(break_of("compute", "kernels/tracing/random.h", table), "compute may not include kernels");
  EXPECT_EQ(break_of("optics", "CL/cl.h", table), "only compute may know this library");
  EXPECT_EQ(break_of("cli", "OpenImageIO/imageio.h", table), "only image may know this library");
  EXPECT_NE(break_of("optics", "../base/error.h", table), "");
  EXPECT_EQ(break_in_ui("view", "ui/widgets/panel.h"), "");
  EXPECT_EQ(break_in_ui("shell", "ui/view/panel.h"), "");
  EXPECT_EQ(break_in_ui("state", "ui/view/panel.h"), "ui/state may not include ui/view");
  EXPECT_EQ(break_in_ui("state", "ui/widgets/theme.h"), "ui/state may not include ui/widgets");
  EXPECT_EQ(break_in_ui("widgets", "ui/shell/menus.h"), "ui/widgets may not include ui/shell");
  EXPECT_EQ(break_in_ui("spectral/dispersion", "ui/spectral/spectra/curves.h"),
            "ui/spectral/dispersion may not include ui/spectral/spectra");
  EXPECT_EQ(break_in_ui("spectral", "ui/spectral/spectra/panel.h"), "");
  EXPECT_EQ(break_in_ui("view", "ui/spectral/spectra/panel.h"), "ui/view may not include ui/spectral/spectra");
  EXPECT_EQ(break_in_kernels("lights", "kernels/scatter/scatter.h"), "");
  EXPECT_EQ(break_in_kernels("tracing", "kernels/lights/light_types.h"), "");
  EXPECT_EQ(break_in_kernels("photons", "kernels/transport/walk.h"), "");
  EXPECT_EQ(break_in_kernels("tracing", "kernels/lights/sky.h"), "kernels/tracing may not include kernels/lights");
  EXPECT_EQ(break_in_kernels("environment", "kernels/photons/layers.h"),
            "kernels/environment may not include kernels/photons");
  const Folders engines{"spectral", "inverse"};
  EXPECT_EQ(break_of_engines("app/cli/spectral/clusters.cpp", "spectral/clusters/clusters.h", engines), "");
  EXPECT_EQ(break_of_engines("ui/spectral/spectra/panel.cpp", "scene/scene.h", engines), "");
  EXPECT_NE(break_of_engines("ui/state/workbench.cpp", "inverse/settings.h", engines), "");
  EXPECT_NE(break_of_engines("ui/spectral/spectra/panel.cpp", "inverse/settings.h", engines), "");
  EXPECT_THROW(allowed_folders("base, optcis", {"base", "optics"}), std::runtime_error);
}

} // namespace nephroid::includes_test
