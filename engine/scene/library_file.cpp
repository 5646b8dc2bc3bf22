// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/library_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <fstream>

#include <vestige/tools/regular_file.h>

namespace vestige {
namespace {

// The first bytes of a 64-bit ELF file, and a row of its table of segments [System V ABI, ch. 4-5].
struct Header {
  unsigned char ident[16];
  std::uint16_t type, machine;
  std::uint32_t version;
  std::uint64_t entry, segments, sections;
  std::uint32_t flags;
  std::uint16_t size, segmentSize, segmentCount, sectionSize, sectionCount, names;
};
struct Segment {
  std::uint32_t type, flags;
  std::uint64_t offset, address, physical, fileSize, memorySize, alignment;
};
static_assert(sizeof(Header) == 64 && sizeof(Segment) == 56);

constexpr std::uint32_t kLoaded = 1;  // PT_LOAD
constexpr unsigned char k64Bit = 2;   // ELFCLASS64

template <class T>
bool readAt(std::ifstream& in, std::uint64_t offset, T& value) {
  in.seekg(std::streamoff(offset));
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  return bool(in);
}

}  // namespace

std::string cutShort(const std::string& file) {
  std::string why;
  std::ifstream in = openRegular(file, why);
  in.seekg(0, std::ios::end);
  const std::uint64_t size = in ? std::uint64_t(in.tellg()) : 0;
  Header header;
  if (size < sizeof header || !readAt(in, 0, header)) return "";
  if (std::memcmp(header.ident,
                  "\x7f"
                  "ELF",
                  4) != 0 ||
      header.ident[4] != k64Bit)
    return "";
  std::uint64_t needed = 0;
  for (unsigned i = 0; i < header.segmentCount; ++i) {
    const std::uint64_t row = header.segments + std::uint64_t(i) * header.segmentSize;
    needed = std::max(needed, row + sizeof(Segment));
    Segment segment;
    if (needed > size || !readAt(in, row, segment)) break;
    if (segment.type == kLoaded) needed = std::max(needed, segment.offset + segment.fileSize);
  }
  if (needed <= size) return "";
  return fmt::format("it is cut short: {} bytes, of at least {}", size, needed);
}

}  // namespace vestige
