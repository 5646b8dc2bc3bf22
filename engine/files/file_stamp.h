// SPDX-License-Identifier: Apache-2.0
// Time and size of a file, to detect changes since it was read.
#pragma once
#include <cstdint>
#include <string>

namespace vestige {

/// Time of the last change and size. A file that was changed without either is taken as the same.
struct FileStamp {
  std::int64_t written = 0;  ///< in ticks of the file system's clock
  std::int64_t size = -1;    ///< bytes; -1: there is no such file
  bool operator==(const FileStamp&) const = default;
};
FileStamp stampOf(const std::string& file);

}  // namespace vestige
