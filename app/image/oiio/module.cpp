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
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace OIIO;

/// Where the words of a failed call live until the thread's next one.
thread_local std::string kept_reason;

const char* reason(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  if (text.empty()) return "OpenImageIO gives no reason";
  kept_reason = std::move(text);
  return kept_reason.c_str();
}

/// Whether something of the picture is missing, such as a JPEG's end, whose pixels are grey then. Bytes too many
/// harm nothing.
bool is_damaged(const ImageInput& input, bool done) {
  return !done || (input.has_error() && input.geterror(false).find("extraneous bytes") == std::string::npos);
}

/// Exceptions (out of memory, or from a file that lies about its size) must not cross the C seam.
template <class Call>
const char* guarded(Call call) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    return "not enough memory for this picture";
  } catch (const std::exception& error) {
    return reason(error.what());
  }
}

/// Every attribute as text, so that what write stores as strings comes back as it was.
std::vector<std::pair<std::string, std::string>> texts_of(const ImageSpec& spec) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const ParamValue& value : spec.extra_attribs)
    if (value.type() == TypeString) texts.emplace_back(value.name().string(), value.get_string());
  return texts;
}

/// The largest picture that is read: 2 GiB of floats, such as 16384 x 8192 pixels of four channels. A file can say that
/// it has more than any memory.
constexpr int most_values_log2 = 29;
/// The same of one that is read in bands: what a minute reads.
constexpr int most_band_values_log2 = 32;
/// The values of a band: 16 MiB.
constexpr std::size_t band_values = std::size_t{1} << 22;

std::size_t values_of(const ImageSpec& spec) { return spec.image_pixels() * static_cast<std::size_t>(spec.nchannels); }

/// Opens it as `input`. Null, or the reason why it is not read.
const char* open(const char* file, int most_log2, std::unique_ptr<ImageInput>& input) {
  ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1); // else OpenImageIO multiplies the colours of a PNG by its alpha
  input = ImageInput::open(file, &wishes);
  if (!input) return reason(geterror());
  const ImageSpec& spec = input->spec();
  if (spec.depth > 1) return "it is a volume, not a picture";
  if (values_of(spec) > std::size_t{1} << most_log2)
    return reason("it has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels of " +
                  std::to_string(spec.nchannels) + " channels, and at most 2^" + std::to_string(most_log2) +
                  " values are read");
  return nullptr;
}

std::vector<const char*> channels_of(const ImageSpec& spec) {
  std::vector<const char*> channels;
  for (const std::string& name : spec.channelnames) channels.push_back(name.c_str());
  return channels;
}

const char* read(const char* file, void (*take)(void*, const NephroidPicture*), void* context) {
  std::unique_ptr<ImageInput> input;
  if (const char* why = open(file, most_values_log2, input)) return why;
  const ImageSpec& spec = input->spec();
  const std::size_t values = values_of(spec);
  std::vector<float> floats(values);
  const bool done = input->read_image(0, 0, 0, spec.nchannels, TypeFloat, floats.data());
  if (is_damaged(*input, done)) return reason(input->geterror());
  int width = spec.width, height = spec.height;
  if (const int orientation = spec.get_int_attribute("Orientation", 1);
      orientation != 1) { // as a camera was held (Exif)
    ImageSpec own(spec.width, spec.height, spec.nchannels, TypeFloat);
    own.attribute("Orientation", orientation);
    const ImageBuf upright = ImageBufAlgo::reorient(ImageBuf(own, floats.data()));
    std::vector<float> turned(values);
    if (!upright.get_pixels(upright.roi(), TypeFloat, turned.data())) return reason(upright.geterror());
    floats.swap(turned);
    width = upright.spec().width;
    height = upright.spec().height;
  }
  const std::vector<const char*> channels = channels_of(spec);
  const auto texts = texts_of(spec);
  std::vector<NephroidAttribute> attributes;
  for (const auto& [name, value] : texts) attributes.push_back({name.c_str(), value.c_str()});
  const NephroidPicture picture{width,
                                height,
                                spec.nchannels,
                                channels.data(),
                                floats.data(),
                                nullptr,
                                attributes.data(),
                                attributes.size(),
                                !spec.format.is_floating_point()};
  take(context, &picture);
  return nullptr;
}

const char* read_bands(const char* file, bool (*take)(void*, const NephroidBand*), void* context) {
  std::unique_ptr<ImageInput> input;
  if (const char* why = open(file, most_band_values_log2, input)) return why;
  const ImageSpec& spec = input->spec();
  const std::vector<const char*> channels = channels_of(spec);
  const std::size_t row = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
  int rows = static_cast<int>(std::max<std::size_t>(1, band_values / row));
  if (spec.tile_width > 0) rows = std::max(1, rows / spec.tile_height) * spec.tile_height; // tiles are read whole
  std::vector<float> floats;
  for (int first = 0; first < spec.height; first += rows) {
    const int count = std::min(rows, spec.height - first), begin = spec.y + first, end = begin + count;
    floats.resize(row * static_cast<std::size_t>(count));
    const bool done = spec.tile_width > 0 ? input->read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z,
                                                              spec.z + 1, 0, spec.nchannels, TypeFloat, floats.data())
                                          : input->read_scanlines(0, 0, begin, end, spec.z, 0, spec.nchannels,
                                                                  TypeFloat, floats.data());
    if (is_damaged(*input, done)) return reason(input->geterror());
    const NephroidBand band{{spec.width, count, spec.nchannels, channels.data(), floats.data(), nullptr, nullptr, 0,
                             !spec.format.is_floating_point()},
                            first,
                            spec.height,
                            spec.get_int_attribute("Orientation", 1)};
    if (!take(context, &band)) return nullptr;
  }
  return nullptr;
}

TypeDesc type_of(const NephroidPicture& picture) {
  return picture.floats ? TypeFloat : picture.words ? TypeUInt16 : TypeUInt8;
}

ImageSpec spec_of(const NephroidPicture& picture) {
  ImageSpec spec(picture.width, picture.height, picture.channel_count, type_of(picture));
  spec.channelnames.assign(picture.channels, picture.channels + picture.channel_count);
  if (picture.floats) {
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", ""); // else OpenImageIO writes the time of day, and no two files would be equal
  }
  for (std::size_t i = 0; i < picture.attribute_count; ++i)
    spec.attribute(picture.attributes[i].name, picture.attributes[i].value);
  return spec;
}

const char* encode(const NephroidPicture& picture, std::vector<unsigned char>& bytes) {
  const char* const format = picture.floats ? "exr" : "png"; // a bare extension names a format
  const auto output = ImageOutput::create(format);
  if (!output) return reason(geterror());
  // Seldom more than as many bytes as the picture has: growing would copy them, and hold both for a while.
  const std::size_t values = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) *
                             static_cast<std::size_t>(picture.channel_count);
  bytes.reserve(values * type_of(picture).size() + 65536);
  Filesystem::IOVecOutput memory(bytes);
  if (!output->set_ioproxy(&memory)) return "this OpenImageIO cannot write to memory";
  const void* const pixels = picture.floats  ? static_cast<const void*>(picture.floats)
                             : picture.words ? static_cast<const void*>(picture.words)
                                             : picture.bytes;
  if (!output->open(std::string("picture.") + format, spec_of(picture)) ||
      !output->write_image(type_of(picture), pixels) || !output->close())
    return reason(output->geterror());
  return nullptr;
}

const char* text(const char* words, int height, const char* font, void (*take)(void*, const NephroidPicture*),
                 void* context) {
  const ROI box = ImageBufAlgo::text_size(words, height, font);
  if (!box.defined()) return "no font of this name is found";
  if (box.width() < 1 || box.height() < 1) return "it has no letters";
  ImageBuf drawn(ImageSpec(box.width(), box.height(), 1, TypeFloat));
  ImageBufAlgo::zero(drawn);
  if (!ImageBufAlgo::render_text(drawn, -box.xbegin, -box.ybegin, words, height, font)) return reason(drawn.geterror());
  std::vector<float> floats(drawn.spec().image_pixels());
  if (!drawn.get_pixels(drawn.roi(), TypeFloat, floats.data())) return reason(drawn.geterror());
  const char* const channel = "Y";
  const NephroidPicture picture{box.width(), box.height(), 1, &channel, floats.data(), nullptr, nullptr, 0};
  take(context, &picture);
  return nullptr;
}

} // namespace

extern "C" {

[[gnu::visibility("default")]] const char*
nephroid_image_read(const char* file, void (*take)(void*, const NephroidPicture*), void* context) {
  return guarded([&] { return read(file, take, context); });
}

[[gnu::visibility("default")]] const char*
nephroid_image_read_bands(const char* file, bool (*take)(void*, const NephroidBand*), void* context) {
  return guarded([&] { return read_bands(file, take, context); });
}

[[gnu::visibility("default")]] const char*
nephroid_image_encode(const NephroidPicture* picture, void (*take)(void*, const void*, std::size_t), void* context) {
  return guarded([&] {
    std::vector<unsigned char> bytes;
    const char* const why = encode(*picture, bytes);
    if (!why) take(context, bytes.data(), bytes.size());
    return why;
  });
}

[[gnu::visibility("default")]] const char* nephroid_image_text(const char* words, int height, const char* font,
                                                               void (*take)(void*, const NephroidPicture*),
                                                               void* context) {
  return guarded([&] { return text(words, height, font, take, context); });
}
}
