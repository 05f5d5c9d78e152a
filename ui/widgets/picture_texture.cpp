// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/picture_texture.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <utility>

namespace nephroid::ui {
namespace {

void unregister_and_delete(ImTextureData* texture) {
  if (ImGui::GetCurrentContext()) {
    ImGui::UnregisterUserTexture(texture);
    // A back end goes through this list, which is made anew only with every frame.
    ImGui::GetPlatformIO().Textures.find_erase(texture);
  }
  IM_DELETE(texture);
}

std::span<unsigned char> bytes_of(ImTextureData* texture) {
  return {static_cast<unsigned char*>(texture->GetPixels()), static_cast<std::size_t>(texture->GetSizeInBytes())};
}

} // namespace

PictureTexture::~PictureTexture() {
  for (ImTextureData* old : retired_) unregister_and_delete(old);
  if (texture_) unregister_and_delete(texture_);
}

std::span<unsigned char> PictureTexture::edit(int width, int height) {
  free_retired();
  if (texture_ && (texture_->Width != width || texture_->Height != height)) {
    texture_->WantDestroyNextFrame = true; // the current frame may still draw with it
    retired_.push_back(std::exchange(texture_, nullptr));
  }
  if (!texture_) {
    texture_ = IM_NEW(ImTextureData)();
    texture_->Create(ImTextureFormat_RGBA32, width, height);
    texture_->UseColors = true;
    ImGui::RegisterUserTexture(texture_);
  } else if (texture_->Status == ImTextureStatus_OK) {
    const ImTextureRect whole{0, 0, static_cast<unsigned short>(width), static_cast<unsigned short>(height)};
    texture_->UpdateRect = whole;
    texture_->Updates.clear();
    texture_->Updates.push_back(whole);
    texture_->SetStatus(ImTextureStatus_WantUpdates);
  }
  return bytes_of(texture_);
}

ImTextureRef PictureTexture::ref() const { return texture_->GetTexRef(); }

std::span<const unsigned char> PictureTexture::pixels() const { return bytes_of(texture_); }

void PictureTexture::draw(const ImVec2& low, const ImVec2& high, bool squares) const {
  const ImGuiPlatformIO& platform = ImGui::GetPlatformIO();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  squares = squares && platform.DrawCallback_SetSamplerNearest;
  if (squares) list.AddCallback(platform.DrawCallback_SetSamplerNearest, nullptr);
  list.AddImage(ref(), low, high);
  if (squares) list.AddCallback(platform.DrawCallback_SetSamplerLinear, nullptr);
}

void PictureTexture::free_retired() {
  std::erase_if(retired_, [](ImTextureData* texture) {
    if (texture->Status == ImTextureStatus_Destroyed || texture->TexID == ImTextureID_Invalid) {
      unregister_and_delete(texture);
      return true;
    }
    texture->UnusedFrames = 1;
    texture->SetStatus(ImTextureStatus_WantDestroy);
    return false;
  });
}

} // namespace nephroid::ui
