// SPDX-License-Identifier: Apache-2.0
#include "lang/write_below.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace vestige::lang {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }
  bool isOpen() const { return fd_ >= 0; }

 private:
  int fd_;
};

std::string reason() {
  return errno == ELOOP || errno == ENOTDIR ? "a symbolic link, or no folder, is in its path"
                                            : std::strerror(errno);
}

/// The file itself, not yet truncated.
Descriptor opened(const std::string& folder, const std::string& name, std::string& why) {
  Descriptor at(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  std::string next;
  for (const std::filesystem::path& part : std::filesystem::path(name)) {
    if (part == ".." || part.is_absolute())
      return why = "its name leaves the folder", Descriptor(-1);
    if (part == "." || part.empty()) continue;
    if (at.isOpen() && !next.empty())
      at = Descriptor(
          ::openat(at.get(), next.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!at.isOpen()) return why = reason(), Descriptor(-1);
    next = part.string();
  }
  if (!at.isOpen() || next.empty()) return why = reason(), Descriptor(-1);
  constexpr int kFlags = O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  Descriptor file(::openat(at.get(), next.c_str(), kFlags, 0666));
  if (!file.isOpen()) why = reason();
  return file;
}

}  // namespace

bool writeBelow(const std::string& folder, const std::string& name, const std::string& text,
                std::string& why) {
  const Descriptor file = opened(folder, name, why);
  if (!file.isOpen()) return false;
  struct stat status {};
  if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    why = "it is no regular file";
    return false;
  }
  bool isFine = ::ftruncate(file.get(), 0) == 0;
  for (std::size_t at = 0; isFine && at < text.size();) {
    const ssize_t n = ::write(file.get(), text.data() + at, text.size() - at);
    isFine = n > 0 || (n < 0 && errno == EINTR);
    if (n > 0) at += std::size_t(n);
  }
  if (!isFine) why = reason();
  return isFine;
}

}  // namespace vestige::lang
