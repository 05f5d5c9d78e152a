// SPDX-License-Identifier: Apache-2.0
// A picture as a texture of Dear ImGui. The renderer's back end uploads it (ImTextureData), so this code knows no
// OpenGL and also works without a back end.
#pragma once
#include <span>
#include <vector>

struct ImTextureData;
struct ImTextureRef;
struct ImVec2;

namespace nephroid::ui {

class PictureTexture {
public:
  PictureTexture() = default;
  ~PictureTexture();
  PictureTexture(const PictureTexture&) = delete;
  PictureTexture& operator=(const PictureTexture&) = delete;

  /// The texture's memory, 4 bytes per pixel, to be filled; the next frame uploads it. Sizes are at least 1.
  std::span<unsigned char> edit(int width, int height);
  bool empty() const { return texture_ == nullptr; }
  /// Called after edit().
  ImTextureRef ref() const;
  std::span<const unsigned char> pixels() const;
  /// Draws into the window, from corner to corner. `squares`: enlarged pixels appear as squares.
  void draw(const ImVec2& low, const ImVec2& high, bool squares) const;

private:
  void free_retired();

  ImTextureData* texture_ = nullptr;
  std::vector<ImTextureData*> retired_; ///< textures of other sizes, until the back end releases them
};

} // namespace nephroid::ui
