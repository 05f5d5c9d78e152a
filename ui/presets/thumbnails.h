// SPDX-License-Identifier: Apache-2.0
// Small pictures of presets, read away from the window's thread when they come into sight. One that is missing or broken is known as such
// and not read again.
#pragma once
#include "ui/widgets/picture_texture.h"

#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace nephroid::ui {

class Thumbnails {
public:
  /// Once a frame: takes what was read, and reads what was asked for.
  void update();
  /// Null where there is no picture, or none yet: then it is asked for.
  const PictureTexture* of(const std::filesystem::path& file);
  /// Reads every file again that is asked for: they may have changed.
  void read_again() { stale_ = true; }
  bool busy() const { return reading_.valid() || !wanted_.empty(); }

private:
  struct Pixels {
    std::string file;
    int width = 0, height = 0; ///< 0: there is no such picture
    std::vector<unsigned char> rgba8;
  };
  static Pixels read(const std::string& file);

  bool stale_ = false;
  std::map<std::string, std::unique_ptr<PictureTexture>> pictures_; ///< null: there is none
  std::vector<std::string> wanted_;
  std::future<std::vector<Pixels>> reading_;
};

} // namespace nephroid::ui
