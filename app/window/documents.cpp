// SPDX-License-Identifier: Apache-2.0
// Files that the window reads and writes, and the editor that it opens.
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "app/output.h"
#include "app/window/layers.h"
#include "engine/picture/compare.h"

extern char** environ;

namespace vestige::app {

bool isPictureFile(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  const auto endings = {".exr", ".png", ".jpg", ".jpeg", ".hdr", ".tif", ".tiff", ".pfm"};
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

namespace {

/// Linear radiance, whatever the file holds: codes of 8 bits are taken as sRGB.
Image readLinear(const std::string& file, std::string& error) {
  Image image = readImage(file, error);
  if (image.width == 0) return image;
  std::string ending = std::filesystem::path(file).extension().string();
  const bool isCoded = ending == ".png" || ending == ".jpg" || ending == ".jpeg";
  if (isCoded)
    for (float& x : image.pixels)
      x = x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
  return image;
}

}  // namespace

void Window::openPicture(const std::string& file) {
  std::string error;
  Image image = readLinear(file, error);
  if (image.width == 0) {
    if (shown_.width == 0) throw Failure(kCommandLineWrong, error);
    return say(error);
  }
  opened_ = std::move(image);
  // A large one is not kept twice.
  if (opened_.channels.size() == 3)
    shown_ = {opened_.width, opened_.height, std::move(opened_.pixels)};
  else
    shown_ = colours(opened_);
  screen_->setPicture(shown_.rgb.data(), shown_.width, shown_.height);
  sheet_.width = shown_.width, sheet_.height = shown_.height;
  isDirty_ = true;
}

void Window::openReference(const std::string& file) {
  std::string error;
  const Image image = readLinear(file, error);
  if (image.width == 0) return say(error);
  other_ = colours(image);
  otherName_ = std::filesystem::path(file).filename().string();
  screen_->setOther(other_.rgb.data(), other_.width, other_.height);
  if (look_.versus == Versus::nothing) look_.versus = Versus::wipe;
}

void Window::keepAsOther() {
  if (shown_.width == 0) return;
  other_ = shown_;
  otherName_ =
      snapshot_ ? fmt::format("snapshot, {}, {} samples", snapshot_->integrator, snapshot_->samples)
                : "snapshot";
  screen_->setOther(other_.rgb.data(), other_.width, other_.height);
  say("kept: V shows it beside what comes");
}

/// The perceptual difference of the two pictures takes the other one's place.
void Window::makeFlip() {
  if (other_.width != shown_.width || other_.height != shown_.height)
    return say(fmt::format("the pictures have different sizes: {} x {} and {} x {}", shown_.width,
                           shown_.height, other_.width, other_.height));
  const auto image = [](const Picture& p) {
    Image i;
    i.width = p.width, i.height = p.height, i.channels = {"R", "G", "B"}, i.pixels = p.rgb;
    return i;
  };
  Image difference;
  const Comparison c = compareImages(image(shown_), image(other_), &difference);
  const Picture p = colours(difference);
  screen_->setOther(p.rgb.data(), p.width, p.height);
  otherName_ = fmt::format("FLIP against it, mean {:.4f}", c.flip);
  look_.versus = Versus::wipe;
  say(fmt::format("FLIP {:.4f}, relative squared error {:.5f}", c.flip, c.relMse));
}

void Window::savePicture(const std::string& file) {
  std::string name = file;
  if (preview_ && std::filesystem::path(name).extension() == ".checkpoint")
    return preview_->keep(name);
  if (name.empty()) name = std::filesystem::path(request_.input.file).stem().string() + "-view.png";
  Image image = opened_;
  if (snapshot_) {
    image = {};
    image.width = snapshot_->means.width, image.height = snapshot_->means.height;
    image.channels = snapshot_->means.channels, image.pixels = snapshot_->means.pixels;
    image.metadata["vestige:samples"] = std::to_string(snapshot_->samples);
  } else if (image.pixels.empty()) {
    image.pixels = shown_.rgb;
  }
  if (image.width == 0) return say("there is no picture yet");
  WriteOptions options;
  options.display = look_.display;
  std::string error;
  const bool isFine = writeImage(name, image, options, error);
  say(isFine ? fmt::format("wrote {}", name) : error);
}

/// $VISUAL or $EDITOR; those that are known to take a line get it.
void Window::openInEditor(const lang::Place& place) {
  const char* wanted = std::getenv("VISUAL");
  if (!wanted || !*wanted) wanted = std::getenv("EDITOR");
  const std::string editor = wanted && *wanted ? wanted : "code";
  const std::string name =
      std::filesystem::path(editor.substr(0, editor.find(' '))).filename().string();
  const auto starts = [&](const char* word) { return name.rfind(word, 0) == 0; };
  const std::string line = std::to_string(place.line), column = std::to_string(place.column);
  std::vector<std::string> words;  // "code --wait"
  std::istringstream given(editor);
  for (std::string word; given >> word;) words.push_back(word);
  if (words.empty()) return;
  if (starts("code") || starts("codium"))
    words.insert(words.end(), {"--goto", place.file + ':' + line + ':' + column});
  else if (starts("subl") || starts("zed"))
    words.push_back(place.file + ':' + line + ':' + column);
  else if (starts("kate"))
    words.insert(words.end(), {"--line", line, "--column", column, place.file});
  else
    words.insert(words.end(), {'+' + line, place.file});  // vi, emacs, nano, gedit, ...
  std::vector<char*> arguments;
  for (std::string& w : words) arguments.push_back(w.data());
  arguments.push_back(nullptr);
  posix_spawnattr_t attributes;  // ours ignores its children's ends; the editor may have its own
  posix_spawnattr_init(&attributes);
  sigset_t usual;
  sigemptyset(&usual);
  sigaddset(&usual, SIGCHLD);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, arguments[0], nullptr, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  if (failed != 0)
    return say(fmt::format("cannot start the editor '{}': set EDITOR; the place is {}:{}", editor,
                           place.file, place.line));
  say(fmt::format("{} opens {}:{}", name, place.file, place.line));
}

}  // namespace vestige::app
