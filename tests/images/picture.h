// SPDX-License-Identifier: Apache-2.0
// Renders scenes with the program itself, as a user would, and reads the picture back.
#pragma once
#include <vestige/math.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/picture/image.h"
#include "support/catch.h"

namespace vestige::test {

/// A folder of this process, gone at its end.
inline const std::filesystem::path& scratch() {
  static const struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("vestige_images_" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  } folder;
  return folder.path;
}

/// As one word of the shell.
inline std::string quoted(const std::filesystem::path& file) {
  std::string word = file.string();
  word.insert(word.begin(), '\'');
  word.push_back('\'');
  return word;
}

inline std::filesystem::path source(const std::string& file) {
  return std::filesystem::path(VESTIGE_SOURCE_DIR) / file;
}

/// Runs `vestige ARGUMENTS`; its messages appear in the test's output.
inline int runVestige(const std::string& arguments) {
  return std::system((quoted(VESTIGE_BINARY) + " " + arguments).c_str());
}

inline Image read(const std::filesystem::path& file) {
  std::string error;
  Image image = readImage(file.string(), error);
  INFO(error);
  REQUIRE(image.width > 0);
  return image;
}

/// The picture of a scene file, linear.
inline Image renderFile(const std::filesystem::path& scene, const std::string& arguments) {
  const std::filesystem::path out = scratch() / "picture.exr";
  std::filesystem::remove(out);
  INFO("scene " << scene.string() << ", arguments " << arguments);
  REQUIRE(runVestige("render " + quoted(scene) + " -o " + quoted(out) + " --progress none " +
                     arguments) == 0);
  return read(out);
}

/// The picture of a scene text.
inline Image renderText(const std::string& text, const std::string& arguments) {
  const std::filesystem::path scene = scratch() / "scene.scene";
  std::ofstream(scene) << text;
  INFO(text);
  return renderFile(scene, arguments);
}

/// Mean of one channel over all pixels.
inline double mean(const Image& image, int channel) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += double(image.at(x, y)[channel]);
  return sum / (double(image.width) * image.height);
}

}  // namespace vestige::test
