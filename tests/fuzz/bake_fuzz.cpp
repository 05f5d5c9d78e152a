// SPDX-License-Identifier: Apache-2.0
// Bakes from the folder of caches: the input is a file but for the hash at its end; its key and version are put right.
#include "base/build_info.h"
#include "base/files.h"
#include "base/hashed_bytes.h"
#include "environment/bake/bake.h"
#include "tests/fuzz/harness.h"

namespace nephroid::fuzz {
namespace {

constexpr environment::BakeIdentity identity{.key = 7, .kernels = 9};

std::string hashed(std::string bytes) {
  PieceHash hash;
  hash.add(std::as_bytes(std::span(bytes)));
  const std::uint64_t value = hash.value();
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

} // namespace

void read(std::string_view input) {
  std::string bytes(input);
  const std::uint64_t begin[] = {5, hash_of(version()), identity.kernels,
                                 identity.key}; // after the file's eight letters
  if (bytes.size() > 8 + sizeof begin) std::memcpy(bytes.data() + 8, begin, sizeof begin);
  const fs::path file = write("fuzz.bake", hashed(bytes));
  environment::bake_file_fault(file, identity);
  const environment::Bake bake = environment::read_bake(file, identity);
  if (bake.baked.empty() || bake.radii.empty()) finding("a bake of nothing");
  if (bake.directions.size() < bake.baked.size()) finding("a bake of more directions than there are");
  bake.at(bake.baked.size() - 1, bake.radii.size() - 1, bake.map.texels() - 1);
}

std::vector<std::string> seeds() {
  environment::Bake bake;
  bake.map.side = 2;
  bake.radii = {1, 2};
  bake.directions = environment::light_directions(26);
  bake.resize(26);
  environment::write_bake(folder() / "seed.bake", identity, bake);
  const std::string file = read_file(folder() / "seed.bake");
  return {file.substr(0, file.size() - sizeof(std::uint64_t))};
}

} // namespace nephroid::fuzz
