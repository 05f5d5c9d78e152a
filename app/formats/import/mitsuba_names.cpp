// SPDX-License-Identifier: Apache-2.0
#include "formats/import/mitsuba_names.h"

namespace nephroid::formats {

const std::map<std::string, double>& mitsuba_iors() {
  static const std::map<std::string, double> iors{{"vacuum", 1},
                                                  {"air", 1.000277},
                                                  {"water", 1.3330},
                                                  {"water ice", 1.31},
                                                  {"fused quartz", 1.458},
                                                  {"pyrex", 1.470},
                                                  {"acrylic glass", 1.49},
                                                  {"polypropylene", 1.49},
                                                  {"bk7", 1.5046},
                                                  {"sodium chloride", 1.544},
                                                  {"amber", 1.55},
                                                  {"pet", 1.5750},
                                                  {"diamond", 2.419},
                                                  {"acetone", 1.36},
                                                  {"ethanol", 1.361},
                                                  {"benzene", 1.501},
                                                  {"silicone oil", 1.52045},
                                                  {"glycerol", 1.4729},
                                                  {"hydrogen", 1.000132},
                                                  {"helium", 1.000036},
                                                  {"carbon dioxide", 1.00045},
                                                  {"bromine", 1.661},
                                                  {"carbon tetrachloride", 1.461}};
  return iors;
}

std::string mitsuba_name(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool upper = name[i] >= 'A' && name[i] <= 'Z';
    if (upper && i > 0 && name[i - 1] >= 'a' && name[i - 1] <= 'z') text += '_';
    text += upper ? static_cast<char>(name[i] - 'A' + 'a') : name[i];
  }
  return text;
}

} // namespace nephroid::formats
