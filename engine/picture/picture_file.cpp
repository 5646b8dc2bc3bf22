// SPDX-License-Identifier: Apache-2.0
#include "engine/picture/picture_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <filesystem>

#include <vestige/tools/regular_file.h>

#include "engine/picture/image.h"

namespace vestige {

namespace {

long long mostPixels = kMaxPicturePixels;

bool isReadable(const std::string& file, std::string& error) {
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status))
    error = fmt::format("there is no file '{}'", file);
  else if (std::filesystem::is_directory(status))
    error = fmt::format("'{}' is a folder, not a picture", file);
  else if (const std::string why = whyNotRegular(file); !why.empty())
    error = fmt::format("'{}' {}", file, why);
  else if (access(file.c_str(), R_OK) != 0)
    error = fmt::format("no permission to read '{}'", file);
  return error.empty();
}

bool isSuitable(const OIIO::ImageSpec& spec, const std::string& file, std::string& error) {
  if (spec.deep)
    error = fmt::format("'{}' holds deep pixels, expected a flat picture", file);
  else if (spec.depth > 1)
    error = fmt::format("'{}' holds a volume, expected a flat picture", file);
  else if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
    error = fmt::format("the picture '{}' is empty", file);
  else if (spec.width > mostPixels / spec.height)
    error = fmt::format(
        "the picture '{}' is {} x {} pixels large, at most {} million are read: --max-picture "
        "raises the limit",
        file, spec.width, spec.height, mostPixels / 1000000);
  return error.empty();
}

}  // namespace

void limitPictures(long long pixels) { mostPixels = pixels; }

std::string reason(std::string message, const std::string& file) {
  if (message.find("could not find a format reader") != message.npos)
    return "it is of no known format";
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.front())))
    message.erase(0, 1);
  message = message.substr(0, message.find('\n'));
  for (const std::string& part : {"\"" + file + "\"", "'" + file + "'", file})
    if (const auto at = message.find(part); at != std::string::npos)
      message.replace(at, part.size(), "it");
  while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
  return message.empty() ? "its contents make no sense" : message;
}

std::unique_ptr<OIIO::ImageInput> openPicture(const std::string& file, std::string& error) {
  error.clear();
  if (!isReadable(file, error)) return nullptr;
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  auto input = OIIO::ImageInput::open(file, &wishes);
  if (!input) {
    error = fmt::format("cannot read the picture '{}': {}", file, reason(OIIO::geterror(), file));
    return nullptr;
  }
  if (!isSuitable(input->spec(), file, error)) return nullptr;
  return input;
}

bool readPicture(OIIO::ImageInput& input, const std::string& file, int begin, int end,
                 OIIO::TypeDesc format, void* pixels, std::string& error) {
  if (input.read_image(0, 0, begin, end, format, pixels)) return true;
  error = fmt::format("cannot read the picture '{}': {}", file, reason(input.geterror(), file));
  return false;
}

}  // namespace vestige
