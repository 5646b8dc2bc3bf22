// SPDX-License-Identifier: Apache-2.0
#include "engine/files/file_stamp.h"

#include <filesystem>

namespace vestige {

FileStamp stampOf(const std::string& file) {
  std::error_code failed;
  FileStamp stamp;
  const auto written = std::filesystem::last_write_time(file, failed);
  if (!failed) stamp.written = written.time_since_epoch().count();
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (!failed) stamp.size = std::int64_t(size);
  return stamp;
}

}  // namespace vestige
