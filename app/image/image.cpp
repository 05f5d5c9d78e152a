// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

#include "base/files.h"
#include "image/primaries.h"
#include "image/radiance.h"
#include "image/seam.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <dlfcn.h>
#include <span>

namespace nephroid::image {
namespace fs = std::filesystem;
namespace {

const Module* load_module() {
  const fs::path file = library_file(module_name);
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library)
    throw failed(file.string(), fmt::format("cannot be loaded: {}", ::dlerror()), {}, "install OpenImageIO");
  return reinterpret_cast<const Module* (*)()>(::dlsym(library, module_symbol))();
}

/// Loaded at the first call, from whatever thread, and kept.
const Module& module() {
  static const Module* const loaded = load_module();
  return *loaded;
}

/// The bytes of the file. name: what a message calls the picture. values: how many there are.
std::vector<unsigned char> encoded(const std::string& name, const Samples& picture, std::size_t values) {
  const std::size_t channels = picture.channels.size();
  const auto wanted = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * channels;
  if (picture.width <= 0 || picture.height <= 0 || channels == 0 || values != wanted)
    throw failed(name, fmt::format("a picture of {} x {} with {} channels has {} values", picture.width, picture.height,
                                   channels, values));
  try {
    return module().encode(picture);
  } catch (const Refused& refused) {
    throw failed(name, "cannot be encoded: " + refused.reason);
  }
}

void encode_exr(const std::string& name, const Image& image, ByteSink& to) {
  const auto bytes = encoded(name, {image.width, image.height, image.channels, image.attributes, image.data.data()},
                             image.data.size());
  to.write(std::as_bytes(std::span(bytes)));
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

std::string png_picture(const std::string& name, int width, int height, std::size_t channels,
                        const std::vector<unsigned char>& bytes) {
  std::vector<std::string> names{"R", "G", "B", "A"};
  names.resize(channels);
  const auto file = encoded(name, {width, height, names, {}, nullptr, bytes.data()}, bytes.size());
  return {file.begin(), file.end()};
}

std::vector<unsigned char> shown_bytes(const std::vector<float>& rgb, const Showing& showing) {
  std::vector<unsigned char> bytes(rgb.size());
  show(rgb, showing, bytes);
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

void turn_upright(Image& image, const PixelOrder& order) {
  if (order == PixelOrder{}) return;
  const auto columns = static_cast<std::size_t>(image.width), rows = static_cast<std::size_t>(image.height),
             stride = image.channels.size();
  std::vector<float> turned(image.data.size());
  for (std::size_t v = 0; v < rows; ++v)
    for (std::size_t u = 0; u < columns; ++u) {
      const std::size_t along = order.columns_back ? columns - 1 - u : u, down = order.rows_back ? rows - 1 - v : v;
      const std::size_t pixel = order.transposed ? along * rows + down : down * columns + along;
      for (std::size_t c = 0; c < stride; ++c) turned[pixel * stride + c] = image.data[(v * columns + u) * stride + c];
    }
  image.data.swap(turned);
  if (order.transposed) std::swap(image.width, image.height);
}

/// Linear values of 65536 encoded ones: integers have 8 or 16 bits.
std::vector<float> decoding_table(double gamma) {
  std::vector<float> table(65536);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double encoded = static_cast<double>(i) / static_cast<double>(table.size() - 1);
    table[i] = static_cast<float>(gamma == 0 ? decoded_srgb(encoded) : std::pow(encoded, gamma));
  }
  return table;
}

void decode(std::vector<float>& values, double gamma) {
  static const std::vector<float> of_srgb = decoding_table(0);
  const std::vector<float> own = gamma == 0 ? std::vector<float>() : decoding_table(gamma);
  const std::vector<float>& table = gamma == 0 ? of_srgb : own;
  const auto last = static_cast<float>(table.size() - 1);
  for (float& value : values)
    value = table[static_cast<std::size_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * last))];
}

/// Reading the file says what is wrong with itself, OpenImageIO what is wrong with the picture.
template <class Read>
auto read_or_refuse(const fs::path& file, const Read& read) {
  try {
    if (is_cut_png(file)) throw Refused{"its end is missing"};
    return read();
  } catch (const Refused& refused) {
    throw bad_input(file.string(), "is no picture that can be read: " + refused.reason,
                    "expected a whole EXR, HDR, PNG, JPEG or another picture that OpenImageIO reads",
                    "save it anew, or name another file");
  }
}

} // namespace

PixelOrder mirrored(PixelOrder order) {
  bool& along_x = order.transposed ? order.rows_back : order.columns_back;
  along_x = !along_x;
  return order;
}

PixelOrder turned_left(PixelOrder order) {
  order = mirrored(order);
  order.transposed = !order.transposed;
  return order;
}

void read_bands(const fs::path& file, const std::function<void(const Band&)>& use) {
  read_or_refuse(file, [&] { is_radiance(file) ? read_radiance(file, use) : module().read_bands(file, use); });
}

Image read_image(const fs::path& file) {
  constexpr int most_values_log2 = 29; // 2 GiB of floats, such as 16384 x 8192 pixels of four channels
  Image image;
  PixelOrder order;
  read_bands(file, [&](const Band& band) {
    const Image& rows = band.rows;
    if (band.first == 0) {
      require_at_most(most_values_log2, rows.width, band.height, rows.channels.size());
      image = rows;
      image.height = band.height;
      order = band.order;
      image.data.reserve(rows.data.size() / static_cast<std::size_t>(rows.height) *
                         static_cast<std::size_t>(band.height));
    } else {
      image.data.insert(image.data.end(), rows.data.begin(), rows.data.end());
    }
  });
  turn_upright(image, order);
  return image;
}

Image text_picture(const std::string& text, int height, const Location& where) {
  constexpr const char *font = "DejaVuSans-Bold", *file = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
  try {
    // OpenImageIO 2.5 finds no name in Debian's folders of fonts.
    return module().text(text, height, fs::exists(file) ? file : font);
  } catch (const Refused& refused) {
    throw bad_input(where, fmt::format("\"{}\" cannot be drawn with the font {}: {}", text, font, refused.reason),
                    "expected words, and the fonts of Debian's fonts-dejavu-core",
                    "install them, or draw a picture file");
  }
}

Rgb rgb_of(const Image& picture, const std::string& name) {
  const Layout layout = layout_of(picture, name);
  const std::size_t stride = picture.channels.size(), pixels = picture.data.size() / stride;
  const auto alpha = static_cast<std::size_t>(std::ranges::find(picture.channels, "A") - picture.channels.begin());
  Rgb rgb{std::vector<float>(3 * pixels), {}, layout.grey};
  for (std::size_t p = 0; p < pixels; ++p) {
    for (std::size_t c = 0; c < 3; ++c) rgb.values[3 * p + c] = picture.data[p * stride + layout.at[c]];
    if (alpha < stride) rgb.alpha.push_back(picture.data[p * stride + alpha]);
  }
  if (picture.integers && !picture.profile.empty())
    module().apply_profile(picture.profile, rgb.values);
  else if (picture.integers)
    decode(rgb.values, picture.gamma);
  if (picture.chromaticities && !layout.grey) {
    const std::optional<glm::dmat3> to_srgb = matrix_to_srgb(*picture.chromaticities);
    if (!to_srgb)
      throw bad_input(name, fmt::format("has the chromaticities {}", fmt::join(*picture.chromaticities, ", ")),
                      "expected x and y of red, green, blue and white, three of which make the fourth");
    convert(rgb.values, *to_srgb);
  }
  return rgb;
}

void write_exr(const fs::path& file, const Image& image) {
  write_file_whole(file, [&](ByteSink& to) { encode_exr(file.string(), image, to); });
}

void write_exr(ByteSink& to, const Image& image) { encode_exr("EXR", image, to); }

void write_png16(ByteSink& to, int width, int height, const std::vector<std::uint16_t>& grey,
                 const std::string& description) {
  const auto bytes = encoded(
      "PNG", {width, height, {"Y"}, {{"ImageDescription", description}}, nullptr, nullptr, grey.data()}, grey.size());
  to.write(std::as_bytes(std::span(bytes)));
}

void write_png(const fs::path& file, int width, int height, const std::vector<float>& rgb, const Showing& showing) {
  write_file_whole(file, png_picture(file.string(), width, height, 3, shown_bytes(rgb, showing)));
}

void write_png_bytes(const fs::path& file, int width, int height, const std::vector<unsigned char>& rgba8) {
  write_file_whole(file, png_picture(file.string(), width, height, 4, rgba8));
}

std::string png(int width, int height, const std::vector<float>& rgb, const Showing& showing) {
  return png_picture("PNG", width, height, 3, shown_bytes(rgb, showing));
}

std::string png_of_bytes(int width, int height, const std::vector<unsigned char>& rgb8) {
  return png_picture("PNG", width, height, 3, rgb8);
}

double decoded_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace nephroid::image
