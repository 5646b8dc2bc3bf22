// SPDX-License-Identifier: Apache-2.0
// Runs the built program as a user would: arguments in; exit code, text and time out.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

struct Run {
  int exit;  ///< exit code; minus the signal that ended it; kHung if it had to be killed
  std::string out, err;
  double seconds;
};
inline constexpr int kHung = -1000;

struct Setup {
  std::filesystem::path folder = {};  ///< to run in; "": the test's own
  std::vector<std::pair<std::string, std::string>> variables = {};  ///< of the environment
  long fileSizeLimit = -1;       ///< bytes a file may have (as if the disk were full), -1: no limit
  long memoryLimit = -1;         ///< bytes of address space, -1: no limit
  double patience = 60;          ///< seconds, then it is killed
  std::string interruptAt = {};  ///< SIGINT is sent when stdout holds this text
  int interruptSignal = 2;
  std::string program = VESTIGE_BINARY;
};

Run runVestige(const std::vector<std::string>& arguments, const Setup& setup = {});

/// A new folder that goes away with its contents.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes a file and returns its absolute name.
  std::string write(const std::string& name, const std::string& text) const;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }
  /// Names of what is in it.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// A camera, a film of 16 x 16, a light and a floor; `more` is added at the end.
std::string smallScene(const std::string& more = "sphere { <0, 1, 0>, 1 brdf lambert { } }");

/// Whether a PNG or EXR begins as one and is not empty.
bool looksLikePicture(const std::string& file);
