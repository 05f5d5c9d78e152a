// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

#include "base/bytes.h"
#include "base/files.h"
#include "image/seam.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <dlfcn.h>
#include <exception>
#include <functional>
#include <span>
#include <string_view>

namespace nephroid::image {
namespace fs = std::filesystem;
namespace {

struct Module {
  NephroidRead read = nullptr;
  NephroidReadBands read_bands = nullptr;
  NephroidEncode encode = nullptr;
  NephroidText text = nullptr;
};

Module load_module() {
  const fs::path file = library_file(module_name);
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library)
    throw failed(file.string(), fmt::format("cannot be loaded: {}", ::dlerror()), {}, "install OpenImageIO");
  return {reinterpret_cast<NephroidRead>(::dlsym(library, read_symbol)),
          reinterpret_cast<NephroidReadBands>(::dlsym(library, read_bands_symbol)),
          reinterpret_cast<NephroidEncode>(::dlsym(library, encode_symbol)),
          reinterpret_cast<NephroidText>(::dlsym(library, text_symbol))};
}

/// Loaded at the first call, from whatever thread, and kept.
const Module& module() {
  static const Module loaded = load_module();
  return loaded;
}

void check_size(const std::string& name, int width, int height, std::size_t channels, std::size_t values) {
  const auto wanted = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels;
  if (width > 0 && height > 0 && channels > 0 && values == wanted) return;
  throw failed(name,
               fmt::format("a picture of {} x {} with {} channels has {} values", width, height, channels, values));
}

/// name: what a message calls the picture. use(bytes) is called with the encoded file, which is gone afterwards: large
/// pictures are not copied once more.
void encode(const std::string& name, const NephroidPicture& picture, const std::function<void(std::string_view)>& use) {
  struct Call {
    const std::function<void(std::string_view)>& use;
    std::exception_ptr thrown; ///< must not cross the seam
  } call{use, nullptr};
  const auto take = [](void* to, const void* data, std::size_t size) {
    Call& taking = *static_cast<Call*>(to);
    try {
      taking.use({static_cast<const char*>(data), size});
    } catch (...) {
      taking.thrown = std::current_exception();
    }
  };
  if (const char* reason = module().encode(&picture, take, &call))
    throw failed(name, fmt::format("cannot be encoded: {}", reason));
  if (call.thrown) std::rethrow_exception(call.thrown);
}

std::vector<const char*> pointers(const std::vector<std::string>& names) {
  std::vector<const char*> result;
  for (const std::string& name : names) result.push_back(name.c_str());
  return result;
}

void encode_exr(const std::string& name, const Image& image, const std::function<void(std::string_view)>& use) {
  check_size(name, image.width, image.height, image.channels.size(), image.data.size());
  const std::vector<const char*> channels = pointers(image.channels);
  std::vector<NephroidAttribute> attributes;
  for (const auto& [key, value] : image.attributes) attributes.push_back({key.c_str(), value.c_str()});
  encode(name,
         {image.width, image.height, static_cast<int>(channels.size()), channels.data(), image.data.data(), nullptr,
          attributes.data(), attributes.size()},
         use);
}

/// Entry i is the linear value halfway between the codes i and i + 1: the code of a value is the number of entries not
/// above it. The same as rounding the encoding, without a power a pixel.
std::array<float, 255> code_thresholds() {
  std::array<float, 255> thresholds{};
  for (std::size_t i = 0; i < thresholds.size(); ++i)
    thresholds[i] = static_cast<float>(decoded_srgb((static_cast<double>(i) + 0.5) / 255));
  return thresholds;
}

/// A PNG without its last chunk. libpng prints a line of its own about that, so it is not asked.
bool is_cut_png(const fs::path& file) {
  constexpr std::uint64_t piece = 1 << 20;
  const std::unique_ptr<ByteSource> source = open_file(file);
  std::string bytes;
  for (bool first = true; source->left() > 0; first = false) {
    bytes.erase(0, bytes.size() - std::min<std::size_t>(bytes.size(), 3)); // a name may be cut in two
    const std::size_t kept = bytes.size();
    bytes.resize(kept + std::min(source->left(), piece));
    source->read(std::as_writable_bytes(std::span(bytes).subspan(kept)));
    if (first && !bytes.starts_with("\x89PNG\r\n\x1a\n")) return false;
    if (bytes.find("IEND") != std::string::npos) return false;
  }
  return !bytes.empty();
}

std::string png_picture(const std::string& name, int width, int height, int channels,
                        const std::vector<unsigned char>& bytes) {
  check_size(name, width, height, static_cast<std::size_t>(channels), bytes.size());
  const char* const names[] = {"R", "G", "B", "A"};
  std::string file;
  encode(name, {width, height, channels, names, nullptr, bytes.data(), nullptr, 0},
         [&](std::string_view encoded) { file = encoded; });
  return file;
}

std::vector<unsigned char> shown_bytes(const std::vector<float>& rgb, double exposure_stops) {
  const auto scale = static_cast<float>(std::exp2(exposure_stops));
  std::vector<unsigned char> bytes(rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) bytes[i] = shown(rgb[i], scale);
  return bytes;
}

/// Where R, G and B are among the channels; all three at Y where the picture is grey.
struct Layout {
  std::array<std::size_t, 3> at{};
  bool grey = false;
};

Layout layout_of(const Image& picture, const std::string& name) {
  const auto& channels = picture.channels;
  const auto index = [&](const char* channel) {
    return static_cast<std::size_t>(std::ranges::find(channels, channel) - channels.begin());
  };
  const Layout colour{{index("R"), index("G"), index("B")}, false};
  if (std::ranges::all_of(colour.at, [&](std::size_t i) { return i < channels.size(); })) return colour;
  const std::size_t y = index("Y");
  if (y < channels.size() && std::ranges::all_of(channels, [](const std::string& c) { return c == "Y" || c == "A"; }))
    return {{y, y, y}, true};
  throw bad_input(name, fmt::format("has the channels {}", fmt::join(channels, ", ")), "expected R, G, B or Y alone");
}

/// What the module hands over, as a copy of our own.
void copy_picture(const NephroidPicture* picture, Image& result) {
  result.width = picture->width;
  result.height = picture->height;
  result.channels.assign(picture->channels, picture->channels + picture->channel_count);
  const auto pixels = static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height);
  result.data.assign(picture->floats, picture->floats + pixels * result.channels.size());
  result.integers = picture->integers;
  for (std::size_t i = 0; i < picture->attribute_count; ++i)
    result.attributes[picture->attributes[i].name] = picture->attributes[i].value;
}

/// to: an Image.
void take_picture(void* to, const NephroidPicture* picture) { copy_picture(picture, *static_cast<Image*>(to)); }

/// read(): null or OpenImageIO's reason. Reading the file says what is wrong with itself, OpenImageIO what is wrong
/// with the picture.
template <class Read>
void read_or_refuse(const fs::path& file, const Read& read) {
  const char* const reason = is_cut_png(file) ? "its end is missing" : read();
  if (reason)
    throw bad_input(file.string(), fmt::format("is no picture that can be read: {}", reason),
                    "expected a whole EXR, HDR, PNG, JPEG or another picture that OpenImageIO reads",
                    "save it anew, or name another file");
}

} // namespace

Image read_image(const fs::path& file) {
  Image image;
  read_or_refuse(file, [&] { return module().read(file.c_str(), take_picture, &image); });
  return image;
}

void read_bands(const fs::path& file, const std::function<void(const Band&)>& use) {
  struct Call {
    const std::function<void(const Band&)>& use;
    Band band;
    std::exception_ptr thrown; ///< must not cross the seam
  } call{use, {}, nullptr};
  const auto take = [](void* to, const NephroidBand* lent) {
    Call& taking = *static_cast<Call*>(to);
    try {
      copy_picture(&lent->picture, taking.band.rows);
      taking.band.first = lent->first;
      taking.band.height = lent->height;
      taking.band.orientation = lent->orientation;
      taking.use(taking.band);
    } catch (...) {
      taking.thrown = std::current_exception();
    }
    return !taking.thrown;
  };
  read_or_refuse(file, [&] { return module().read_bands(file.c_str(), take, &call); });
  if (call.thrown) std::rethrow_exception(call.thrown);
}

Image text_picture(const std::string& text, int height, const Place& where) {
  constexpr const char *font = "DejaVuSans-Bold", *file = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
  Image image;
  // OpenImageIO 2.5 finds no name in Debian's folders of fonts.
  if (const char* reason = module().text(text.c_str(), height, fs::exists(file) ? file : font, take_picture, &image))
    throw bad_input(where, fmt::format("\"{}\" cannot be drawn with the font {}: {}", text, font, reason),
                    "expected words, and the fonts of Debian's fonts-dejavu-core",
                    "install them, or draw a picture file");
  return image;
}

Rgb rgb_of(const Image& picture, const std::string& name) {
  const Layout layout = layout_of(picture, name);
  const std::size_t stride = picture.channels.size(), pixels = picture.data.size() / stride;
  Rgb rgb{std::vector<float>(3 * pixels), layout.grey};
  for (std::size_t p = 0; p < pixels; ++p)
    for (std::size_t c = 0; c < 3; ++c) rgb.values[3 * p + c] = picture.data[p * stride + layout.at[c]];
  return rgb;
}

void write_exr(const fs::path& file, const Image& image) {
  encode_exr(file.string(), image, [&](std::string_view encoded) { write_file_whole(file, encoded); });
}

void write_exr(ByteSink& to, const Image& image) {
  encode_exr("EXR", image, [&](std::string_view encoded) { to.write(std::as_bytes(std::span(encoded))); });
}

void write_png16(ByteSink& to, int width, int height, const std::vector<std::uint16_t>& grey,
                 const std::string& description) {
  check_size("PNG", width, height, 1, grey.size());
  const char* const channel = "Y";
  const NephroidAttribute attribute{"ImageDescription", description.c_str()};
  encode("PNG", {width, height, 1, &channel, nullptr, nullptr, &attribute, 1, true, grey.data()},
         [&](std::string_view encoded) { to.write(std::as_bytes(std::span(encoded))); });
}

void write_png(const fs::path& file, int width, int height, const std::vector<float>& rgb, double exposure_stops) {
  write_file_whole(file, png_picture(file.string(), width, height, 3, shown_bytes(rgb, exposure_stops)));
}

void write_png_bytes(const fs::path& file, int width, int height, const std::vector<unsigned char>& rgba8) {
  write_file_whole(file, png_picture(file.string(), width, height, 4, rgba8));
}

std::string png(int width, int height, const std::vector<float>& rgb, double exposure_stops) {
  return png_picture("PNG", width, height, 3, shown_bytes(rgb, exposure_stops));
}

std::string png_of_bytes(int width, int height, const std::vector<unsigned char>& rgb8) {
  return png_picture("PNG", width, height, 3, rgb8);
}

double decoded_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

unsigned char shown(float linear, float exposure_scale) {
  static const std::array<float, 255> thresholds = code_thresholds();
  const float value = linear * exposure_scale;
  if (std::isnan(value)) return 0;
  return static_cast<unsigned char>(std::ranges::upper_bound(thresholds, value) - thresholds.begin());
}

} // namespace nephroid::image
