// SPDX-License-Identifier: Apache-2.0
// The only file that includes OpenImageIO: decodes any picture it knows, encodes EXR and PNG in
// memory, with the same bytes for the same input, draws text. Nothing is written to disk here.
#include "image/seam.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
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

/// The largest picture that is read: 2 GiB of floats, such as 16384 x 8192 pixels of four channels. A file can say that
/// it has more than any memory.
constexpr int most_values_log2 = 29;
/// The same of one that is read in bands: what a minute reads.
constexpr int most_band_values_log2 = 32;
/// The values of a band: 16 MiB.
constexpr std::size_t band_values = std::size_t{1} << 22;

std::size_t values_of(const ImageSpec& spec) { return spec.image_pixels() * static_cast<std::size_t>(spec.nchannels); }

std::unique_ptr<ImageInput> open(const std::string& file, int most_log2) {
  ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1); // else OpenImageIO multiplies the colours of a PNG by its alpha
  std::unique_ptr<ImageInput> input = ImageInput::open(file, &wishes);
  if (!input) throw refused(geterror());
  const ImageSpec& spec = input->spec();
  if (spec.depth > 1) throw refused("it is a volume, not a picture");
  if (values_of(spec) > std::size_t{1} << most_log2)
    throw refused("it has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels of " +
                  std::to_string(spec.nchannels) + " channels, and at most 2^" + std::to_string(most_log2) +
                  " values are read");
  return input;
}

/// Turns the picture upright, where its camera was held otherwise (Exif).
void reorient(Image& image, int orientation) {
  if (orientation == 1) return;
  ImageSpec own(image.width, image.height, static_cast<int>(image.channels.size()), TypeFloat);
  own.attribute("Orientation", orientation);
  const ImageBuf upright = ImageBufAlgo::reorient(ImageBuf(own, image.data.data()));
  std::vector<float> turned(image.data.size());
  if (!upright.get_pixels(upright.roi(), TypeFloat, turned.data())) throw refused(upright.geterror());
  image.data.swap(turned);
  image.width = upright.spec().width;
  image.height = upright.spec().height;
}

/// A picture of this size, without its data.
Image image_of(const ImageSpec& spec, int height) {
  return {.width = spec.width,
          .height = height,
          .channels = spec.channelnames,
          .data = {},
          .attributes = {},
          .integers = !spec.format.is_floating_point()};
}

Image read(const std::string& file) {
  return guarded([&] {
    const std::unique_ptr<ImageInput> input = open(file, most_values_log2);
    const ImageSpec& spec = input->spec();
    Image image = image_of(spec, spec.height);
    image.data.resize(values_of(spec));
    require_whole(*input, input->read_image(0, 0, 0, spec.nchannels, TypeFloat, image.data.data()));
    for (const ParamValue& value : spec.extra_attribs)
      if (value.type() == TypeString) image.attributes[value.name().string()] = value.get_string();
    reorient(image, spec.get_int_attribute("Orientation", 1));
    return image;
  });
}

void read_rows(ImageInput& input, int first, Image& rows) {
  const ImageSpec& spec = input.spec();
  const int begin = spec.y + first, end = begin + rows.height;
  rows.data.resize(static_cast<std::size_t>(rows.width) * static_cast<std::size_t>(rows.height) * rows.channels.size());
  require_whole(input,
                spec.tile_width > 0
                    ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, 0,
                                       spec.nchannels, TypeFloat, rows.data.data())
                    : input.read_scanlines(0, 0, begin, end, spec.z, 0, spec.nchannels, TypeFloat, rows.data.data()));
}

void read_bands(const std::string& file, const std::function<void(const Band&)>& use) {
  const auto input = guarded([&] { return open(file, most_band_values_log2); });
  const ImageSpec& spec = input->spec();
  const std::size_t row = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
  int rows = static_cast<int>(std::max<std::size_t>(1, band_values / row));
  if (spec.tile_width > 0) rows = std::max(1, rows / spec.tile_height) * spec.tile_height; // tiles are read whole
  Band band{image_of(spec, rows), 0, spec.height, spec.get_int_attribute("Orientation", 1)};
  for (; band.first < spec.height; band.first += rows) {
    band.rows.height = std::min(rows, spec.height - band.first);
    guarded([&] { read_rows(*input, band.first, band.rows); });
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
  static constexpr Module module{read, read_bands, encode, text};
  return &module;
}
