// SPDX-License-Identifier: Apache-2.0
// The menu "Add": new things in the scene, each one edit, and selected.
#include "ui/actions/table.h"
#include "ui/state/additions.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

Action add_action(const char* what, const char* help, Thing thing) {
  const std::string name = std::string("Add ") + what;
  return {name,
          0,
          help,
          has_things,
          [name, thing](C c) {
            Addition added = with_thing(*c.preset(), thing);
            c.push(command::Edit{name, std::move(added.preset)});
            c.push(command::Select{added.selection});
          },
          why_no_things};
}

/// The old camera becomes a bookmark.
void add_camera(C c) {
  const preset::Camera camera = camera_on_all(*c.preset());
  std::vector<Bookmark> bookmarks = c.view_state.bookmarks;
  bookmarks.push_back({new_bookmark_name(*c.preset(), bookmarks), c.preset()->scene.camera});
  c.note("the old camera is the bookmark \"" + bookmarks.back().name + "\"");
  c.push(command::SetBookmarks{std::move(bookmarks)});
  c.edit("Add camera", [&](preset::Preset& p) { p.scene.camera = camera; });
  c.push(command::Select{{Selection::Kind::camera, 0}});
}

/// The selected object, else the first matt one, else the first.
std::optional<std::size_t> object_to_measure(C c) {
  const preset::Scene& scene = c.preset()->scene;
  if (c.selection().kind == Selection::Kind::object) return c.selection().index;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (const auto of = scene.materials.find(scene.objects[i].material);
        of != scene.materials.end() && of->second.type == preset::Material::Type::diffuse)
      return i;
  return scene.objects.empty() ? std::nullopt : std::optional<std::size_t>(0);
}

void add_meter(C c) {
  preset::Meter meter;
  for (int number = 1; meter.name.empty(); ++number) {
    const std::string name = fmt::format("meter {}", number);
    if (std::ranges::count(c.preset()->scene.meters, name, &preset::Meter::name) == 0) meter.name = name;
  }
  const auto object = object_to_measure(c);
  c.edit("Add meter", [&](preset::Preset& p) {
    if (object) {
      std::vector<preset::Object>& objects = p.scene.objects;
      std::string& name = objects[*object].name;
      const auto count = [&] { return std::ranges::count(objects, name, &preset::Object::name); };
      for (std::size_t number = *object + 1; name.empty() || count() > 1; ++number) // a meter goes by the name
        name = fmt::format("object {}", number);
      meter.type = preset::Meter::Type::surface;
      meter.object = name;
    } else
      meter.position = p.scene.camera.target;
    p.scene.meters.push_back(meter);
  });
  c.push(command::ShowPanel{"meters"});
}

} // namespace

std::vector<Action> add_actions() {
  return {
      add_action("sphere", "A matt ball on the ground, in sight", Thing::sphere),
      add_action("glass", "A glass ball on the ground, in sight", Thing::glass),
      add_action("table", "A floor; where there is one, a slab", Thing::table),
      {"Add mesh...", 0, "An object from a file", has_things, ask<Question::add_mesh>, why_no_things},
      add_action("lamp", "A point light above the target", Thing::lamp),
      add_action("sun", "Parallel light from a small disc", Thing::sun),
      add_action("sky", "Clear sky and sun, today at noon in Crete", Thing::sky),
      {"Add meter", 0, "On the selected object, else the first matt", has_things, add_meter, why_no_things},
      {"Add camera", 0, "One that sees all objects; the old one is bookmarked", has_things, add_camera, why_no_things},
  };
}

} // namespace nephroid::ui
