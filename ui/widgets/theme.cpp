// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/theme.h"

#include "third_party/embedded_font.h"

namespace nephroid::ui {
namespace {

constexpr float font_size = 16;

ImVec4 grey(float value, float alpha = 1) { return {value, value, value, alpha}; }

ImVec4 accent(float alpha)
{
  ImVec4 made = ImGui::ColorConvertU32ToFloat4(colour::accent);
  made.w = alpha;
  return made;
}

void set_colours(ImGuiStyle& style)
{
  ImGui::StyleColorsDark(&style);
  ImVec4* c = style.Colors;
  c[ImGuiCol_Text] = ImGui::ColorConvertU32ToFloat4(colour::text);
  c[ImGuiCol_TextDisabled] = ImGui::ColorConvertU32ToFloat4(colour::quiet_text);
  c[ImGuiCol_WindowBg] = grey(0.17f);
  c[ImGuiCol_PopupBg] = grey(0.14f, 0.98f);
  c[ImGuiCol_MenuBarBg] = grey(0.13f);
  c[ImGuiCol_Border] = grey(0.30f);
  c[ImGuiCol_FrameBg] = grey(0.25f);
  c[ImGuiCol_FrameBgHovered] = grey(0.31f);
  c[ImGuiCol_FrameBgActive] = grey(0.36f);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = grey(0.13f);
  c[ImGuiCol_Button] = grey(0.28f);
  c[ImGuiCol_ButtonHovered] = grey(0.35f);
  c[ImGuiCol_ButtonActive] = accent(0.9f);
  c[ImGuiCol_Header] = grey(0.28f);
  c[ImGuiCol_HeaderHovered] = accent(0.45f);
  c[ImGuiCol_HeaderActive] = accent(0.7f);
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_CheckMark] = accent(1);
  c[ImGuiCol_SliderGrabActive] = grey(0.9f);
  c[ImGuiCol_PlotHistogram] = accent(1);
  c[ImGuiCol_Tab] = c[ImGuiCol_TabDimmed] = grey(0.13f);
  c[ImGuiCol_TabHovered] = grey(0.30f);
  c[ImGuiCol_TabSelected] = c[ImGuiCol_TabDimmedSelected] = grey(0.22f);
  c[ImGuiCol_TabSelectedOverline] = accent(1);
  c[ImGuiCol_TabDimmedSelectedOverline] = accent(0.4f);
  c[ImGuiCol_Separator] = grey(0.28f);
  c[ImGuiCol_DockingEmptyBg] = grey(0.11f);
  c[ImGuiCol_DockingPreview] = accent(0.6f);
  c[ImGuiCol_NavCursor] = accent(1);
  c[ImGuiCol_TextSelectedBg] = accent(0.45f);
  c[ImGuiCol_ModalWindowDimBg] = grey(0, 0.45f);
}

} // namespace

void add_font()
{
  const auto bytes = embedded_font();
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(bytes.data()), static_cast<int>(bytes.size()), font_size, &config);
}

void set_theme(float scale)
{
  ImGuiStyle style;
  set_colours(style);
  style.WindowRounding = style.FrameRounding = style.PopupRounding = style.GrabRounding = 4;
  style.TabRounding = 4;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FramePadding = {9, 5};
  style.ItemSpacing = {9, 7};
  style.WindowPadding = {9, 8};
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.ScaleAllSizes(scale);
  style.FontSizeBase = font_size;
  style.FontScaleDpi = scale;
  ImGui::GetStyle() = style;
}

} // namespace nephroid::ui
