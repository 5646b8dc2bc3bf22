// SPDX-License-Identifier: Apache-2.0
// Notices when files change, appear or go.
#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace vestige::app {

/// Asked now and then: a few stat() calls, which is nothing beside a picture, and works where
/// notifications do not (network folders, editors that write beside and rename).
class FileWatch {
 public:
  /// From now on these. A file that is new here and was written after `readAt` counts as changed.
  void watch(const std::set<std::string>& files,
             std::filesystem::file_time_type readAt = std::filesystem::file_time_type::max());
  /// Whether one of them changed since the last true answer. A file that is still being written
  /// is waited for: it must look the same twice.
  bool hasChanged();

 private:
  struct State {
    bool exists = false;
    std::uintmax_t size = 0;
    std::filesystem::file_time_type written;
    bool operator==(const State&) const = default;
  };
  static State stateOf(const std::string& file);

  std::map<std::string, State> known_;      ///< as of the last true answer
  std::map<std::string, State> unsettled_;  ///< changed, but seen only once so
};

}  // namespace vestige::app
