// SPDX-License-Identifier: Apache-2.0
// The window's session and its settings. What is read is written and read again.
#include "tests/fuzz/harness.h"
#include "ui/state/session.h"

namespace nephroid::fuzz {

void read(std::string_view input) {
  const std::string text(input);
  accepts([&] { ui::parse_session_header(text, "session.json"); });
  accepts([&] {
    const ui::WindowSettings settings = ui::parse_settings(text, "settings.json");
    if (ui::parse_settings(ui::to_json(settings), "settings.json") != settings)
      finding("other settings are read than were written");
  });
  const ui::Session session = ui::parse_session(text, "session.json");
  const std::string written = ui::SessionText().of(session);
  if (ui::SessionText().of(ui::parse_session(written, "session.json")) != written)
    finding("another session is read than was written");
}

std::vector<std::string> seeds() {
  ui::WindowSettings settings;
  settings.engines["spectral"] = {"[Window][View]\nPos=0,20\n", {"Plan"}};
  ui::Session session;
  const preset::Preset preset = preset::read_preset("first-light");
  preset::Preset other = preset;
  other.seed = 5;
  ui::UndoStack edits(preset);
  edits.push("seed", std::move(other));
  edits.push("sweep", preset, preset::Sweep{{"seed", {"1", "2"}}});
  session.edits = edits.state();
  session.view_state.bookmarks = {{"near", {}}};
  session.pins = {{"pin-1", "first", 7, true}};
  return {ui::to_json(settings), ui::SessionText().of(session)};
}

} // namespace nephroid::fuzz
