// SPDX-License-Identifier: Apache-2.0
// Each type of the list MATERIALS: what its file says of it agrees with its lobes and with docs/materials.md.
#include "base/files.h"
#include "preset/choices.h"
#include "scatter/material.h"
#include "tests/support/test.h"

namespace nephroid::materials_test {

using Type = preset::Material::Type;

scatter::Material made(Type type) {
  preset::Material of;
  of.type = type;
  std::vector<std::string> warnings;
  scatter::Material material = scatter::make_material("m", of, FileFinder(), "test", warnings);
  EXPECT_THAT(warnings, IsEmpty());
  return material;
}

TEST(Materials, AllHaveASentenceAndARowInTheDocs) {
  const std::string page = read_file(fs::path(NEPHROID_SOURCE_DIR) / "docs/materials.md");
  for (const auto& [type, word, sentence] : preset::choices<Type>) {
    EXPECT_THAT(sentence, testing::EndsWith(".")) << word;
    EXPECT_THAT(page, HasSubstr(fmt::format("\n| `{}` | ", word)));
  }
}

TEST(Materials, FlagsAndRowsFollowFromLobes) {
  std::vector<scatter::Material> all;
  for (const auto& choice : preset::choices<Type>) all.push_back(made(choice.value));
  const scatter::DeviceMaterials tables = scatter::device_materials(all, std::vector(all.size(), true));
  ASSERT_EQ(tables.materials.size(), std::size_t{MATERIAL_TYPE_COUNT});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const scatter::Material& m = all[i];
    const shared::DeviceMaterial& row = tables.materials[i];
    const unsigned lobes = preset::lobes(m.type);
    EXPECT_EQ(row.type, static_cast<int>(i)) << "the numbers of kernels are the words' places";
    EXPECT_EQ(is_body(m), (lobes & LOBE_TRANSMISSION) != 0 && (lobes & IS_PANE) == 0) << "else a field makes a pane";
    EXPECT_EQ(has_coat(m), (lobes & LOBE_DIFFUSE) != 0 && (lobes & LOBE_REFLECTION) != 0);
    EXPECT_FALSE(is_rough(m) || has_pictures(m) || is_coated(m)) << "as no field asks for it";
    EXPECT_EQ(is_tinted(m), is_tabulated(m)) << "panes are of glass that absorbs, unless a field says otherwise";
    EXPECT_EQ(gltf_surface(m).transmits, (lobes & LOBE_TRANSMISSION) != 0);
    EXPECT_EQ(gltf_surface(m).metallic, lobes == LOBE_REFLECTION ? 1 : 0);
  }
  for (const std::vector<float>* rows : {&tables.coefficient, &tables.reflectance})
    EXPECT_EQ(rows->size() % optics::wavelength_count, 0u);
}

// A material that no object has gets no rows, and textures are numbered without gaps.
TEST(Materials, OnlyUsedOnesHaveRows) {
  scatter::Material textured = made(Type::diffuse);
  textured.texture = textured.normal_map = std::make_shared<const scatter::Texture>();
  const scatter::DeviceMaterials tables =
      scatter::device_materials({textured, made(Type::conductor), textured}, {true, false, true});
  EXPECT_THAT(tables.coefficient, IsEmpty());
  EXPECT_EQ(tables.materials[0].normal_map, 1);
  EXPECT_EQ(tables.materials[2].texture, 2);
  EXPECT_EQ(tables.reflectance.size(), std::size_t{2 * 4 * optics::wavelength_count}) << "a colour and three primaries";
}

} // namespace nephroid::materials_test
