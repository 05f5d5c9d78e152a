// SPDX-License-Identifier: Apache-2.0
// A picture of the workbench as a texture of Dear ImGui. The renderer's back end uploads it (ImTextureData), so this
// knows no OpenGL and works, without pixels on a screen, where there is no back end at all.
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

  /// The texture's own memory, 4 bytes a pixel, to be filled; it is uploaded with the next frame. Sizes at least 1.
  std::span<unsigned char> edit(int width, int height);
  bool empty() const { return texture_ == nullptr; }
  /// For ImDrawList::AddImage. Call edit() before.
  ImTextureRef ref() const;
  std::span<const unsigned char> pixels() const;
  /// Into the window, from corner to corner; `squares`: so large that pixels are shown as such.
  void draw(const ImVec2& low, const ImVec2& high, bool squares) const;

private:
  void free_retired();

  ImTextureData* texture_ = nullptr;
  std::vector<ImTextureData*> retired_; ///< of other sizes, until the back end let go of them
};

} // namespace nephroid::ui
