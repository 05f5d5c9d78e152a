// SPDX-License-Identifier: Apache-2.0
// Files that people have and that are read nowhere here: what a refusal calls them.
#pragma once
#include "base/lower_case.h"

#include <filesystem>
#include <string_view>

namespace nephroid {

struct ForeignKind {
  std::string_view endings; ///< of names, in lower case, each with a blank behind it
  std::string_view mark;    ///< what such a file begins with, whatever its name
  std::string_view what;
  std::string_view remedy;
};

inline constexpr ForeignKind foreign_kinds[] = {
    {".gem .gcs ", "GemCad", "a cutting list of GemCad",
     "run `nephroid import` on its .asc, or export the stone as STL or OBJ, which an object of a preset takes as its "
     "\"mesh\""},
    {".step .stp .iges .igs .3dm .f3d .dwg .dxf .skp .fcstd ", "ISO-10303-21", "a CAD model",
     "export it as glTF, or its surfaces as STL"},
    {".blend .fbx .dae .usd .usda .usdc .usdz .max .c4d .ma .mb .abc ", "BLENDER", "a scene of another kind",
     "export it as glTF"},
    {".zip .7z .tar .gz ", "PK\3\4", "an archive", "unpack it first"}};

/// bytes: of the file, or its beginning. Null: none of these.
inline const ForeignKind* foreign_kind(const std::filesystem::path& file, std::string_view bytes) {
  const std::string ending = lower_case(file.extension().string()) + " ";
  for (const ForeignKind& kind : foreign_kinds)
    if ((bytes.starts_with(kind.mark) && ending != ".3mf ") ||
        (ending.size() > 2 && kind.endings.find(ending) != std::string_view::npos))
      return &kind;
  return nullptr;
}

} // namespace nephroid
