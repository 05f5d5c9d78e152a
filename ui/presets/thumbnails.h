// SPDX-License-Identifier: Apache-2.0
// Small pictures of presets, read away from the window's thread when they come into sight. One that is missing or broken is known as such
// and not read again.
#pragma once
#include "ui/state/tasks.h"
#include "ui/widgets/picture_texture.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace nephroid::ui {

class Thumbnails {
public:
  /// Once a frame: reads what was asked for.
  void update(TaskQueue& tasks);
  /// Null where there is no picture, or none yet: then it is asked for.
  const PictureTexture* of(const std::filesystem::path& file);
  /// Reads every file again that is asked for: they may have changed.
  void read_again() { stale_ = true; }
  bool busy(const TaskQueue& tasks) const { return tasks.busy(reading_) || !wanted_.empty(); }

private:
  struct Pixels {
    std::string file;
    int width = 0, height = 0; ///< 0: there is no such picture
    std::vector<unsigned char> rgba8;
  };
  static Pixels read(const std::string& file);
  void take(const std::vector<Pixels>& pictures);

  bool stale_ = false;
  std::map<std::string, std::unique_ptr<PictureTexture>> pictures_; ///< null: there is none
  std::vector<std::string> wanted_;
  TaskKey reading_;
};

} // namespace nephroid::ui
