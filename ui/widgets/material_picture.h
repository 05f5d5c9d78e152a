// SPDX-License-Identifier: Apache-2.0
// Pictures of materials (ui/state/material_balls.h) in a panel.
#pragma once
#include "ui/state/material_balls.h"
#include "ui/widgets/picture_texture.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

class MaterialPictures {
public:
  /// Draws the material's picture as the next item, `edge` pixels wide; while there is none, an empty place. Out of
  /// sight it asks for none. Noted as `widget` where there is one.
  void draw(MaterialBalls& balls, const std::string& material, float edge, WidgetPlaces& places,
            const std::string& widget);

private:
  struct Drawn {
    std::shared_ptr<const job::Picture> picture; ///< what is in the texture
    PictureTexture texture;
  };
  std::map<std::string, Drawn> drawn_; ///< by the materials' names
};

} // namespace nephroid::ui
