// SPDX-License-Identifier: Apache-2.0
#include "ui/state/save.h"

#include "base/error.h"
#include "image/image.h"
#include "run/picture.h"

namespace nephroid::ui {

void save_picture(const std::filesystem::path& file, const job::Picture& picture, double exposure_stops)
{
  const std::string extension = file.extension().string();
  if (extension == ".png")
    image::write_png(file, picture.width, picture.height, picture.rgb, exposure_stops);
  else if (extension == ".exr")
    image::write_exr(file, run::with_layers(picture));
  else
    throw bad_input(file.string(), "a picture cannot be saved as \"" + extension + "\"",
                    "expected .png (as shown) or .exr (linear, with layers)");
}

} // namespace nephroid::ui
