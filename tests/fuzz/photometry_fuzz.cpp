// SPDX-License-Identifier: Apache-2.0
// An IES or EULUMDAT file, asked for its intensity in directions of every kind.
#include "scene/photometry.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {

void read(std::string_view input) {
  const fs::path file = write("lamp.ies", input);
  accepts([&] {
    const scene::Photometry p = scene::load_photometry(file);
    if (p.intensity.size() != p.gamma_deg.size() * p.c_deg.size()) finding("directions without an intensity");
    for (const auto* angles : {&p.gamma_deg, &p.c_deg})
      if (std::ranges::adjacent_find(*angles, std::greater_equal()) != angles->end())
        finding("angles that do not rise");
    if (p.c_deg.front() > 0 || p.c_deg.back() < 360) finding("planes that do not go around");
    const double most = std::ranges::max(p.intensity);
    for (const double gamma : {0.0, 1e-9, 33.3, 90.0, 180.0, p.gamma_deg.front(), p.gamma_deg.back()})
      for (const double c : {0.0, 1e-9, 45.0, 180.0, 271.5, 360.0, std::clamp(p.c_deg[p.c_deg.size() / 2], 0.0, 360.0)})
        if (const double i = scene::intensity(p, gamma, c); !(i >= 0 && i <= most * (1 + 1e-12)))
          finding("an intensity that is none between the file's");
  });
}

std::vector<std::string> seeds() {
  std::vector<std::string> seeds;
  const std::string head = "IESNA:LM-63-1995\n[TEST] 1\nTILT=NONE\n1 1000 ", size = " 1 2 0 0 0\n1 1 10\n";
  for (const char* numbers :
       {"2 3 1|0 30 90\n0\n10 5 1", "1 2 3|0 180\n0 45 90\n1 1\n2 2\n4 4", "1 2 3|0 180\n0 90 180\n1 1\n2 2\n4 4",
        "1 2 3|0 180\n90 180 270\n1 1\n2 2\n4 4", "1 2 5|0 180\n0 90 180 270 360\n1 1\n2 2\n4 4\n8 8\n1 1"}) {
    const std::string text = numbers;
    const std::size_t at = text.find('|');
    seeds.push_back(head + text.substr(0, at) + size + text.substr(at + 1) + "\n");
  }
  seeds.push_back("IESNA91\nTILT=INCLUDE\n1\n2\n0 90\n1 1\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n2 1\n");
  for (int symmetry = 0; symmetry <= 4; ++symmetry) { // four planes of two angles, and one set of lamps
    std::string text = "a firm\n1\n" + std::to_string(symmetry) + "\n4\n90\n2\n";
    for (int line = 7; line <= 25; ++line) text += "0\n";
    text += "1\n";
    for (int line = 0; line < 6 + 10; ++line) text += "1\n";
    text += "0\n90\n180\n270\n0\n90\n";
    for (int i = 0; i < 8; ++i) text += std::to_string(i) + ",5\n";
    seeds.push_back(text);
  }
  return seeds;
}

} // namespace nephroid::fuzz
