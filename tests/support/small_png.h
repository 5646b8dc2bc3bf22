// SPDX-License-Identifier: Apache-2.0
// A PNG writer of one page that knows no library of ours: its deflate stream is stored, not packed.
#pragma once
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace vestige::test {

namespace png {

inline void put32(std::string& s, std::uint32_t x) {
  for (int shift = 24; shift >= 0; shift -= 8) s += char(x >> shift & 255);
}

inline std::uint32_t crc(const std::string& s) {
  std::uint32_t c = 0xffffffffu;
  for (const unsigned char byte : s) {
    c ^= byte;
    for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
  }
  return ~c;
}

inline std::string chunk(const std::string& type, const std::string& data) {
  std::string s;
  put32(s, std::uint32_t(data.size()));
  s += type + data;
  put32(s, crc(type + data));
  return s;
}

/// At most 65535 bytes: one stored block.
inline std::string zlib(const std::string& data) {
  const auto n = std::uint16_t(data.size());
  std::string s = {char(0x78),     char(0x01),         char(1), char(n & 255), char(n >> 8),
                   char(~n & 255), char(~n >> 8 & 255)};
  s += data;
  std::uint32_t a = 1, b = 0;
  for (const unsigned char byte : data) a = (a + byte) % 65521, b = (b + a) % 65521;
  put32(s, b << 16 | a);
  return s;
}

}  // namespace png

/// `codes` row by row from the top, 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; 8 or 16 bits.
/// `gamma`: 0 none, else a gAMA chunk saying that light = code ^ gamma.
inline void writePng(const std::string& file, int width, int height, int channels, int bits,
                     const std::vector<int>& codes, double gamma = 0) {
  std::string header, raw;
  png::put32(header, std::uint32_t(width)), png::put32(header, std::uint32_t(height));
  header += {char(bits),
             char(channels == 1   ? 0
                  : channels == 2 ? 4
                  : channels == 3 ? 2
                                  : 6),
             0, 0, 0};
  const int row = width * channels;
  for (int i = 0; i < row * height; ++i) {
    if (i % row == 0) raw += char(0);  // no filter
    if (bits == 16) raw += char(codes[std::size_t(i)] >> 8 & 255);
    raw += char(codes[std::size_t(i)] & 255);
  }
  std::string gama;
  png::put32(gama, gamma > 0 ? std::uint32_t(100000 / gamma + 0.5) : 0);
  std::ofstream(file, std::ios::binary)
      << "\x89PNG\r\n\x1a\n"
      << png::chunk("IHDR", header) << (gamma > 0 ? png::chunk("gAMA", gama) : "")
      << png::chunk("IDAT", png::zlib(raw)) << png::chunk("IEND", "");
}

}  // namespace vestige::test
