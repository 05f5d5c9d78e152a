// SPDX-License-Identifier: Apache-2.0
// The menu "View": how the picture is shown, and what it is held against.
#include "ui/actions/table.h"

#include <algorithm>

namespace nephroid::ui {
namespace {

using C = const Context&;

template <class Change>
void look(C c, Change change)
{
  Look look = c.chosen.look;
  change(look);
  c.push(command::SetLook{look});
}

template <int half_stops>
void expose(C c)
{
  look(c, [](Look& l) { l.exposure_stops += half_stops / 2.0; });
}

void as_it_is(C c)
{
  look(c, [](Look& l) { l.exposure_stops = 0; });
}

void fit(C c)
{
  look(c, [](Look& l) { l.fit = true; });
}

void actual_size(C c)
{
  const job::Picture& picture = *c.run.snapshot()->picture;
  look(c, [&](Look& l) {
    l.fit = false;
    l.zoom = 1;
    l.centre = {picture.width / 2.0, picture.height / 2.0};
  });
}

// What is on can be turned off, whatever became of the other picture.
bool can_flip(C c) { return c.comparing.comparison().flip || c.comparing.why_not().empty(); }
bool can_difference(C c) { return c.comparing.comparison().difference || c.comparing.why_not().empty(); }
std::string why_not_comparable(C c) { return c.comparing.why_not(); }
bool has_choice(C c) { return !c.comparing.pinned().all().empty(); }
std::string no_choice(C) { return "no run is pinned"; }

void flip(C c) { c.push(command::Flip{!c.comparing.comparison().flip}); }
void flip_back(C c)
{
  if (c.comparing.comparison().flip) c.push(command::Flip{false});
}

void difference(C c)
{
  const Comparison& now = c.comparing.comparison();
  c.push(command::ShowDifference{!now.difference, now.metric, now.scale});
}

/// The reference, then each pinned run, and round again.
void compare_with_next(C c)
{
  const std::vector<PinnedRun>& runs = c.comparing.pinned().all();
  const auto next = std::find_if(runs.begin(), runs.end(), [&](const PinnedRun& run) { return run.id > c.comparing.comparison().pin; });
  c.push(command::CompareWith{next == runs.end() ? 0 : next->id});
}

} // namespace

std::vector<Action> view_actions()
{
  const char* menu = "View";
  return {
      {menu, "Flip", ImGuiKey_R, false, "While held: the reference, or the pinned run that is compared with", can_flip, flip,
       why_not_comparable, flip_back},
      {menu, "Difference", ImGuiKey_D, false, "The difference from it in false colour", can_difference, difference, why_not_comparable},
      {menu, "Compare with the next", ImGuiKey_N, false, "The reference, then each pinned run", has_choice, compare_with_next, no_choice},
      {menu, "Fit", ImGuiKey_F, false, "The whole picture in the panel", has_picture, fit},
      {menu, "Actual size", ImGuiKey_1, false, "One pixel of the picture is one of the screen", has_picture, actual_size},
      {menu, "Brighter", ImGuiKey_E, true, "Half a stop more exposure", always, expose<1>},
      {menu, "Darker", shift | ImGuiKey_E, true, "Half a stop less exposure", always, expose<-1>},
      {menu, "Exposure 0", ImGuiKey_0, false, "The picture as image.png shows it", always, as_it_is},
  };
}

} // namespace nephroid::ui
