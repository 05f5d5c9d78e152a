// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/dialogs.h"

#include "base/files.h"
#include "base/lower_case.h"
#include "preset/differences.h"
#include "ui/state/workbench.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>

namespace nephroid::ui {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_entries = 5000;

std::string size_text(std::uintmax_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1000000) return fmt::format("{:.0f} kB", static_cast<double>(bytes) / 1e3);
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

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
  static const DialogKind kinds[] = {
      {Question::open, "Open a preset", "", {".json"}},
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
      {Question::save_preset, "Save the preset as", "-edited.nephroid.json", {".json"}},
      {Question::save_picture, "Save the picture as", ".png", {".png", ".exr"}},
      {Question::save_report, "Write a report over the runs", "-report.html", {".html"}},
      {Question::unsaved, "Unsaved changes", "", {}}};
  return *std::ranges::find(kinds, question, &DialogKind::question);
}

/// A field for a file's name, and a button. True where the name is chosen by one of them. replaces: Enter in the field
/// only goes to the button, so that a file takes two of them. possible: whether the name will do.
bool choose_name(const char* hint, float width, std::string& name, const char* button, bool possible,
                 bool replaces = false) {
  ImGui::SetNextItemWidth(width);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered = input_text("##file", hint, name, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  ImGui::BeginDisabled(!possible);
  if (entered && replaces) ImGui::SetKeyboardFocusHere();
  const bool pressed = ImGui::Button(button);
  ImGui::EndDisabled();
  return pressed || (entered && possible && !replaces);
}

} // namespace

FileList::Read FileList::read(const fs::path& folder, const std::vector<std::string>& endings) {
  Read result;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const std::string name = entry->path().filename().string();
    if (name.starts_with('.')) continue;
    const bool is_folder = entry->is_directory(ignored);
    const std::string ending = lower_case(entry->path().extension().string());
    if (!is_folder && !endings.empty() && std::find(endings.begin(), endings.end(), ending) == endings.end()) continue;
    if ((result.cut = result.entries.size() == most_entries)) break;
    const std::uintmax_t bytes = is_folder ? 0 : entry->file_size(ignored);
    result.entries.push_back({entry->path(), is_folder, ignored ? 0 : bytes});
  }
  if (error) result.error = error.message();
  std::sort(result.entries.begin(), result.entries.end(), [](const Entry& a, const Entry& b) {
    return a.is_folder != b.is_folder ? a.is_folder
                                      : lower_case(a.path.filename().string()) < lower_case(b.path.filename().string());
  });
  return result;
}

void FileList::begin(fs::path folder, std::vector<std::string> endings, TaskQueue& tasks) {
  endings_ = std::move(endings);
  tasks_ = &tasks;
  go(std::move(folder));
}

void FileList::go(fs::path folder) {
  std::error_code ignored;
  folder_ = fs::absolute(folder.empty() ? "." : folder, ignored).lexically_normal();
  entries_.clear();
  note_ = "Reading the folder";
  tasks_->forget(reading_); // a folder whose disk hangs keeps no other one waiting
  tasks_->start(
      reading_, {"reading " + folder_.string()},
      [folder = folder_, endings = endings_] { return read(folder, endings); },
      [this](Read of_folder) {
        entries_ = std::move(of_folder.entries);
        note_.clear();
        if (!of_folder.error.empty())
          note_ = "This folder cannot be read: " + of_folder.error;
        else if (of_folder.cut)
          note_ = fmt::format("There are more than {} files here: type the name", most_entries);
        else if (entries_.empty())
          note_ = "Nothing of the kind that is wanted";
      });
}

FileList::Picked FileList::draw(float width, float height) {
  Picked picked = Picked::nothing;
  fs::path into;
  places_.clear();
  if (places_.button("Up", "up")) into = folder_.parent_path();
  ImGui::SameLine();
  if (const char* home = std::getenv("HOME"); home && places_.button("Home", "home")) into = home;
  ImGui::SameLine();
  ImGui::TextUnformatted(folder_.c_str());
  if (ImGui::BeginChild("files", {width, height}, ImGuiChildFlags_Borders)) {
    if (!note_.empty()) draw_wrapped(colour::quiet_text, note_);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(entries_.size()));
    while (clipper.Step())
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        const Entry& entry = entries_[static_cast<std::size_t>(i)];
        const std::string name = entry.path.filename().string() + (entry.is_folder ? "/" : "");
        ImGui::PushID(i);
        const bool chosen = ImGui::Selectable(name.c_str(), !entry.is_folder && entry.path == picked_,
                                              ImGuiSelectableFlags_AllowDoubleClick);
        places_.note(entry.path.filename().string());
        if (!entry.is_folder) {
          ImGui::SameLine(width - 7 * ImGui::GetFontSize());
          ImGui::TextDisabled("%s", size_text(entry.bytes).c_str());
        }
        ImGui::PopID();
        if (!chosen) continue;
        if (entry.is_folder) {
          into = entry.path;
          continue;
        }
        const bool by_key =
            !ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !ImGui::IsMouseDown(ImGuiMouseButton_Left);
        picked_ = entry.path;
        picked = by_key || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) ? Picked::opened : Picked::file;
      }
  }
  ImGui::EndChild();
  if (!into.empty()) go(into);
  return picked;
}

void Dialogs::begin(Workbench& workbench) {
  shown_ = workbench.questions().question();
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
  else
    draw_save(commands);
  if (!open) commands.push_back(command::Ask{Question::none});
  ImGui::EndPopup();
}

void Dialogs::draw_open(Commands& commands) {
  const float em = ImGui::GetFontSize();
  if (choose_name("path of a preset file, or its name", em * 41, name_, "Open", !name_.empty()))
    commands.push_back(command::Open{name_});
  if (!ImGui::BeginTabBar("where")) return;
  if (ImGui::BeginTabItem("Shipped presets")) {
    if (ImGui::BeginChild("shipped", {em * 46, em * 16})) {
      for (const preset::ShippedPreset& shipped : shipped_) {
        if (ImGui::Selectable(shipped.name.c_str())) commands.push_back(command::Open{shipped.file.string()});
        ImGui::SameLine(em * 11);
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
  const float em = ImGui::GetFontSize();
  const FileList::Picked picked = files_.draw(em * 46, em * 14);
  if (picked != FileList::Picked::nothing) name_ = files_.picked().string();
  return picked == FileList::Picked::opened;
}

void Dialogs::draw_open_file(Commands& commands) {
  const DialogKind& kind = kind_of_dialog(shown_);
  const bool typed = choose_name(kind.hint, ImGui::GetFontSize() * 41, name_, "Open", !name_.empty());
  const bool picked = pick_file();
  if (typed || picked) commands.push_back(kind.open(name_));
  ImGui::TextDisabled("%s", kind.note);
}

void Dialogs::draw_save(Commands& commands) {
  std::error_code ignored;
  const bool picture = shown_ == Question::save_picture, report = shown_ == Question::save_report;
  const bool folder = fs::is_directory(name_, ignored), there = !folder && is_there(name_);
  // A file of the list is only named by a click: replacing it takes the button.
  const bool chosen = choose_name("file", ImGui::GetFontSize() * 41, name_, there ? "Replace" : "Save",
                                  !name_.empty() && !folder, there);
  places_.note("save");
  if (chosen)
    commands.push_back(report    ? Command(command::WriteReport{name_})
                       : picture ? Command(command::SavePicture{name_})
                                 : Command(command::SavePreset{name_, keep_parent_ && !parent_.empty()}));
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

void Dialogs::draw_unsaved(const Workbench& workbench, Commands& commands) {
  const std::string then = std::holds_alternative<command::Quit>(*workbench.questions().waiting()) ? "quit" : "open";
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
  if (ImGui::Button(then == "quit" ? "Quit without saving" : "Open without saving"))
    commands.push_back(*workbench.questions().waiting());
  ImGui::SameLine();
  if (places_.button("Cancel", "cancel", "As Escape does: nothing is lost"))
    commands.push_back(command::Ask{Question::none});
}

} // namespace nephroid::ui
