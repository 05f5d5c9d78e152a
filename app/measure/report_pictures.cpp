// SPDX-License-Identifier: Apache-2.0
#include "measure/report_pictures.h"

#include "base/files.h"
#include "image/image.h"
#include "measure/difference.h"
#include "measure/read_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

namespace nephroid::measure {
namespace fs = std::filesystem;
namespace {

using SharedPicture = std::shared_ptr<const LinearPicture>;

bool have_one_size(const LinearPicture& a, const LinearPicture& b) { return a.width == b.width && a.height == b.height; }

/// A difference before its colours, which depend on those of the whole group.
struct Difference {
  std::size_t run = 0;
  std::optional<std::size_t> from;
  std::vector<float> map;
};

/// A group while it grows.
struct Collected {
  PictureGroup group;
  std::vector<std::size_t> references;
  std::vector<Difference> differences;
  std::size_t first_run = 0;
  SharedPicture first; ///< its picture
};

class Collector {
public:
  explicit Collector(std::span<const RunSummary> runs) : runs_(runs) {}

  ReportPictures collect()
  {
    for (std::size_t run = 0; run < runs_.size(); ++run) result_.reference_of_run.push_back(reference_of(run));
    for (std::size_t run = 0; run < runs_.size(); ++run) add_run(run);
    for (Collected& collected : collected_) result_.groups.push_back(finished(collected));
    return std::move(result_);
  }

private:
  /// Reads every file once; files with equal pictures are one reference.
  std::optional<std::size_t> reference_of(std::size_t run)
  {
    if (!runs_[run].reference) return std::nullopt;
    const fs::path file = runs_[run].reference->origin;
    const auto known = reference_files_.find(file);
    if (known != reference_files_.end()) return known->second;
    SharedPicture picture;
    if (is_there(file))
      picture = std::make_shared<LinearPicture>(read_linear_rgb(file));
    else
      result_.notes.push_back(fmt::format("The reference {} is not there any more.", file.string()));
    const auto same = std::find_if(references_.begin(), references_.end(), [&](const SharedPicture& other) {
      return picture && other && have_one_size(*picture, *other) && picture->rgb == other->rgb;
    });
    const auto index = static_cast<std::size_t>(same - references_.begin());
    if (same == references_.end()) references_.push_back(picture);
    reference_files_[file] = index;
    return index;
  }

  void add_run(std::size_t run)
  {
    const fs::path file = runs_[run].folder / "image.exr";
    if (!is_there(file)) {
      result_.notes.push_back(fmt::format("{} is missing.", file.string()));
      return;
    }
    const auto picture = std::make_shared<const LinearPicture>(read_linear_rgb(file));
    Collected& collected = group_of(run, picture);
    collected.group.pictures.push_back(
        {ReportPicture::Kind::run, run, std::nullopt, image::png(picture->width, picture->height, picture->rgb), {}});
    add_difference(collected, run, *picture);
  }

  Collected& group_of(std::size_t run, const SharedPicture& picture)
  {
    for (Collected& collected : collected_)
      if (have_one_size(*collected.first, *picture)) return collected;
    Collected& fresh = collected_.emplace_back();
    fresh.group.width = picture->width;
    fresh.group.height = picture->height;
    fresh.first_run = run;
    fresh.first = picture;
    return fresh;
  }

  void add_difference(Collected& collected, std::size_t run, const LinearPicture& picture)
  {
    const auto index = result_.reference_of_run[run];
    const SharedPicture reference = index ? references_[*index] : nullptr;
    if (reference && have_one_size(*reference, picture)) {
      if (std::find(collected.references.begin(), collected.references.end(), *index) == collected.references.end())
        collected.references.push_back(*index);
      collected.differences.push_back({run, std::nullopt, map_of(picture, *reference)});
    } else if (run != collected.first_run) {
      collected.differences.push_back({run, collected.first_run, map_of(picture, *collected.first)});
    }
  }

  static std::vector<float> map_of(const LinearPicture& picture, const LinearPicture& other)
  {
    return difference_map(picture.pixels(), other.pixels(), DifferenceMetric::lab);
  }

  PictureGroup finished(Collected& collected) const
  {
    PictureGroup group = std::move(collected.group);
    for (const std::size_t reference : collected.references)
      group.pictures.push_back({ReportPicture::Kind::reference, std::nullopt, std::nullopt,
                                image::png(group.width, group.height, references_[reference]->rgb), runs_of(reference)});
    for (const Difference& difference : collected.differences)
      group.difference_scale = std::max(group.difference_scale, colour_scale(difference.map));
    for (const Difference& difference : collected.differences)
      group.pictures.push_back({ReportPicture::Kind::difference, difference.run, difference.from, coloured(group, difference.map), {}});
    return group;
  }

  std::vector<std::size_t> runs_of(std::size_t reference) const
  {
    std::vector<std::size_t> runs;
    for (std::size_t run = 0; run < runs_.size(); ++run)
      if (result_.reference_of_run[run] == reference) runs.push_back(run);
    return runs;
  }

  static std::string coloured(const PictureGroup& group, const std::vector<float>& map)
  {
    std::vector<unsigned char> bytes;
    bytes.reserve(3 * map.size());
    for (const float value : map)
      for (const unsigned char channel : map_colour(value / group.difference_scale)) bytes.push_back(channel);
    return image::png_of_bytes(group.width, group.height, bytes);
  }

  std::span<const RunSummary> runs_;
  std::vector<SharedPicture> references_; ///< null: the file is gone
  std::map<fs::path, std::size_t> reference_files_;
  std::vector<Collected> collected_;
  ReportPictures result_;
};

} // namespace

ReportPictures read_pictures(std::span<const RunSummary> runs) { return Collector(runs).collect(); }

} // namespace nephroid::measure
