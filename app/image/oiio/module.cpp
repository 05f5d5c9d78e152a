// SPDX-License-Identifier: Apache-2.0
// The only file that includes OpenImageIO: decodes any picture it knows, encodes EXR and PNG in
// memory, with the same bytes for the same input, draws text. Nothing is written to disk here.
#include "image/oiio/profile.h"
#include "image/seam.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <new>

namespace nephroid::image {
namespace {

using namespace OIIO;

Refused refused(std::string reason) {
  while (!reason.empty() && (reason.back() == '\n' || reason.back() == '\r')) reason.pop_back();
  return {reason.empty() ? "OpenImageIO gives no reason" : std::move(reason)};
}

/// Files that lie about their size make OpenImageIO throw.
template <class Call>
auto guarded(const Call& call) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    throw refused("not enough memory for this picture");
  } catch (const std::exception& error) {
    throw refused(error.what());
  }
}

/// Throws where something of the picture is missing, such as a JPEG's end, whose pixels are grey then. Bytes too many
/// harm nothing.
void require_whole(const ImageInput& input, bool done) {
  if (!done || (input.has_error() && input.geterror(false).find("extraneous bytes") == std::string::npos))
    throw refused(input.geterror());
}

/// The first part of a file (EXR; pages of a TIFF, frames of a GIF) that has colours or grey, or else the first.
int picture_part(ImageInput& input) {
  constexpr int most_parts = 1000;
  const auto has = [&](const char* channel) { return input.spec().channelindex(channel) >= 0; };
  for (int part = 0; part < most_parts && input.seek_subimage(part, 0); ++part)
    if ((has("R") && has("G") && has("B")) || has("Y")) return part;
  return 0;
}

/// Photoshop's first part is the picture that its layers make: it counts as one.
bool has_several_parts(ImageInput& input) {
  const ImageSpec& spec = input.spec();
  const std::string_view format = input.format_name();
  const bool unsaid = format == "tiff" || format == "gif" || format == "ico"; // tried: a WebP does not go back
  return spec.get_int_attribute("oiio:subimages") > 1 || spec.get_int_attribute("oiio:Movie") ||
         (unsaid && input.seek_subimage(1, 0));
}

std::unique_ptr<ImageInput> open(const std::string& file, Image& header) {
  ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1); // else OpenImageIO multiplies the colours of a PNG by its alpha
  std::unique_ptr<ImageInput> input = ImageInput::open(file, &wishes);
  if (!input) throw refused(geterror());
  const int part = picture_part(*input);
  const bool several = has_several_parts(*input);
  input->geterror(); // of parts that are not there
  if (!input->seek_subimage(part, 0)) throw refused(input->geterror());
  const ImageSpec& spec = input->spec();
  if (spec.depth > 1) throw refused("it is a volume, not a picture");
  if (spec.deep) throw refused("it is a deep picture, with several samples a pixel, and only flat ones are read");
  require_at_most(most_band_values_log2, spec.width, spec.height, static_cast<std::size_t>(spec.nchannels));
  const std::string name(spec.get_string_attribute("oiio:subimagename"));
  if (several)
    header.notes.push_back("it has several parts, pages or frames; " +
                           (name.empty() ? "number " + std::to_string(part + 1) : "'" + name + "'") +
                           " is taken alone");
  return input;
}

/// What colours are multiplied by: nothing (straight), alpha; or there is no alpha, in spite of a channel of that name.
enum class Alpha { straight, associated, none };

/// OpenImageIO says in an attribute that it left colours as they were, but for some formats.
Alpha alpha_of(const ImageInput& input) {
  const ImageSpec& spec = input.spec();
  const std::string_view format = input.format_name();
  if (spec.get_int_attribute("oiio:UnassociatedAlpha")) return Alpha::straight;
  constexpr int targa_premultiplied = 4;
  if (format == "targa")
    return spec.get_int_attribute("targa:alpha_type") == targa_premultiplied ? Alpha::associated : Alpha::none;
  constexpr int first_with_alpha = 4; // of BMP's headers; the fourth byte of earlier ones is not used
  if (format == "bmp") return spec.get_int_attribute("bmp:version") >= first_with_alpha ? Alpha::straight : Alpha::none;
  return format == "ico" || format == "dds" || format == "jpeg2000" ? Alpha::straight : Alpha::associated;
}

/// Makes the rows what Image says: integers not multiplied by alpha, floats multiplied.
void arrange_alpha(const ImageInput& input, Image& rows) {
  const auto at = static_cast<std::size_t>(std::ranges::find(rows.channels, "A") - rows.channels.begin());
  const std::size_t stride = rows.channels.size();
  const Alpha alpha = alpha_of(input);
  if (at == stride || alpha == (rows.integers ? Alpha::straight : Alpha::associated)) return;
  for (std::size_t first = 0; first < rows.data.size(); first += stride) {
    float& a = rows.data[first + at];
    if (alpha == Alpha::none) a = 1;
    for (std::size_t c = 0; c < stride; ++c) {
      if (c == at) continue;
      float& value = rows.data[first + c];
      if (rows.integers && a > 0) value = std::min(1.0f, value / a);
      if (!rows.integers) value *= a;
    }
  }
}

void add_colours(const ImageSpec& spec, Image& header) {
  const float gamma = spec.get_float_attribute("oiio:Gamma");
  const std::string space(spec.get_string_attribute("oiio:ColorSpace"));
  if (header.integers) header.gamma = gamma > 0 ? double(gamma) : Strutil::iequals(space, "linear") ? 1 : 0;
  if (space == "KodakLog") header.notes.push_back("its values are densities of a film; they are taken as sRGB's");
  if (const ParamValue* const said = spec.find_attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8))) {
    Chromaticities& chromaticities = header.chromaticities.emplace();
    std::copy_n(static_cast<const float*>(said->data()), chromaticities.size(), chromaticities.begin());
  }
  header.white_cd_m2 = double(spec.get_float_attribute("whiteLuminance"));
  const std::string profile(spec.get_string_attribute("ICCProfile:profile_description"));
  const ParamValue* const icc = spec.find_attribute("ICCProfile");
  if (!icc) return;
  std::string bytes(static_cast<const char*>(icc->data()), icc->type().size());
  const ProfileUse use = profile_use(bytes, spec.nchannels < 3);
  if (use == ProfileUse::other && header.integers)
    header.profile = std::move(bytes);
  else if (use != ProfileUse::srgb || !header.integers)
    header.notes.push_back("its colour profile" + (profile.empty() ? "" : " '" + profile + "'") +
                           " is not obeyed; its colours are taken as " + (header.integers ? "sRGB's" : "linear sRGB"));
}

/// The orientation that Exif has: a TIFF, whose first directory is a list of tags.
int exif_orientation(std::string_view exif) {
  constexpr std::uint32_t orientation = 274, short_number = 3;
  if (exif.starts_with("Exif")) exif.remove_prefix(std::min<std::size_t>(6, exif.size())); // as in a JPEG
  const bool little = exif.starts_with("II");
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      if (const std::size_t byte = at + (little ? size - 1 - i : i); byte < exif.size())
        value = value << 8 | static_cast<unsigned char>(exif[byte]);
    return value;
  };
  const std::size_t directory = number(4, 4), tags = number(directory, 2);
  for (std::size_t i = 0; i < tags; ++i)
    if (const std::size_t tag = directory + 2 + 12 * i;
        number(tag, 2) == orientation && number(tag + 2, 2) == short_number)
      return static_cast<int>(number(tag + 8, 2));
  return 1;
}

/// OpenImageIO leaves out a WebP's profile, and takes its Exif for that of a JPEG, which begins with six bytes more.
void add_webp_chunks(const std::string& file, ImageSpec& spec) {
  std::ifstream from(file, std::ios::binary);
  constexpr std::streamoff first_chunk = 12, most_bytes = 1 << 24;
  std::array<unsigned char, 8> head{};
  for (std::streamoff at = first_chunk; from.seekg(at) && from.read(reinterpret_cast<char*>(head.data()), 8);) {
    const std::streamoff size = head[4] | head[5] << 8 | head[6] << 16 | std::streamoff{head[7]} << 24;
    const std::string_view name(reinterpret_cast<const char*>(head.data()), 4);
    if ((name == "EXIF" || name == "ICCP") && size <= most_bytes) {
      std::string bytes(static_cast<std::size_t>(size), '\0');
      from.read(bytes.data(), size);
      if (name == "EXIF") spec.attribute("Orientation", exif_orientation(bytes));
      if (name == "ICCP") spec.attribute("ICCProfile", TypeDesc(TypeDesc::UINT8, static_cast<int>(size)), bytes.data());
    }
    at += 8 + size + size % 2;
  }
}

/// Whether a PNG has a chunk of this name before its pixels. OpenImageIO says nothing of a profile that is damaged.
bool png_has(const std::string& file, std::string_view chunk) {
  std::ifstream from(file, std::ios::binary);
  constexpr std::streamoff first_chunk = 8;
  std::array<unsigned char, 8> head{};
  for (std::streamoff at = first_chunk; from.seekg(at) && from.read(reinterpret_cast<char*>(head.data()), 8);) {
    const std::string_view name(reinterpret_cast<const char*>(&head[4]), 4);
    if (name == chunk) return true;
    if (name == "IDAT") return false;
    at += 12 + (std::streamoff{head[0]} << 24 | head[1] << 16 | head[2] << 8 | head[3]);
  }
  return false;
}

/// The picture's size, and where the first pixel of the file's data lies in it: a display window, which EXR has.
struct Frame {
  int width, height, left = 0, top = 0;
};

Frame frame_of(const ImageInput& input) {
  const ImageSpec& spec = input.spec();
  if (std::string_view(input.format_name()) != "openexr") return {spec.width, spec.height};
  const Frame frame{spec.full_width, spec.full_height, spec.x - spec.full_x, spec.y - spec.full_y};
  if (frame.width < 1 || frame.height < 1) throw refused("its display window is empty");
  if (frame.left >= frame.width || frame.top >= frame.height || frame.left + spec.width <= 0 ||
      frame.top + spec.height <= 0)
    throw refused("its data window lies beside its display window");
  require_at_most(most_band_values_log2, frame.width, frame.height, static_cast<std::size_t>(spec.nchannels));
  return frame;
}

/// Rows of the file's data, as it has them.
std::vector<float> data_rows(ImageInput& input, int begin, int end) {
  const ImageSpec& spec = input.spec();
  std::vector<float> data(static_cast<std::size_t>(end - begin) * static_cast<std::size_t>(spec.width) *
                          static_cast<std::size_t>(spec.nchannels));
  const int first = spec.y + begin, last = spec.y + end;
  require_whole(input, spec.tile_width > 0
                           ? input.read_tiles(input.current_subimage(), 0, spec.x, spec.x + spec.width, first, last,
                                              spec.z, spec.z + 1, 0, spec.nchannels, TypeFloat, data.data())
                           : input.read_scanlines(input.current_subimage(), 0, first, last, spec.z, 0, spec.nchannels,
                                                  TypeFloat, data.data()));
  return data;
}

/// Fills the rows from `first` on, of the picture. What the file has no data of is 0.
void read_rows(ImageInput& input, const Frame& frame, int first, Image& rows) {
  const ImageSpec& spec = input.spec();
  const int tile = std::max(1, spec.tile_height); // tiles are read whole
  const int begin = std::max(0, first - frame.top), end = std::min(spec.height, first - frame.top + rows.height);
  const auto values = [&](int pixels) { return static_cast<std::ptrdiff_t>(pixels) * spec.nchannels; };
  rows.data.assign(static_cast<std::size_t>(values(rows.width)) * static_cast<std::size_t>(rows.height), 0);
  if (begin >= end) return;
  const int read = begin / tile * tile;
  const std::vector<float> data = data_rows(input, read, std::min(spec.height, (end + tile - 1) / tile * tile));
  const int left = std::max(0, frame.left), right = std::min(frame.width, frame.left + spec.width);
  for (int row = begin; row < end; ++row)
    std::copy_n(data.begin() + (row - read) * values(spec.width) + values(left - frame.left), values(right - left),
                rows.data.begin() + (row + frame.top - first) * values(rows.width) + values(left));
  arrange_alpha(input, rows);
}

void read_bands(const std::string& file, const std::function<void(const Band&)>& use) {
  Band band;
  Image& rows = band.rows;
  Frame frame{};
  const auto input = guarded([&] {
    auto opened = open(file, rows);
    ImageSpec spec = opened->spec();
    if (std::string_view(opened->format_name()) == "webp") add_webp_chunks(file, spec);
    rows.channels = spec.channelnames;
    rows.integers = !spec.format.is_floating_point();
    add_colours(spec, rows);
    if (std::string_view(opened->format_name()) == "png" && !spec.find_attribute("ICCProfile") && png_has(file, "iCCP"))
      rows.notes.push_back("its colour profile cannot be read; its colours are taken as sRGB's");
    for (const ParamValue& value : spec.extra_attribs)
      if (value.type() == TypeString) rows.attributes[value.name().string()] = value.get_string();
    band.order = pixel_order(spec.get_int_attribute("Orientation", 1));
    band.pixel_aspect = double(spec.get_float_attribute("PixelAspectRatio", 1));
    frame = frame_of(*opened);
    return opened;
  });
  rows.width = frame.width;
  band.height = frame.height;
  const int tile = std::max(1, input->spec().tile_height);
  const int most = std::max(1, rows_of_band(frame.width, rows.channels.size()) / tile) * tile;
  for (; band.first < frame.height; band.first += rows.height) {
    rows.height = std::min(most, frame.height - band.first);
    guarded([&] { read_rows(*input, frame, band.first, rows); });
    use(band);
  }
}

TypeDesc type_of(const Samples& picture) { return picture.floats ? TypeFloat : picture.words ? TypeUInt16 : TypeUInt8; }

ImageSpec spec_of(const Samples& picture) {
  ImageSpec spec(picture.width, picture.height, static_cast<int>(picture.channels.size()), type_of(picture));
  spec.channelnames = picture.channels;
  if (picture.floats) {
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", ""); // else OpenImageIO writes the time of day, and no two files would be equal
  }
  for (const auto& [name, value] : picture.attributes) spec.attribute(name, value);
  return spec;
}

std::vector<unsigned char> encode(const Samples& picture) {
  return guarded([&] {
    const std::string format = picture.floats ? "exr" : "png"; // a bare extension names a format
    const auto output = ImageOutput::create(format);
    if (!output) throw refused(geterror());
    const ImageSpec spec = spec_of(picture);
    std::vector<unsigned char> bytes;
    // Seldom more than as many bytes as the picture has: growing would copy them, and hold both for a while.
    bytes.reserve(spec.image_bytes() + 65536);
    Filesystem::IOVecOutput memory(bytes);
    if (!output->set_ioproxy(&memory)) throw refused("this OpenImageIO cannot write to memory");
    const void* const pixels = picture.floats  ? static_cast<const void*>(picture.floats)
                               : picture.words ? static_cast<const void*>(picture.words)
                                               : picture.bytes;
    if (!output->open("picture." + format, spec) || !output->write_image(spec.format, pixels) || !output->close())
      throw refused(output->geterror());
    return bytes;
  });
}

Image text(const std::string& words, int height, const std::string& font) {
  return guarded([&]() -> Image {
    const ROI box = ImageBufAlgo::text_size(words, height, font);
    if (!box.defined()) throw refused("no font of this name is found");
    if (box.width() < 1 || box.height() < 1) throw refused("it has no letters");
    ImageBuf drawn(ImageSpec(box.width(), box.height(), 1, TypeFloat));
    ImageBufAlgo::zero(drawn);
    Image image{.width = box.width(),
                .height = box.height(),
                .channels = {"Y"},
                .data = std::vector<float>(drawn.spec().image_pixels()),
                .attributes = {}};
    if (!ImageBufAlgo::render_text(drawn, -box.xbegin, -box.ybegin, words, height, font) ||
        !drawn.get_pixels(drawn.roi(), TypeFloat, image.data.data()))
      throw refused(drawn.geterror());
    return image;
  });
}

} // namespace
} // namespace nephroid::image

extern "C" [[gnu::visibility("default")]] const nephroid::image::Module* nephroid_image_module() {
  using namespace nephroid::image;
  static constexpr Module module{read_bands, encode, text, apply_profile};
  return &module;
}
