// SPDX-License-Identifier: Apache-2.0
// The pictures that a report shows, of runs and of their differences.
#include "report/report.h"

#include "base/base64.h"
#include "base/files.h"
#include "image/image.h"
#include "measure/difference.h"
#include "measure/read_picture.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::report {
namespace fs = std::filesystem;
namespace {

using Picture = measure::LinearPicture;
using SharedPicture = std::shared_ptr<const Picture>;

constexpr const char* main_name = "image";

bool have_one_size(const Picture& a, const Picture& b) { return a.width == b.width && a.height == b.height; }

/// image.exr first, there or not, then the others in the order of their names.
std::vector<fs::path> picture_files(const fs::path& folder) {
  std::set<fs::path> others = files_ending(folder, ".exr");
  const fs::path first = folder / fmt::format("{}.exr", main_name);
  others.erase(first);
  std::vector<fs::path> files{first};
  files.insert(files.end(), others.begin(), others.end());
  return files;
}

/// A difference before its colours, which depend on those of the whole group.
struct Difference {
  std::size_t run = 0;
  Json from;
  std::vector<float> map;
};

/// Pictures of one name and size while they come in.
struct Group {
  std::string name;
  std::size_t first_run = 0;
  SharedPicture first; ///< its picture
  Json pictures;
  std::set<std::size_t> references;
  std::vector<Difference> differences;
};

Json picture_json(const char* kind, Json runs, Json from, const std::string& png) {
  return {{"kind", kind}, {"runs", std::move(runs)}, {"from", std::move(from)}, {"png", base64(png)}};
}

class Collector {
public:
  explicit Collector(std::span<const RunFolder> runs) : runs_(runs) {
    for (const RunFolder& run : runs_) result_.reference_of_run.push_back(reference_of(run));
    for (std::size_t run = 0; run < runs_.size(); ++run)
      for (const fs::path& file : picture_files(runs_[run].folder)) add(run, file);
    for (Group& group : groups_) finish(group);
  }
  Pictures result() { return std::move(result_); }

private:
  /// Reads every file once; files with equal pictures are one reference.
  std::optional<std::size_t> reference_of(const RunFolder& run) {
    const fs::path file = run.reference();
    if (file.empty()) return std::nullopt;
    const auto [known, is_new] = reference_files_.try_emplace(file, references_.size());
    if (!is_new) return known->second;
    SharedPicture picture;
    if (is_there(file))
      picture = std::make_shared<Picture>(measure::read_linear_rgb(file));
    else
      result_.notes.push_back(fmt::format("The reference {} is not there any more.", file.string()));
    const auto same = std::find_if(references_.begin(), references_.end(), [&](const SharedPicture& other) {
      return picture && other && have_one_size(*picture, *other) && picture->rgb == other->rgb;
    });
    known->second = static_cast<std::size_t>(same - references_.begin());
    if (same == references_.end()) references_.push_back(picture);
    return known->second;
  }

  void add(std::size_t run, const fs::path& file) {
    if (!is_there(file)) {
      result_.notes.push_back(fmt::format("{} is missing.", file.string()));
      return;
    }
    const auto picture = std::make_shared<const Picture>(measure::read_linear_rgb(file));
    Group& group = group_of(run, file.stem().string(), picture);
    group.pictures.push_back(picture_json("run", {run}, {}, png(*picture, run)));
    const auto index = group.name == main_name ? result_.reference_of_run[run] : std::nullopt;
    if (index && references_[*index] && have_one_size(*references_[*index], *picture)) {
      group.references.insert(*index);
      add_difference(group, run, {}, *picture, *references_[*index]);
    } else if (run != group.first_run) {
      add_difference(group, run, group.first_run, *picture, *group.first);
    }
  }

  Group& group_of(std::size_t run, const std::string& name, const SharedPicture& picture) {
    for (Group& group : groups_)
      if (group.name == name && have_one_size(*group.first, *picture)) return group;
    return groups_.emplace_back(Group{name, run, picture, Json::array(), {}, {}});
  }

  static void add_difference(Group& group, std::size_t run, Json from, const Picture& picture, const Picture& other) {
    group.differences.push_back(
        {run, std::move(from),
         measure::difference_map(picture.pixels(), other.pixels(), measure::DifferenceMetric::lab)});
  }

  std::string png(const Picture& picture, std::size_t run) const {
    return image::png(picture.width, picture.height, picture.rgb,
                      image::showing_of(runs_[run].display, 0, picture.rgb));
  }

  void finish(Group& group) {
    const int width = group.first->width, height = group.first->height;
    for (const std::size_t reference : group.references) {
      Json runs = Json::array();
      for (std::size_t run = 0; run < runs_.size(); ++run)
        if (result_.reference_of_run[run] == reference) runs.push_back(run);
      const std::size_t first = runs.front();
      group.pictures.push_back(picture_json("reference", std::move(runs), {}, png(*references_[reference], first)));
    }
    double scale = 0;
    for (const Difference& difference : group.differences)
      scale = std::max(scale, measure::colour_scale(difference.map));
    for (const Difference& difference : group.differences) {
      std::vector<unsigned char> bytes;
      for (const float value : difference.map)
        for (const unsigned char channel : measure::map_colour(value / scale)) bytes.push_back(channel);
      group.pictures.push_back(
          picture_json("difference", {difference.run}, difference.from, image::png_of_bytes(width, height, bytes)));
    }
    result_.groups.push_back({{"name", group.name},
                              {"width", width},
                              {"height", height},
                              {"scale", scale},
                              {"pictures", std::move(group.pictures)}});
  }

  std::span<const RunFolder> runs_;
  std::vector<SharedPicture> references_; ///< null: the file is gone
  std::map<fs::path, std::size_t> reference_files_;
  std::vector<Group> groups_;
  Pictures result_;
};

} // namespace

Pictures read_pictures(std::span<const RunFolder> runs) { return Collector(runs).result(); }

} // namespace nephroid::report
