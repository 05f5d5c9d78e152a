// SPDX-License-Identifier: Apache-2.0
// A test that imports scenes of text and looks at the presets that they become.
#pragma once
#include "formats/import/import.h"
#include "preset/read.h"
#include "tests/support/test.h"

namespace nephroid::test {

class ImportsScenes : public testing::Test {
protected:
  /// Keeps what was imported, and its files, until the next call.
  preset::Preset imported(const std::string& text, const std::string& name) {
    made = formats::import_scene(folder.write(name, text), folder.path() / "out.json");
    return preset::read_preset(made.preset.string());
  }
  preset::Preset mitsuba(const std::string& scene) {
    return imported("<scene version=\"3.0.0\">" + scene + "</scene>", "in.xml");
  }
  static const preset::Material& material_of(const preset::Preset& p, std::size_t object) {
    return p.scene.materials.at(p.scene.objects.at(object).material);
  }
  /// The indices of the objects, whose dispersion is one number.
  static std::vector<double> indices(const preset::Preset& p) {
    std::vector<double> n;
    for (std::size_t i = 0; i < p.scene.objects.size(); ++i) n.push_back(material_of(p, i).dispersion.n);
    return n;
  }
  TemporaryFolder folder;
  formats::Imported made;
};

} // namespace nephroid::test
