// SPDX-License-Identifier: Apache-2.0
#include "ui/state/file_kind.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace nephroid::ui {
namespace {

struct Kind {
  std::string_view endings; ///< lower case, each followed by a space
  const char* what;
  const char* remedy; ///< FILE stands for the file's name
};

constexpr std::array kinds{
    Kind{".yml .yaml ", "is dispersion data",
         "drop it on the window once a preset with glass is open, or print it with `nephroid dispersion FILE`"},
    Kind{".obj .ply .stl .gltf .glb .3ds ", "is a mesh", "name it in a preset as an object's \"mesh\""},
    Kind{".exr .hdr .pfm .png .jpg .jpeg .tif .tiff ", "is a picture",
         "a run's pictures lie beside its preset.json: open that; pictures as environments are not rendered yet"},
    Kind{".cl ", "is a kernel source", "start with --kernels and its folder"},
};

std::string lower_ending(const std::filesystem::path& file)
{
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::string with_name(std::string text, const std::string& name)
{
  if (const std::size_t at = text.find("FILE"); at != std::string::npos) text.replace(at, 4, name);
  return text;
}

/// Whether the first character that is no white space opens a JSON object. An empty file may become one: reading it says so.
bool may_be_object(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  char first = '{';
  in >> first;
  return first == '{';
}

} // namespace

void refuse_other_kinds(const std::string& name)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(name, ignored)) return;
  constexpr const char* expected = "the window opens presets";
  const std::string ending = lower_ending(name);
  for (const Kind& kind : kinds)
    if (!ending.empty() && kind.endings.find(ending + ' ') != std::string_view::npos)
      throw bad_input(name, kind.what, expected, with_name(kind.remedy, name));
  if (ending != ".json" && !may_be_object(name))
    throw bad_input(name, "is no preset and of no kind that Nephroid knows", std::string(expected) + ", JSON files",
                    "see `nephroid presets` for those that are shipped");
}

} // namespace nephroid::ui
