// SPDX-License-Identifier: Apache-2.0
#include "app/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "app/terminal.h"

namespace vestige::app {
namespace {

namespace fs = std::filesystem;

std::string ending(const std::string& file) {
  std::string e = fs::path(file).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

/// Formats that hold numbers for looking at, hence take exposure and view, and no AOVs.
bool isForLooking(const std::string& file) {
  const std::string e = ending(file);
  return e != ".exr" && e != ".hdr" && e != ".tif" && e != ".tiff";
}

/// A name beside `file` that nobody else has.
std::string probeName(const std::string& file) {
  return (fs::path(file).parent_path() / fmt::format(".vestige-probe-{}{}", getpid(), ending(file)))
      .string();
}

/// Makes an empty file there and takes it away again: permissions alone do not tell, least of all
/// to root. "" or why not.
std::string whyNotCreated(const std::string& file) {
  const std::string probe = probeName(file);
  const int opened = open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0600);
  if (opened < 0) return std::strerror(errno);
  close(opened);
  unlink(probe.c_str());
  return "";
}

/// Writes one black pixel beside the file: the only way to know that the colour configuration has
/// the view.
void tryView(const std::string& file, const WriteOptions& options) {
  const std::string probe = probeName(file);
  const Image black{1, 1, {"R", "G", "B"}, {0, 0, 0}, {}};
  std::string error;
  const bool written = writeImage(probe, black, options, error);
  unlink(probe.c_str());
  if (written) return;
  // The user knows nothing of the probe.
  if (const std::size_t at = error.find(probe); at != std::string::npos)
    error.replace(at, probe.size(), file);
  throw Failure(kCommandLineWrong, error);
}

/// Folders of last resort, where a picture that took hours may wait.
std::vector<fs::path> refuges() {
  std::vector<fs::path> folders;
  std::error_code ignored;
  if (const fs::path folder = fs::temp_directory_path(ignored); !folder.empty())
    folders.push_back(folder);
  if (const char* home = std::getenv("HOME"); home && *home) folders.emplace_back(home);
  return folders;
}

/// Where the picture could be saved instead, or "".
std::string rescue(const Image& picture, const WriteOptions& options) {
  for (const fs::path& folder : refuges()) {
    const std::string file = (folder / fmt::format("vestige-rescued-{}.exr", getpid())).string();
    std::string error;
    if (writeImage(file, picture, options, error)) return file;
  }
  return "";
}

}  // namespace

void checkWritable(const std::string& file) {
  std::error_code ignored;
  std::string why;
  if (fs::is_directory(file, ignored))
    why = "it is a folder";
  else if (fs::exists(file, ignored) && access(file.c_str(), W_OK) != 0)
    why = std::strerror(errno);
  else
    why = whyNotCreated(file);
  if (!why.empty()) throw Failure(kMachineFailed, fmt::format("cannot write '{}': {}", file, why));
}

void checkOutputs(const OutputOptions& options, bool hasAovs) {
  for (const std::string& file : options.files) {
    checkWritable(file);
    std::string error;  // the place is fine, so only the name is to blame
    if (!canWrite(file, error)) throw Failure(kCommandLineWrong, error);
    const bool configured = options.viewGiven || std::getenv("OCIO");
    if (configured && isForLooking(file)) tryView(file, options.write);
  }
  if (hasAovs && std::all_of(options.files.begin(), options.files.end(), isForLooking))
    warn("PNG and JPEG keep colour only, so nothing of --aov is kept; add -o NAME.exr");
}

Image pictureOf(const Film& film, const PictureFacts& facts) {
  Film::Means means = film.means();
  const Crop crop = film.crop();
  Image image;
  image.width = means.width, image.height = means.height;
  image.channels = std::move(means.channels), image.pixels = std::move(means.pixels);
  image.metadata = {
      {"Software", "Vestige " VESTIGE_VERSION},
      {"vestige:version", VESTIGE_VERSION},
      {"vestige:scene_hash", fmt::format("{:016x}", facts.sceneHash)},
      {"vestige:seed", fmt::format("{}", facts.seed)},
      {"vestige:samples", fmt::format("{}", facts.samples)},
      {"vestige:render_seconds", fmt::format("{:.3f}", facts.seconds)},
      {"vestige:film", fmt::format("{} {}", film.width(), film.height())},
      {"vestige:crop", fmt::format("{} {} {} {}", crop.x0, crop.y0, crop.x1, crop.y1)}};
  return image;
}

std::vector<std::string> writeOutputs(const OutputOptions& options, const Image& picture,
                                      bool& failed) {
  std::vector<std::string> written;
  failed = false;
  for (const std::string& file : options.files) {
    std::string error;
    if (writeImage(file, picture, options.write, error)) {
      written.push_back(file);
    } else {
      complain(error);
      failed = true;
    }
  }
  if (!written.empty()) return written;
  const std::string file = rescue(picture, options.write);
  if (file.empty()) {
    complain("the picture could not be saved anywhere else either");
  } else {
    warn(fmt::format("saved the picture as '{}' instead", file));
    written.push_back(file);
  }
  return written;
}

}  // namespace vestige::app
