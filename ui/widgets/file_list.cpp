// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/file_list.h"

#include "base/lower_case.h"
#include "plan/plan.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace nephroid::ui {

namespace fs = std::filesystem;
constexpr std::size_t most_entries = 5000;

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
  folder_ = fs::absolute(folder.empty() ? fs::current_path(ignored) : folder, ignored).lexically_normal();
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
    draw_rows_in_sight(entries_.size(), [&](std::size_t i) {
      const Entry& entry = entries_[i];
      const std::string name = entry.path.filename().string() + (entry.is_folder ? "/" : "");
      ImGui::PushID(static_cast<int>(i));
      const bool chosen = ImGui::Selectable(name.c_str(), !entry.is_folder && entry.path == picked_,
                                            ImGuiSelectableFlags_AllowDoubleClick);
      places_.note(entry.path.filename().string());
      if (!entry.is_folder) {
        ImGui::SameLine(width - 7 * em());
        ImGui::TextDisabled("%s", plan::readable_bytes(entry.bytes).c_str());
      }
      ImGui::PopID();
      if (!chosen) return;
      if (entry.is_folder) {
        into = entry.path;
        return;
      }
      const bool by_key = !ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !ImGui::IsMouseDown(ImGuiMouseButton_Left);
      picked_ = entry.path;
      picked = by_key || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) ? Picked::opened : Picked::file;
    });
  }
  ImGui::EndChild();
  if (!into.empty()) go(into);
  return picked;
}

} // namespace nephroid::ui
