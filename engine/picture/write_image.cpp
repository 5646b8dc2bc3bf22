// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>

#include "engine/picture/encode.h"
#include "engine/picture/image.h"

namespace vestige {

namespace fs = std::filesystem;

namespace {

PictureKind kindOf(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".exr") return PictureKind::exr;
  if (ending == ".hdr") return PictureKind::hdr;
  if (ending == ".tif" || ending == ".tiff") return PictureKind::tiff;
  if (ending == ".png") return PictureKind::png;
  if (ending == ".jpg" || ending == ".jpeg") return PictureKind::jpeg;
  return PictureKind::none;
}

/// The file itself where the name is a link to it: the rename must not replace the link.
fs::path resolved(const std::string& file) {
  std::error_code code;
  const fs::path real = fs::canonical(file, code);
  return code ? fs::path(file) : real;
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

bool checkImage(const Image& image, std::string& error) {
  const bool fits =
      image.width > 0 && image.height > 0 && !image.channels.empty() &&
      image.pixels.size() == std::size_t(image.width) * image.height * image.channels.size();
  if (!fits) error = "the picture to write has no pixels";
  return fits;
}

/// errno in the user's words.
std::string systemsReason(int code) {
  if (code == ENOSPC || code == EDQUOT) return "the disk is full";
  if (code == EFBIG) return "the file would grow beyond what the system allows";
  return std::strerror(code);
}

/// All bytes, and on the disk before this returns: 0, or errno.
int writeBytes(const fs::path& file, const std::vector<unsigned char>& bytes) {
  const int fd = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0) return errno;
  int code = 0;
  for (std::size_t done = 0; done < bytes.size() && code == 0;) {
    const ssize_t n = write(fd, &bytes[done], bytes.size() - done);
    if (n > 0)
      done += std::size_t(n);
    else if (n == 0 || errno != EINTR)
      code = n == 0 ? ENOSPC : errno;
  }
  if (code == 0 && fsync(fd) != 0 && errno != EINVAL) code = errno;  // EINVAL: cannot be synced
  if (close(fd) != 0 && code == 0 && errno != EINTR) code = errno;
  return code;
}

/// Writes beside the target, then renames: readers see the old file or the new one.
int replaceFile(const fs::path& target, const std::vector<unsigned char>& bytes) {
  const fs::path draft = folderOf(target) / fmt::format(".vestige-{}.part", getpid());
  std::error_code error, ignored;
  int code = writeBytes(draft, bytes);
  if (code == 0) fs::rename(draft, target, error), code = error.value();
  if (code != 0) fs::remove(draft, ignored);
  return code;
}

}  // namespace

bool canWrite(const std::string& file, std::string& error) {
  error.clear();
  const fs::path path = resolved(file), folder = folderOf(path);
  std::error_code code;
  if (kindOf(path) == PictureKind::none)
    error = fmt::format(
        "cannot write '{}': the ending says which format; .exr .hdr .tif .png and "
        ".jpg are known",
        file);
  else if (!fs::exists(folder, code))
    error = fmt::format("cannot write '{}': there is no folder '{}'", file, folder.string());
  else if (!fs::is_directory(folder, code))
    error = fmt::format("cannot write '{}': '{}' is not a folder", file, folder.string());
  else if (fs::is_directory(path, code))
    error = fmt::format("cannot write '{}': it is a folder", file);
  else if (access(folder.c_str(), W_OK | X_OK) != 0)
    error =
        fmt::format("cannot write '{}': no permission to write into '{}'", file, folder.string());
  else if (fs::exists(path, code) && access(path.c_str(), W_OK) != 0)
    error = fmt::format("cannot write '{}': it exists and may not be changed", file);
  return error.empty();
}

bool writeImage(const std::string& file, const Image& image, const WriteOptions& options,
                std::string& error) {
  if (!canWrite(file, error) || !checkImage(image, error)) return false;
  const fs::path target = resolved(file);
  std::vector<unsigned char> bytes;
  std::string why;
  try {
    if (encodePicture(image, kindOf(target), options, bytes, why))
      if (const int code = replaceFile(target, bytes)) why = systemsReason(code);
  } catch (const std::bad_alloc&) {
    why = "not enough memory";
  }
  if (!why.empty()) error = fmt::format("cannot write '{}': {}", file, why);
  return why.empty();
}

}  // namespace vestige
