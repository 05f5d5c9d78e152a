// SPDX-License-Identifier: Apache-2.0
// The menu "Pictures": which one is shown, what it is held against, and how.
#include "ui/actions/table.h"
#include "ui/view/bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace nephroid::ui {
namespace {

// What is on can be turned off, whatever became of the other picture.
bool can_flip(C c) { return c.comparing.comparison().flip || c.comparing.why_not().empty(); }
bool can_difference(C c) { return c.comparing.comparison().difference || c.comparing.why_not().empty(); }
std::string why_not_comparable(C c) { return c.comparing.why_not(); }
bool has_choice(C c) { return !c.comparing.pinned().all().empty(); }
std::string no_choice(C) { return "no run is pinned and no picture is open"; }

void flip(C c) { c.push(command::Flip{!c.comparing.comparison().flip}); }
void flip_back(C c) {
  if (c.comparing.comparison().flip) c.push(command::Flip{false});
}

void difference(C c) {
  const Comparison& now = c.comparing.comparison();
  c.push(command::ShowDifference{!now.difference, now.metric, now.scale});
}

/// The reference, then each pinned run and opened picture but the one that is shown, and round again.
void compare_with_next(C c) {
  const Comparison& now = c.comparing.comparison();
  const std::uint64_t after = now.pin == Comparison::run_in_hand ? 0 : now.pin;
  const auto& pins = c.comparing.pinned().all();
  const auto next =
      std::ranges::find_if(pins, [&](const PinnedRun& pin) { return pin.id > after && pin.id != now.shown; });
  c.push(command::CompareWith{next == pins.end() ? 0 : next->id});
}

/// The run in hand, then what was pinned and opened, as the panel Runs lists them.
std::vector<std::uint64_t> listed(C c) {
  std::vector<std::uint64_t> ids{0};
  std::ranges::transform(c.comparing.pinned().all(), std::back_inserter(ids), &PinnedRun::id);
  return ids;
}

/// The arrow keys are those of a pixel or of what is selected, where there is one.
bool can_step_pictures(C c) { return has_choice(c) && !c.view_state.pixel && c.selection() == Selection{}; }

template <int step>
void step_picture(C c) {
  const std::vector<std::uint64_t> ids = listed(c);
  const auto now = std::ranges::find(ids, c.comparing.comparison().shown) - ids.begin();
  c.push(command::ShowPicture{ids[static_cast<std::size_t>((now + step + std::ssize(ids)) % std::ssize(ids))]});
}

template <Arrangement arrangement>
Action arranging(const char* name, int keys, const char* help) {
  const auto is_on = [](C c) { return c.comparing.comparison().arrangement == arrangement; };
  return switching({name, keys, help, [is_on](C c) { return is_on(c) || c.comparing.why_none_beside().empty(); },
                    [is_on](C c) { c.push(command::Arrange{is_on(c) ? Arrangement::single : arrangement}); },
                    [](C c) { return c.comparing.why_none_beside(); }},
                   is_on);
}

std::string no_metrics(C c) {
  return c.comparing.comparison().measures() ? "nothing is measured yet"
                                             : "two pictures are compared by Split, Side by side or Difference";
}

bool has_number(C c, std::size_t number) { return number <= c.comparing.pinned().all().size(); }
std::string no_number(C c) { return fmt::format("the last picture is {}", listed(c).size()); }

} // namespace

std::vector<Action> picture_actions() {
  std::vector<Action> all{
      {"Flip", ImGuiKey_R, "While held: the reference, or what else is compared with", can_flip, flip,
       why_not_comparable, flip_back},
      switching({"Difference", ImGuiKey_D, "The difference from it in false colour", can_difference, difference,
                 why_not_comparable},
                [](C c) { return c.comparing.comparison().difference; }),
      arranging<Arrangement::split>("Split", ImGuiKey_C, "Both in one place, cut at a line that is dragged"),
      arranging<Arrangement::side_by_side>("Side by side", ImGuiKey_V,
                                           "Both beside each other, with the same zoom and the same pixel"),
      {"Compare with the next", ImGuiKey_N, "The reference, then each pinned run and opened picture", has_choice,
       compare_with_next, no_choice},
      {"Copy metrics", 0, "How far the two are from each other, by every metric",
       [](C c) { return !metrics_as_text(c).empty(); },
       [](C c) { ImGui::SetClipboardText(metrics_as_text(c).c_str()); }, no_metrics},
      repeating({"Picture before", ImGuiKey_UpArrow, "Show the run in hand, or what was pinned or opened before",
                 can_step_pictures, step_picture<-1>}),
      repeating({"Picture after", ImGuiKey_DownArrow, "Show what was pinned or opened next", can_step_pictures,
                 step_picture<1>}),
  };
  for (std::size_t i = 0; i < 9; ++i)
    all.push_back({fmt::format("Picture {}", i + 1), static_cast<int>(ImGuiKey_1 + i),
                   "Show it: 1 is the run in hand, the others in the panel Runs' order",
                   [i](C c) { return has_number(c, i); }, [i](C c) { c.push(command::ShowPicture{listed(c)[i]}); },
                   no_number});
  for (std::size_t i = 0; i < 9; ++i)
    all.push_back({fmt::format("Compare with picture {}", i + 1), shift | static_cast<int>(ImGuiKey_1 + i),
                   "Compare what is shown with it", [i](C c) { return has_number(c, i); },
                   [i](C c) { c.push(command::CompareWith{i == 0 ? Comparison::run_in_hand : listed(c)[i]}); },
                   no_number});
  return all;
}

} // namespace nephroid::ui
