// SPDX-License-Identifier: Apache-2.0
// A small JPEG file, which nothing here can write: 48 x 48 greys in squares.
#pragma once
#include <string>
#include <string_view>

namespace nephroid::test {

inline std::string jpeg() {
  constexpr std::string_view hexadecimal =
      "ffd8ffe000104a46494600010100000100010000ffdb00430050373c463c32504641465a55505f78c882786e6e78f5afb991c8ffffffffff"
      "ffff"
      "ffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffc0000b080030003001011100ffc400190001010101010100"
      "0000"
      "00000000000000030204000105ffc4002810000104010204060300000000000000000100020311211231324151610413223381a14271b1ff"
      "da00"
      "08010100003f00c805148dc9a483be12376b482af7483baf9fa49d9701e57a9db6d85e9903baad308b8c10a8465a7562864aa3234f22b2d7"
      "3e8a"
      "243a87ca3e1ef6b7f8617037e7fa91ceb69c7243c3953a45e5508984d11f6a878788fe1f65679657c3218e33a5836156bcf3a4bcbbe9507b"
      "89a2"
      "53d1ad974634bbd5815b948e703590b14fef38a26b4870c1ab4ae7022ac2db5cd4c9968fda3e1dd13c5bc90a5c4169ae887872765fffd9";
  std::string bytes;
  for (std::size_t i = 0; i < hexadecimal.size(); i += 2)
    bytes.push_back(static_cast<char>(std::stoi(std::string(hexadecimal.substr(i, 2)), nullptr, 16)));
  return bytes;
}

} // namespace nephroid::test
