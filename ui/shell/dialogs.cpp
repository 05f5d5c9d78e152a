// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/dialogs.h"

#include "base/files.h"
#include "preset/differences.h"
#include "ui/state/workbench.h"
#include "ui/widgets/theme.h"

#include <algorithm>

namespace nephroid::ui {
namespace {

namespace fs = std::filesystem;

struct DialogKind {
  Question question;
  const char* title;
  const char* proposal;                               ///< what a proposed name ends in; empty: no name is proposed
  std::vector<std::string> endings;                   ///< the endings of its files
  const char *hint = "", *note = "";                  ///< in the field for the name; below the list of files
  Command (*open)(const std::string& name) = nullptr; ///< what a chosen file is asked for
};

const DialogKind& kind_of_dialog(Question question) {
  const auto pin = [](const std::string& name) { return Command(command::PinFile{name}); };
  const auto show = [](const std::string& name) { return Command(command::PinFile{name, true}); };
  const auto surround = [](const std::string& name) { return Command(command::OpenMap{name}); };
  const auto add = [](const std::string& name) { return Command(command::AddMesh{name}); };
  static const DialogKind kinds[] = {
      {Question::open, "Open a preset or a scene", "", {".json", ".gltf", ".glb", ".xml", ".pbrt", ".asc"}},
      {Question::open_history,
       "Open the history of a run",
       "",
       {".csv"},
       "folder of a run, or its history.csv",
       "Of a folder the picture is kept too. Dropping it on the window does the same.",
       pin},
      {Question::open_pictures,
       "Open pictures",
       "",
       {".exr", ".hdr", ".pfm", ".png", ".jpg", ".jpeg", ".tif", ".tiff"},
       "path of a picture",
       "Several at once: drop them on the panel Runs, which lists them.",
       show},
      {Question::open_map,
       "Open a map of the environment",
       "",
       {".hdr", ".exr"},
       "a latitude-longitude picture",
       "Pictures of all directions (.hdr, .exr). Dropping one on the window does the same.",
       surround},
      {Question::add_mesh,
       "Add a mesh",
       "",
       {".obj", ".ply", ".stl", ".3ds"},
       "path of a mesh",
       "It is scaled to fit the picture. Dropping a mesh on the window does the same.",
       add},
      {Question::save_preset, "Save the preset as", "-edited.nephroid.json", {".json"}},
      {Question::save_picture, "Save the picture as", ".png", {".png", ".exr"}},
      {Question::save_report, "Write a report over the runs", "-report.html", {".html"}},
      {Question::record, "Record the film", "-film", {".json"}},
      {Question::unsaved, "Unsaved changes", "", {}}};
  return *std::ranges::find(kinds, question, &DialogKind::question);
}

/// A field for a file's name, and a button. True where the name is chosen by one of them. replaces: Enter in the field
/// only goes to the button, so that a file takes two of them. possible: whether the name will do.
bool choose_name(const char* hint, float width, std::string& name, const char* button, bool possible,
                 bool replaces = false) {
  ImGui::SetNextItemWidth(width);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputTextWithHint("##file", hint, &name, ImGuiInputTextFlags_EnterReturnsTrue);
  if (entered && !replaces) ImGui::SetKeyboardFocusHere(-1); // a name that is refused can be typed anew
  ImGui::SameLine();
  ImGui::BeginDisabled(!possible);
  if (entered && replaces) ImGui::SetKeyboardFocusHere();
  const bool pressed = ImGui::Button(button);
  ImGui::EndDisabled();
  return pressed || (entered && possible && !replaces);
}

} // namespace

void Dialogs::begin(Workbench& workbench) {
  shown_ = workbench.questions().question();
  said_before_ = 0;
  for (const Message& message : workbench.messages()) said_before_ = std::max(said_before_, message.said);
  name_.clear();
  const DialogKind& kind = kind_of_dialog(shown_);
  if (*kind.proposal) name_ = proposed_name(workbench.preset(), kind.proposal);
  parent_.clear();
  if (shown_ == Question::save_preset && workbench.preset()) {
    parent_ = parent_to_keep(*workbench.preset());
    keep_parent_ = !preset::own_parent(workbench.preset()->source).empty();
  }
  shipped_.clear();
  ImGui::OpenPopup(kind.title);
  if (shown_ == Question::open) shipped_ = preset::shipped_presets();
  if (shown_ != Question::unsaved)
    files_.begin(save_target(workbench.preset()).parent_path(), kind.endings, workbench.tasks());
}

void Dialogs::draw(Workbench& workbench, Commands& commands) {
  if (workbench.questions().question() == Question::none || workbench.questions().question() == Question::command) {
    shown_ = Question::none;
    return;
  }
  if (shown_ != workbench.questions().question()) begin(workbench);
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->GetWorkCenter(), ImGuiCond_Always, {0.5f, 0.5f});
  bool open = true;
  if (!ImGui::BeginPopupModal(kind_of_dialog(shown_).title, &open,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
    commands.push_back(command::Ask{Question::none}); // closed by its cross
    return;
  }
  if (ImGui::IsKeyPressed(ImGuiKey_Escape, false)) open = false;
  if (shown_ == Question::open)
    draw_open(commands);
  else if (shown_ == Question::unsaved)
    draw_unsaved(workbench, commands);
  else if (kind_of_dialog(shown_).open)
    draw_open_file(commands);
  else if (shown_ == Question::record)
    draw_record(commands);
  else
    draw_save(commands);
  for (const Message& message : workbench.messages()) // those of the window are dimmed
    if (message.error && message.said > said_before_) draw_wrapped(colour::error, message.line);
  if (!open) commands.push_back(command::Ask{Question::none});
  ImGui::EndPopup();
}

void Dialogs::draw_open(Commands& commands) {
  if (choose_name("path of a preset or a scene, or a shipped preset's name", em() * 41, name_, "Open", !name_.empty()))
    commands.push_back(command::Open{name_});
  if (!ImGui::BeginTabBar("where")) return;
  if (ImGui::BeginTabItem("Shipped presets")) {
    if (ImGui::BeginChild("shipped", {em() * 46, em() * 16})) {
      for (const preset::ShippedPreset& shipped : shipped_) {
        if (ImGui::Selectable(shipped.name.c_str())) commands.push_back(command::Open{shipped.file.string()});
        ImGui::SameLine(em() * 11);
        ImGui::TextDisabled("%s", shipped.description.c_str());
      }
    }
    ImGui::EndChild();
    ImGui::EndTabItem();
  }
  if (ImGui::BeginTabItem("Files")) {
    if (pick_file()) commands.push_back(command::Open{name_});
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

/// The list of files; a click puts a file's name into the text field. True where it is chosen for good.
bool Dialogs::pick_file() {
  const FileList::Picked picked = files_.draw(em() * 46, em() * 14);
  if (picked != FileList::Picked::nothing) name_ = files_.picked().string();
  return picked == FileList::Picked::opened;
}

void Dialogs::draw_open_file(Commands& commands) {
  const DialogKind& kind = kind_of_dialog(shown_);
  const bool typed = choose_name(kind.hint, 41 * em(), name_, "Open", !name_.empty());
  const bool picked = pick_file();
  if (typed || picked) commands.push_back(kind.open(name_));
  ImGui::TextDisabled("%s", kind.note);
}

void Dialogs::draw_save(Commands& commands) {
  std::error_code ignored;
  const bool picture = shown_ == Question::save_picture, report = shown_ == Question::save_report;
  const bool folder = fs::is_directory(name_, ignored), bare = !fs::path(name_).has_extension();
  const std::string file = shown_ == Question::save_preset && bare && !name_.empty() ? name_ + ".json" : name_;
  const bool there = !folder && is_there(file);
  // A file of the list is only named by a click: replacing it takes the button.
  const bool chosen =
      choose_name("file", 41 * em(), name_, there ? "Replace" : "Save", !name_.empty() && !folder, there);
  places_.note("save");
  if (chosen)
    commands.push_back(report    ? Command(command::WriteReport{name_})
                       : picture ? Command(command::SavePicture{name_})
                                 : Command(command::SavePreset{file, keep_parent_ && !parent_.empty()}));
  if (!parent_.empty()) {
    places_.checkbox("Keep the parent", &keep_parent_, "keep the parent",
                     "Write only what differs from '" + parent_ + "', so that the file follows its changes");
    ImGui::SameLine();
    ImGui::TextDisabled("%s", parent_.c_str());
  }
  pick_file();
  if (ImGui::Button("Save into this folder"))
    name_ = (files_.folder() / std::filesystem::path(name_).filename()).string();
  tooltip("The name above, in the folder that is shown");
  if (picture) ImGui::TextDisabled(".png: as shown, with this exposure; .exr: linear, with every layer");
  if (report)
    ImGui::TextDisabled("One page that opens in a browser; runs that are in no folder are kept in one beside it");
  if (folder) ImGui::TextDisabled("This is a folder: the name of a file in it is wanted.");
  if (there) ImGui::TextDisabled("This file is there already: Enter twice, or the button, replaces it.");
}

void Dialogs::draw_record(Commands& commands) {
  if (choose_name("folder", 41 * em(), name_, "Record", !name_.empty())) commands.push_back(command::RecordFilm{name_});
  places_.note("record");
  pick_file();
  if (ImGui::Button("A folder in this one"))
    name_ = (files_.folder() / std::filesystem::path(name_).filename()).string();
  tooltip("The name above, in the folder that is shown");
  ImGui::TextDisabled("frame_0000.png and .exr, ..., frames.csv, and animation.mp4 where ffmpeg is installed.");
  ImGui::TextDisabled("Frames of this film that are finished there already stay.");
}

void Dialogs::draw_unsaved(const Workbench& workbench, Commands& commands) {
  const std::string then = std::holds_alternative<command::Quit>(*workbench.questions().waiting()) ? "quit" : "go on";
  ImGui::TextUnformatted("The preset was changed and is not saved.");
  const std::filesystem::path target = save_target(workbench.preset());
  // What waits is carried out once the preset is saved; where saving fails the question stays.
  if (ImGui::Button(target.empty() ? "Save as..." : ("Save and " + then).c_str())) {
    if (target.empty())
      commands.push_back(command::Ask{Question::save_preset});
    else
      commands.push_back(command::SavePreset{target});
  }
  ImGui::SameLine();
  if (ImGui::Button(then == "quit" ? "Quit without saving" : "Go on without saving"))
    commands.push_back(*workbench.questions().waiting());
  ImGui::SameLine();
  if (places_.button("Cancel", "cancel", "As Escape does: nothing is lost"))
    commands.push_back(command::Ask{Question::none});
}

} // namespace nephroid::ui
