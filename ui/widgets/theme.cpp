// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/theme.h"

#include "third_party/embedded_font.h"

namespace nephroid::ui {
namespace {

constexpr float font_size = 16;

ImVec4 grey(float value, float alpha = 1) { return {value, value, value, alpha}; }

ImVec4 accent(float alpha) {
  ImVec4 tint = ImGui::ColorConvertU32ToFloat4(colour::accent);
  tint.w = alpha;
  return tint;
}

/// What differs between the themes: greys of grounds and lines, and the colours of text on a panel.
struct Greys {
  float bar, popup, button, window, tab, frame, hovered, active, line;
};
struct Words {
  ImU32 text, quiet_text, error, note;
};

constexpr ImU32 grey_text(int value) { return IM_COL32(value, value, value, 255); }
constexpr Greys dark_greys{0.13f, 0.14f, 0.28f, 0.17f, 0.22f, 0.25f, 0.31f, 0.36f, 0.30f},
    light_greys{0.80f, 0.96f, 0.80f, 0.90f, 0.92f, 0.98f, 0.85f, 0.78f, 0.70f};
constexpr Words dark_words{colour::on_dark, colour::quiet_on_dark, IM_COL32(240, 128, 112, 255), colour::note_on_dark},
    light_words{grey_text(24), grey_text(84), IM_COL32(176, 28, 16, 255), IM_COL32(122, 82, 0, 255)};

void set_colours(ImGuiStyle& style, bool light) {
  const Greys& shade = light ? light_greys : dark_greys;
  const Words& words = light ? light_words : dark_words;
  colour::text = words.text;
  colour::quiet_text = words.quiet_text;
  colour::error = words.error;
  colour::note = words.note;
  light ? ImGui::StyleColorsLight(&style) : ImGui::StyleColorsDark(&style);
  ImVec4* c = style.Colors;
  c[ImGuiCol_Text] = ImGui::ColorConvertU32ToFloat4(colour::text);
  c[ImGuiCol_TextDisabled] = ImGui::ColorConvertU32ToFloat4(colour::quiet_text);
  c[ImGuiCol_WindowBg] = grey(shade.window);
  c[ImGuiCol_PopupBg] = grey(shade.popup, 0.98f);
  c[ImGuiCol_MenuBarBg] = grey(shade.bar);
  c[ImGuiCol_Border] = grey(shade.line);
  c[ImGuiCol_FrameBg] = grey(shade.frame);
  c[ImGuiCol_FrameBgHovered] = grey(shade.hovered);
  c[ImGuiCol_FrameBgActive] = grey(shade.active);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = grey(shade.bar);
  c[ImGuiCol_Button] = grey(shade.button);
  c[ImGuiCol_ButtonHovered] = grey(shade.active);
  c[ImGuiCol_ButtonActive] = accent(0.9f);
  c[ImGuiCol_Header] = grey(shade.button);
  c[ImGuiCol_HeaderHovered] = accent(0.45f);
  c[ImGuiCol_HeaderActive] = accent(0.7f);
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_CheckMark] = accent(1);
  c[ImGuiCol_SliderGrabActive] = ImGui::ColorConvertU32ToFloat4(colour::text);
  c[ImGuiCol_PlotHistogram] = accent(1);
  c[ImGuiCol_Tab] = c[ImGuiCol_TabDimmed] = grey(shade.bar);
  c[ImGuiCol_TabHovered] = grey(shade.line);
  c[ImGuiCol_TabSelected] = c[ImGuiCol_TabDimmedSelected] = grey(shade.tab);
  c[ImGuiCol_TabSelectedOverline] = accent(1);
  c[ImGuiCol_TabDimmedSelectedOverline] = accent(0.4f);
  c[ImGuiCol_Separator] = grey(shade.line);
  c[ImGuiCol_DockingEmptyBg] = grey(0.11f);
  c[ImGuiCol_DockingPreview] = accent(0.6f);
  c[ImGuiCol_NavCursor] = accent(1);
  c[ImGuiCol_TextSelectedBg] = accent(0.45f);
  c[ImGuiCol_ModalWindowDimBg] = grey(0, 0.45f);
}

} // namespace

void add_font() {
  const auto bytes = embedded_font();
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(bytes.data()), static_cast<int>(bytes.size()),
                                             font_size, &config);
}

void set_theme(float scale, Theme theme) {
  ImGuiStyle style;
  set_colours(style, theme == Theme::light);
  style.WindowRounding = style.FrameRounding = style.PopupRounding = style.GrabRounding = 4;
  style.TabRounding = 4;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FramePadding = {9, 5};
  style.ItemSpacing = {9, 7};
  style.WindowPadding = {9, 8};
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.TabCloseButtonMinWidthSelected = 0; // only under the mouse, because the titles need the room
  style.DockingNodeHasCloseButton = false;  // each tab has its own
  style.ScaleAllSizes(scale);
  style.FontSizeBase = font_size;
  style.FontScaleDpi = scale;
  ImGui::GetStyle() = style;
}

} // namespace nephroid::ui
