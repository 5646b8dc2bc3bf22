// SPDX-License-Identifier: Apache-2.0
#include "engine/files/fingerprint.h"

#include <fmt/format.h>
#include <OpenImageIO/hash.h>

#include <fstream>
#include <vector>

namespace vestige {

std::string fingerprint(const void* bytes, std::size_t count) {
  using namespace OIIO::farmhash;
  const auto code = Fingerprint128(static_cast<const char*>(bytes), count);
  return fmt::format("{:016x}{:016x}", Uint128High64(code), Uint128Low64(code));
}

std::string fileFingerprint(const std::string& file) {
  // A hash of the hashes of its pieces: the hash function needs all bytes at once, and the file may
  // be large.
  constexpr std::size_t kPiece = 1 << 20;
  std::ifstream in(file, std::ios::binary);
  std::vector<char> piece(kPiece);
  std::string codes;
  while (in) {
    in.read(piece.data(), std::streamsize(kPiece));
    codes += fingerprint(piece.data(), std::size_t(in.gcount()));
  }
  return in.eof() ? fingerprint(codes.data(), codes.size()) : "";
}

}  // namespace vestige
