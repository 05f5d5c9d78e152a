// SPDX-License-Identifier: Apache-2.0
// What people read and see of an engine beside its runs: words, examples and colours, as data. A default is left out wherever it is shown.
#pragma once
#include <array>

namespace nephroid::engine {

/// A shipped preset to begin with.
struct ShippedExample {
  const char* preset = nullptr; ///< its name: "first-light"
  const char* title = "";       ///< of the engine's card on the window's start page
  const char* sentence = "";    ///< what the engine does, on that card
  const char* run = "";         ///< what `nephroid run PRESET` makes, in the help
};

/// A scene to begin with: small, complete, and in no file.
struct NewScene {
  const char* preset = nullptr; ///< as JSON
  const char* what = "";        ///< "A glass sphere under a sky"
};

/// What a finished run found, as a preset among its own files (job::ExtraFile), which the window offers to save and to open.
struct ResultView {
  const char* file = nullptr; ///< its name: "view.json"
  const char* action = "";    ///< of the offer: "Show as glass"
  const char* what = "";      ///< what is opened: "as lit glass over its receivers"
};

struct Introduction {
  ShippedExample example = {};
  NewScene new_scene = {};
  ResultView result = {};
  std::array<unsigned char, 3> badge{80, 80, 80}; ///< sRGB behind the engine's name in lists; dark enough for white letters
};

} // namespace nephroid::engine
