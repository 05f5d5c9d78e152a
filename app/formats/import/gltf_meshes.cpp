// SPDX-License-Identifier: Apache-2.0
#include "formats/import/gltf_scene.h"

#include "base/files.h"
#include "formats/import/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace nephroid::formats {
namespace fs = std::filesystem;
namespace {

/// "a%20b.bin" as the name of a file.
std::string decoded(const std::string& uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char value = 0;
    const char *const digits = uri.data() + i + 1, *const end = digits + 2;
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, end, value, 16).ptr == end;
    name += escaped ? static_cast<char>(value) : uri[i];
    if (escaped) i += 2;
  }
  return name;
}

/// Copies parts of the file into a file of one primitive and numbers them anew.
class Extract {
public:
  Extract(const GltfFile& file, const std::vector<GltfJson>& buffers)
      : root_(file.json, file.where()), buffers_(buffers) {
    for (const char* list : {"accessors", "bufferViews", "buffers"}) made_[list] = GltfJson::array();
  }

  GltfJson of(const GltfValue& primitive) {
    const GltfValue attributes = primitive.object("attributes");
    GltfJson one = GltfJson::object();
    one["mode"] = primitive.count("mode", 4);
    one["attributes"]["POSITION"] = accessor(attributes.index("POSITION", root_, "accessors"), 3);
    if (attributes.has("NORMAL"))
      one["attributes"]["NORMAL"] = accessor(attributes.index("NORMAL", root_, "accessors"), 3);
    if (primitive.has("indices")) one["indices"] = accessor(primitive.index("indices", root_, "accessors"), 1);
    made_["asset"] = {{"version", "2.0"}};
    made_["scene"] = 0;
    // Lists by name: braces about one item may mean the item itself.
    const auto list_of = [](GltfJson item) { return GltfJson::array({std::move(item)}); };
    made_["scenes"] = list_of({{"nodes", list_of(0)}});
    made_["nodes"] = list_of({{"mesh", 0}});
    made_["meshes"] = list_of({{"primitives", list_of(one)}});
    return made_;
  }

private:
  /// width: how many numbers an item has to have.
  std::size_t accessor(std::size_t index, std::size_t width) {
    const GltfValue accessor = root_.item("accessors", index);
    const std::string type = accessor.text("type");
    if (type != (width == 1 ? "SCALAR" : "VEC3"))
      throw bad_input(accessor.where() / "type", "is \"" + type + "\"",
                      width == 1 ? "expected SCALAR" : "expected VEC3");
    const std::size_t component = component_bytes(accessor);
    const std::uint64_t count = accessor.count("count", 0);
    if (count == 0) throw bad_input(accessor.where() / "count", "is 0", "expected at least one item");
    GltfJson copy = accessor.json();
    for (const char* unused : {"extensions", "extras", "name"}) copy.erase(unused);
    if (accessor.has("bufferView")) {
      const GltfValue view = accessor.item("bufferView", root_, "bufferViews");
      const std::uint64_t item = component * width, stride = std::max(view.count("byteStride", item), item);
      const std::uint64_t end = accessor.count("byteOffset", 0) + (count - 1) * stride + item,
                          length = view.count("byteLength", 0);
      if (end > length)
        throw bad_input(accessor.where(),
                        fmt::format("its {} items end at byte {} of a buffer view of {}", count, end, length));
      copy["bufferView"] = add_view(view);
    }
    if (accessor.has("sparse"))
      for (const char* part : {"indices", "values"}) {
        const GltfValue sparse = accessor.object("sparse").object(part);
        copy["sparse"][part]["bufferView"] = add_view(sparse.item("bufferView", root_, "bufferViews"));
      }
    made_["accessors"].push_back(std::move(copy));
    return made_["accessors"].size() - 1;
  }

  static std::size_t component_bytes(const GltfValue& accessor) {
    constexpr std::array<std::size_t, 7> bytes{1, 1, 2, 2, 0, 4, 4}; // types 5120 to 5126
    const std::uint64_t type = accessor.count("componentType", 0);
    if (type < 5120 || type > 5126 || bytes[type - 5120] == 0)
      throw bad_input(accessor.where() / "componentType", "is no type of glTF", "expected 5120 to 5126");
    return bytes[type - 5120];
  }

  std::size_t add_view(const GltfValue& view) {
    const std::size_t buffer = view.index("buffer", root_, "buffers");
    const std::uint64_t end = view.count("byteOffset", 0) + view.count("byteLength", 0),
                        size = buffers_[buffer]["byteLength"].get<std::uint64_t>();
    if (end > size) throw bad_input(view.where(), fmt::format("ends at byte {} of a buffer of {}", end, size));
    GltfJson copy = view.json();
    for (const char* unused : {"extensions", "extras", "name"}) copy.erase(unused);
    copy["buffer"] = made_["buffers"].size();
    made_["buffers"].push_back(buffers_[buffer]);
    made_["bufferViews"].push_back(std::move(copy));
    return made_["bufferViews"].size() - 1;
  }

  GltfValue root_;
  const std::vector<GltfJson>& buffers_;
  GltfJson made_ = GltfJson::object();
};

} // namespace

GltfMeshes::GltfMeshes(const GltfFile& file) : file_(file), folder_(temporary_folder()) {
  try {
    const GltfValue root(file.json, file.where());
    for (const GltfValue& value : root.list("buffers")) buffers_.push_back(buffer(value, buffers_.size()));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw;
  }
}

GltfMeshes::~GltfMeshes() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

/// As the reader finds it in the folder.
GltfJson GltfMeshes::buffer(const GltfValue& value, std::size_t index) const {
  const std::uint64_t length = value.count("byteLength", 0);
  const std::string uri = value.text("uri");
  if (uri.starts_with("data:")) return {{"byteLength", length}, {"uri", uri}};
  const std::string name = fmt::format("buffer{}.bin", index);
  std::uint64_t size = 0;
  if (uri.empty()) {
    if (index != 0 || file_.bin.empty())
      throw bad_input(value.where(), "has no \"uri\", and the file has no binary data for it");
    write_file_whole(folder_ / name, file_.bin);
    size = file_.bin.size();
  } else {
    const fs::path meant = fs::absolute(file_.file).parent_path() / decoded(uri);
    std::error_code error;
    if (!fs::is_regular_file(meant, error))
      throw bad_input(value.where() / "uri", "there is no file '" + meant.string() + "'", {},
                      "put it beside the glTF file");
    size = fs::file_size(meant, error);
    fs::create_symlink(meant, folder_ / name, error);
    if (error) throw failed((folder_ / name).string(), "cannot be made: " + error.message());
  }
  if (size < length)
    throw bad_input(value.where() / "byteLength", fmt::format("is {}, and there are {} bytes", length, size), {},
                    "copy the files again");
  return {{"byteLength", length}, {"uri", name}};
}

scene::Mesh GltfMeshes::read(const GltfValue& primitive) const {
  const GltfJson one = Extract(file_, buffers_).of(primitive);
  const fs::path part = folder_ / "part.gltf";
  write_file_whole(part, one.dump(-1, ' ', false, GltfJson::error_handler_t::replace));
  try {
    return scene::load_mesh(part);
  } catch (const Error& error) {
    if (error.location().name != part.string()) throw;
    throw error.at(primitive.where());
  }
}

} // namespace nephroid::formats
