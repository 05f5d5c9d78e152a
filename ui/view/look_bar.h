// SPDX-License-Identifier: Apache-2.0
// The View's row of what is shown and how: layer, tone curve, the range of false colour; and the legend of false colour.
#pragma once
#include "ui/state/context.h"
#include "ui/state/tone.h"
#include "ui/view/placement.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

/// "false colour"
const char* tone_name(ToneCurve curve);

/// tone: that of the picture that is shown. places: of its widgets, for tests.
void draw_look_bar(const Context& context, const Tone& tone, WidgetPlaces& places);
/// Along the canvas' right edge: luminance in W/m^2/sr, and the colours of what is no luminance.
void draw_luminance_scale(const LuminanceRange& range, const Canvas& canvas);

} // namespace nephroid::ui
