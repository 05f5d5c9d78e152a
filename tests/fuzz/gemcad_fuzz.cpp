// SPDX-License-Identifier: Apache-2.0
// A stone of GemCad, imported. What comes out is a preset that can be read.
#include "formats/import/import.h"
#include "preset/read.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {

void read(std::string_view input) {
  const fs::path preset = folder() / "imported.json";
  formats::import_scene(write("stone.asc", input), preset);
  try {
    preset::read_preset(preset.string());
  } catch (const Error& refusal) {
    finding("an imported stone cannot be read: " + refusal.line());
  }
}

std::vector<std::string> seeds() {
  return {"GemCad 5.0\ng 96 0.0\ny 4 n\nI 1.54\nH A cube\na 90.0 1.0 96 n S 24 48 72\na 0.0 1.0 96 n T\n"
          "a -0.0 1.0 96 n C G Cut\nF end\n",
          "g-8 0.5\nI1.76\na -40 1 0 1 2 3\n4 5 6 n P1 7\na 35.5 1.1 0 1 2 3 4 5 6 7\na 0 .7\na 90 1.2 0.5 1.5 2.5\n"};
}

} // namespace nephroid::fuzz
