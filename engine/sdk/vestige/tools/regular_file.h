// SPDX-License-Identifier: Apache-2.0
// Files that end. Opening a pipe or reading a file of /proc may wait for ever, so such files are
// refused before they are opened.
#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace vestige {

/// The reason why a file must not be opened, as the end of a sentence that begins with its name:
/// "is a folder"; "" if it is a regular file.
inline std::string whyNotRegular(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (!fs::exists(status)) return "does not exist";
  if (fs::is_directory(status)) return "is a folder, not a file";
  if (!fs::is_regular_file(status)) return "is a pipe or a device, not a file";
  // Linux gives these files the size 0, and some of them never end.
  const bool isEmpty = fs::file_size(path, failed) == 0;
  const bool isSystem = isEmpty && fs::canonical(path, failed).string().rfind("/proc/", 0) == 0;
  return isSystem ? "is a file of the system without a size" : "";
}

/// Opens a regular file for reading. Otherwise the stream has failed, with the reason in `why`.
inline std::ifstream openRegular(const std::string& path, std::string& why) {
  std::ifstream in;
  why = whyNotRegular(path);
  if (!why.empty()) {
    in.setstate(std::ios::failbit);
    return in;
  }
  in.open(path, std::ios::binary);
  if (!in) why = "may not be read by this user";
  return in;
}

/// The bytes that a regular file has now; nothing, with the reason in `why`, if they are more than
/// `most` or cannot be read. A file that grows meanwhile is read no further.
inline std::optional<std::string> readRegular(const std::string& path, std::uintmax_t most,
                                              std::string& why) {
  std::ifstream in = openRegular(path, why);
  if (!in) return std::nullopt;
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  if (failed || size > most) {
    why = failed ? "cannot be read" : "is larger than " + std::to_string(most >> 20) + " MB";
    return std::nullopt;
  }
  std::string text(std::size_t(size), '\0');
  in.read(text.data(), std::streamsize(size));
  text.resize(std::size_t(in.gcount()));
  if (!in.bad()) return text;
  why = "cannot be read";
  return std::nullopt;
}

}  // namespace vestige
