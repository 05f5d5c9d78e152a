// SPDX-License-Identifier: Apache-2.0
// A recorded session with the engine "inverse", in a real window: a preset is opened from the start page, a receiver is moved, the search
// comes to its end, and the object is saved as meshes and shown as glass. Skipped where there is no Xvfb, no xdotool or no ImageMagick.
#include "inverse_runs.h"
#include "recorded_session.h"
#include "scene/mesh.h"
#include "ui/inverse/annealing/panel.h"

namespace nephroid::ui::inverse_session_test {

class InverseSession : public test::RealWindow {
protected:
  InverseSession() : RealWindow({"Xvfb", "xdotool", "import", "montage"}) {}
};

const preset::Object& object(const preset::Preset& preset, const std::string& name)
{
  for (const preset::Object& one : preset.scene.objects)
    if (one.name == name) return one;
  throw std::runtime_error("no object " + name);
}

TEST_F(InverseSession, FromTheStartPageToASavedMesh)
{
  // The shipped shapes, of fewer facets.
  test::RecordedSession<test::InverseRuns> session("inverse", folder.path(), R"({"parent": "inverse/shapes", "name": "Small shapes",
    "description": "Few facets", "inverse": {"facets": [40, 40], "cells": [24, 24]}, "stop": {"passes": 6}})");
  const preset::Preset before = preset::read_preset(session.file().string());
  session.open_listed("small shapes few facets", "Small shapes");
  session.shot("Enter opens it: the search goes on");
  const auto& panel = session.panel<AnnealingPanel>();
  session.drag(panel.place_of("distance_3").value(), {24, 0});
  session.rest();
  session.shot("The third receiver is dragged away");
  session.until_finished();
  session.shot("The search is over");

  session.window().save();
  session.shot("Ctrl+S saves the preset");
  session.click(panel.place_of("show as glass").value());
  session.until_there("inverse-object/view.json");
  session.window().until("the glass is shown", [&] { return session.window().title().find("view") != std::string::npos; });
  session.until_passed(0.12);
  session.shot("Show as glass: the meshes are saved, and light falls through them");
  session.quit();

  const preset::Preset saved = preset::read_preset(session.file().string());
  const auto& first = inverse::settings(before).receivers;
  const auto& after = inverse::settings(saved).receivers;
  ASSERT_EQ(after.size(), 3u);
  EXPECT_EQ(after[0], first[0]);
  EXPECT_EQ(after[1], first[1]);
  EXPECT_GT(after[2].distance_mm, first[2].distance_mm + 5);

  const std::filesystem::path made = session.saved() / "inverse-object";
  for (const char* file : {"object.obj", "object.stl", "object.ply"}) {
    const scene::MeshReport report = scene::inspect(scene::load_mesh(made / file));
    EXPECT_TRUE(report.closed()) << file;
    EXPECT_GT(report.signed_volume, 0) << file;
  }
  const preset::Preset view = preset::read_preset((made / "view.json").string());
  EXPECT_EQ(view.scene.objects.size(), 7u) << "the ground, and for each distance a receiver with the object over it";
  EXPECT_NEAR(object(view, "receiver 3").transform.translate[2], -after[2].distance_mm, 1e-6);
}

} // namespace nephroid::ui::inverse_session_test
