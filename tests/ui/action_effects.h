// SPDX-License-Identifier: Apache-2.0
// What each action of the table shall do, by its name: what has to be there before, and what is so afterwards and was
// not before.
#pragma once
#include "action_desk.h"

#include <imgui_internal.h>

namespace nephroid::test {

struct Effect {
  std::function<void(Desk&)> prepare; ///< null: nothing
  std::function<bool(Desk&)> happened;
};
using Effects = std::map<std::string, Effect>;

namespace effects {

using namespace nephroid::ui;

inline constexpr Selection lamp{Selection::Kind::light, 0};
inline auto applies(Command command) {
  return [command](Desk& d) { d.apply(command); };
}
inline const auto select_lamp = applies(command::Select{lamp}), pin = applies(command::PinRun{}),
                  inspect_pixel = applies(command::InspectPixel{std::array{20, 20}}),
                  give_sweep = applies(command::SetSweep{"sweep", {{"seed", {"1", "2"}}}});

inline auto asks(Question question) {
  return [question](Desk& d) { return d.workbench.questions().question() == question; };
}
/// A new scene of an engine, in no file.
inline auto begins(const char* engine) {
  return [engine](Desk& d) {
    return d.preset().source.empty() && d.preset().settings.engine() == std::string_view(engine);
  };
}
inline auto copies(const char* text) {
  return [text](Desk& d) { return d.clipboard().find(text) != std::string::npos; };
}

inline void add_file_and_edit(Effects& all) {
  all["New scene"] = {{}, begins("spectral")};
  all["New scene: environment"] = {{}, begins("environment")};
  all["New scene: inverse"] = {{}, begins("inverse")};
  all["New scene: empty"] = {{}, [](Desk& d) { return d.preset().source.empty() && d.scene().objects.empty(); }};
  all["Open..."] = {{}, asks(Question::open)};
  all["Open history..."] = {{}, asks(Question::open_history)};
  all["Open pictures..."] = {{}, asks(Question::open_pictures)};
  all["Open map..."] = {{}, asks(Question::open_map)};
  all["Reopen the last session"] = {[](Desk& d) { d.workbench.offer_earlier(true); },
                                    [](Desk& d) { return d.workbench.questions().take_reopen(); }};
  all["Save preset"] = {[](Desk& d) { d.edit(2.5); },
                        [](Desk& d) {
                          return preset::read_preset(d.file()).scene.camera.position[2] == 2.5 &&
                                 !d.workbench.edits()->modified();
                        }};
  all["Take the preset from its file"] = {[](Desk& d) {
                                            d.edit();
                                            preset::Preset other = d.preset();
                                            other.white = 7;
                                            d.folder.write("test.json", preset::to_json(other));
                                          },
                                          [](Desk& d) { return d.preset().white == 7; }};
  all["Save preset as..."] = {{}, asks(Question::save_preset)};
  all["Save picture as..."] = {{}, asks(Question::save_picture)};
  all["Quit"] = {{}, [](Desk& d) { return d.workbench.questions().quitting(); }};

  all["Undo"] = {[](Desk& d) { d.edit(); }, [](Desk& d) { return d.scene().camera.position[2] == 4; }};
  all["Redo"] = {[](Desk& d) { d.edit(), d.apply(command::Undo{}); },
                 [](Desk& d) { return d.scene().camera.position[2] == 3; }};
  all["Reset camera"] = {[](Desk& d) { d.edit(); },
                         [](Desk& d) {
                           return d.scene().camera.position[2] == 4 &&
                                  d.workbench.edits()->undo_label() == "reset the camera";
                         }};
  all["Copy as command line"] = {[](Desk& d) { d.edit(); }, copies("nephroid run ")};
  all["Copy history as CSV"] = {{}, copies("estimated_lab_mean")};
  all["Copy plot as CSV"] = {{}, copies("run,line,seconds,error")};
  all["Copy camera as JSON"] = {{}, copies("\"position\"")};
  all["Copy camera as --set"] = {{}, copies("--set ")};
  all["Copy plan as JSON"] = {{}, copies("n is extrapolated")};
}

inline void add_additions(Effects& all) {
  const auto selects = [](Selection::Kind kind) {
    return [kind](Desk& d) {
      const Selection now = d.view_state().selection;
      return now.kind == kind && d.workbench.edits()->undo_label().starts_with("Add ") &&
             (kind != Selection::Kind::object || now.index == d.before.preset.scene.objects.size());
    };
  };
  for (const char* body : {"Add sphere", "Add glass", "Add table"}) all[body] = {{}, selects(Selection::Kind::object)};
  for (const char* light : {"Add lamp", "Add sun"}) all[light] = {{}, selects(Selection::Kind::light)};
  all["Add mesh..."] = {{}, asks(Question::add_mesh)};
  all["Add sky"] = {{}, selects(Selection::Kind::environment)};
  all["Add meter"] = {{}, [](Desk& d) { return d.scene().meters.size() == 1; }};
  all["Add camera"] = {{}, selects(Selection::Kind::camera)};
}

/// Nudges the lamp: by how much along an axis, in sign.
inline Effect nudges(std::size_t axis, int sign) {
  return {select_lamp, [axis, sign](Desk& d) {
            const double moved = d.scene().lights[0].position[axis] - d.before.preset.scene.lights[0].position[axis];
            return sign * moved > 1e-6;
          }};
}
inline Effect uses(Handles::Tool tool) {
  return {[tool](Desk& d) {
            Handles handles = d.view_state().handles;
            handles.tool = tool == Handles::Tool::turn ? Handles::Tool::move : Handles::Tool::turn;
            d.apply(command::SetHandles{handles});
          },
          [tool](Desk& d) { return d.view_state().handles.tool == tool; }};
}
inline Effect toggles(bool Handles::*member) {
  return {{}, [member](Desk& d) { return d.view_state().handles.*member != d.before.view_state.handles.*member; }};
}

inline void add_select_and_camera(Effects& all) {
  const auto selects_last = [](Desk& d) { return d.view_state().selection == selectable(d.preset()).back(); };
  all["Select the next"] = {{}, [](Desk& d) { return d.view_state().selection == selectable(d.preset()).front(); }};
  all["Select the one before"] = {{}, selects_last};
  all["Deselect"] = {select_lamp, [](Desk& d) { return d.view_state().selection == Selection{}; }};
  all["Delete"] = {select_lamp,
                   [](Desk& d) { return d.scene().lights.size() + 1 == d.before.preset.scene.lights.size(); }};
  all["Look at the selected"] = {select_lamp,
                                 [](Desk& d) { return d.scene().camera.target == d.scene().lights[0].position; }};
  all["Move"] = uses(Handles::Tool::move);
  all["Turn"] = uses(Handles::Tool::turn);
  all["Scale"] = uses(Handles::Tool::scale);
  all["Own axes"] = toggles(&Handles::own_axes);
  all["Snap"] = toggles(&Handles::snap);
  all["Icons and handles"] = toggles(&Handles::shown);
  // The camera looks along -z.
  all["Nudge to the left"] = nudges(0, -1);
  all["Nudge to the right"] = nudges(0, 1);
  all["Nudge up"] = nudges(1, 1);
  all["Nudge down"] = nudges(1, -1);
  all["Nudge away"] = nudges(2, -1);
  all["Nudge nearer"] = nudges(2, 1);

  all["Bookmark this camera"] = {
      {}, [](Desk& d) { return d.view_state().bookmarks.size() == d.before.view_state.bookmarks.size() + 1; }};
  const auto bookmark_nine = [](Desk& d) {
    std::vector<Bookmark> bookmarks;
    for (int bookmark = 1; bookmark <= 9; ++bookmark)
      d.edit(10 + bookmark), bookmarks.push_back({"", d.scene().camera});
    d.apply(command::SetBookmarks{bookmarks});
    d.edit();
  };
  for (int i = 1; i <= 9; ++i)
    all[fmt::format("Go to camera {}", i)] = {bookmark_nine,
                                              [i](Desk& d) { return d.scene().camera.position[2] == 10 + i; }};
}

/// The lamp brightens over 8 frames; frame 3 is shown.
inline void animate(Desk& d) {
  d.HeadlessWindow::edit([](preset::Preset& p) {
    p.animation = {8, 24, {{"scene.lights.0.power_w", {}, {{0, {1}}, {7, {8}}}}}};
  });
  d.apply(command::ShowFrame{3});
}
inline Effect shows_frame(int frame) {
  return {animate, [frame](Desk& d) { return d.workbench.edits()->frame() == frame; }};
}

inline void add_animation(Effects& all) {
  all["Play"] = {animate, [](Desk& d) { return d.workbench.playback().playing(); }};
  all["Next frame"] = shows_frame(4);
  all["Frame before"] = shows_frame(2);
  all["First frame"] = shows_frame(0);
  all["Record the film..."] = {animate, asks(Question::record)};
  all["Stop recording"] = {[](Desk& d) {
                             d.runs.opens_device = false; // so that it lasts
                             animate(d);
                             d.apply(command::RecordFilm{d.folder.path() / "film"});
                           },
                           [](Desk& d) { return d.workbench.film().summary() == "stopping"; }};
}

inline Effect moves_pixel(int x, int y) {
  return {inspect_pixel, [x, y](Desk& d) { return d.view_state().pixel == std::optional(std::array{20 + x, 20 + y}); }};
}
inline Effect sets_tone(preset::Display::Tone tone) {
  using Curve = preset::Display::Tone;
  return {[tone](Desk& d) { d.set_tone(tone == Curve::filmic ? Curve::clip : Curve::filmic); },
          [tone](Desk& d) { return d.preset().display.tone == tone; }};
}
/// Pinned, so that there is something to compare with.
inline void compare_with_pin(Desk& d) {
  pin(d);
  d.apply(command::CompareWith{d.comparing().pinned().all().front().id});
}

inline void add_run_and_view(Effects& all) {
  const auto is = [](job::State state) { return [state](Desk& d) { return d.run().status().state == state; }; };
  all["Start again"] = {{}, [](Desk& d) { return d.run().status().generation > d.before.run; }};
  all["Pause"] = {{}, is(job::State::paused)};
  all["Cancel"] = {{}, is(job::State::cancelled)};
  all["Pin this run"] = {{}, [](Desk& d) { return d.comparing().pinned().all().size() == 1; }};
  all["Start the sweep"] = {give_sweep, [](Desk& d) { return d.workbench.sweep().active(); }};
  all["Stop the sweep"] = {[](Desk& d) { give_sweep(d), d.apply(command::StartSweep{}); },
                           [](Desk& d) { return !d.workbench.sweep().active(); }};
  all["Write a report..."] = {{}, asks(Question::save_report)};
  all["Show as glass"] = {
      [](Desk& d) {
        d.apply(command::Cancel{});
        EXPECT_TRUE(
            d.comes_to([](Desk& desk) { return desk.workbench.run().status().state == job::State::cancelled; }));
        d.runs.files = {
            {"view.json", [text = ball_text()](ByteSink& file) { file.write(std::as_bytes(std::span(text))); }}};
        d.apply(command::Restart{});
        EXPECT_TRUE(d.comes_to([](Desk& desk) { return desk.workbench.run().snapshot_is_current(); }));
      },
      [](Desk& d) { return is_there(d.folder.path() / "test-object/view.json"); }};

  all["Flip"] = {compare_with_pin, [](Desk& d) { return d.comparing().comparison().flip; }};
  all["Difference"] = {compare_with_pin, [](Desk& d) { return d.comparing().comparison().difference; }};
  const auto arranges = [](Arrangement arrangement) {
    return Effect{compare_with_pin,
                  [arrangement](Desk& d) { return d.comparing().comparison().arrangement == arrangement; }};
  };
  all["Split"] = arranges(Arrangement::split);
  all["Side by side"] = arranges(Arrangement::side_by_side);
  all["Copy metrics"] = {[](Desk& d) {
                           compare_with_pin(d);
                           d.apply(command::Arrange{Arrangement::split});
                           EXPECT_TRUE(d.comes_to([](Desk& desk) { return desk.comparing().metrics() != nullptr; }));
                         },
                         copies("rel_l2")};
  all["Picture before"] =
      all["Picture after"] = {pin, [](Desk& d) { return d.comparing().comparison().shown != 0; }}; // two, round again
  const auto pin_eight = [](Desk& d) {
    for (int i = 0; i < 8; ++i) pin(d);
  };
  const auto pin_id = [](Desk& d, std::size_t number) { return d.comparing().pinned().all()[number - 2].id; };
  for (std::size_t i = 2; i <= 9; ++i) {
    all[fmt::format("Picture {}", i)] = {pin_eight,
                                         [=](Desk& d) { return d.comparing().comparison().shown == pin_id(d, i); }};
    all[fmt::format("Compare with picture {}", i)] = {
        pin_eight, [=](Desk& d) { return d.comparing().comparison().pin == pin_id(d, i); }};
  }
  all["Picture 1"] = {[](Desk& d) { pin(d), d.apply(command::ShowPicture{d.comparing().pinned().all().front().id}); },
                      [](Desk& d) { return d.comparing().comparison().shown == 0; }};
  all["Compare with picture 1"] = {{},
                                   [](Desk& d) { return d.comparing().comparison().pin == Comparison::run_in_hand; }};
  all["Compare with the next"] = {pin, [](Desk& d) { return d.comparing().comparison().pin != 0; }};
  all["Fit"] = {[](Desk& d) { d.look({.fit = false, .zoom = 2}); },
                [](Desk& d) { return d.view_state().view_settings.fit; }};
  all["Actual size"] = {
      {}, [](Desk& d) { return !d.view_state().view_settings.fit && d.view_state().view_settings.zoom == 1; }};
  all["Brighter"] = {{}, [](Desk& d) { return d.view_state().view_settings.exposure_stops == 0.5; }};
  all["Darker"] = {{}, [](Desk& d) { return d.view_state().view_settings.exposure_stops == -0.5; }};
  all["Exposure 0"] = {[](Desk& d) { d.look({.exposure_stops = 3}); },
                       [](Desk& d) { return d.view_state().view_settings.exposure_stops == 0; }};
  const auto shows_direct = [](Desk& d) { return d.comparing().comparison().layer == "direct"; };
  all["Next layer"] = {{}, shows_direct};
  all["Previous layer"] = {{}, shows_direct}; // there is one, so that both ways lead to it
  using Shown = preset::Display;
  all["Next tone curve"] = {{}, [](Desk& d) { return d.preset().display.tone == Shown::Tone::filmic; }};
  all["Tone reinhard"] = sets_tone(Shown::Tone::reinhard);
  all["Tone filmic"] = sets_tone(Shown::Tone::filmic);
  all["Tone clip"] = sets_tone(Shown::Tone::clip);
  all["False colour"] = {{}, [](Desk& d) { return d.view_state().view_settings.false_colour; }};
  all["Keep hues"] = {{}, [](Desk& d) { return d.preset().display.gamut == Shown::Gamut::clip; }};
  all["The lamp is white"] = {{},
                              [](Desk& d) { return d.preset().display.white_balance == Shown::WhiteBalance::light; }};
  all["Inspect pixel"] = {{}, [](Desk& d) { return d.view_state().pixel == std::optional(std::array{32, 24}); }};
  all["Pixel to the left"] = moves_pixel(-1, 0);
  all["Pixel to the right"] = moves_pixel(1, 0);
  all["Pixel above"] = moves_pixel(0, -1);
  all["Pixel below"] = moves_pixel(0, 1);
  all["Copy pixel"] = {inspect_pixel, copies("20")};
  all["Statistics of the picture"] = {{}, [](Desk& d) {
                                        return d.view_state().region == std::optional(PixelRegion{{0, 0}, {64, 48}});
                                      }};
}

/// Whether it is the panel that was brought to the front last.
inline bool in_front(const char* title) {
  const ImGuiWindow* window = ImGui::FindWindowByName(title);
  return window && ImGui::GetCurrentContext()->NavWindow == window &&
         (!window->DockNode || window->DockNode->VisibleWindow == window);
}

/// What can be closed is closed; the picture comes to the front.
inline Effect of_panel(const PanelEntry& entry) {
  const auto prepare = [entry](Desk& d) {
    if (entry.name == "meters") {
      preset::Preset preset = d.preset();
      preset.scene.meters = {{.name = "air"}};
      d.apply(command::Edit{"Add a meter", std::move(preset)});
    }
    for (const engine::Engine* engine : engine::engines())
      if (!serves(entry, d.preset())) d.apply(command::New{engine->introduction.new_scene.preset});
    d.apply(command::ShowPanel{can_close(entry) ? std::string(entry.name) : "plan", true});
    if (!ImGui::GetIO().WantTextInput) return; // the presets' search has the keyboard
    d.hold(ImGuiKey_Escape);
    d.lift(ImGuiKey_Escape);
  };
  if (!can_close(entry)) return {prepare, [entry](Desk&) { return in_front(entry.title); }};
  return {prepare, [entry](Desk& d) {
            const std::string engine(d.preset().settings.engine());
            const auto now = d.settings().engines.find(engine);
            return now != d.settings().engines.end() && now->second.closed.contains(std::string(entry.name));
          }};
}

inline void add_window_and_help(Effects& all) {
  for (const PanelEntry& entry : panel_table()) all[fmt::format("Panel: {}", entry.title)] = of_panel(entry);
  all["Find a preset"] = {applies(command::ShowPanel{"plan", true}), [](Desk&) { return in_front("Presets"); }};
  all["Reset layout"] = {applies(command::ShowPanel{"plan", false}),
                         [](Desk& d) { return d.settings().engines.at("spectral").closed.empty(); }};
  all["Light theme"] = {{}, [](Desk& d) { return d.settings().theme == Theme::light; }};
  all["Larger text"] = {{}, [](Desk& d) { return d.settings().text_size > 1.05; }};
  all["Smaller text"] = {{}, [](Desk& d) { return d.settings().text_size < 0.95; }};
  all["Text as the display has it"] = {applies(command::SetAppearance{Theme::dark, 1.3}),
                                       [](Desk& d) { return d.settings().text_size == 1; }};
  all["Commands..."] = {{}, asks(Question::command)};
  all["Mouse and keys"] = {{}, [](Desk& d) { return d.workbench.setup().help_shown(); }};
}

} // namespace effects

inline Effects action_effects() {
  Effects all;
  effects::add_file_and_edit(all);
  effects::add_additions(all);
  effects::add_select_and_camera(all);
  effects::add_animation(all);
  effects::add_run_and_view(all);
  effects::add_window_and_help(all);
  return all;
}

} // namespace nephroid::test
