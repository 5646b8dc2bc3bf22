// SPDX-License-Identifier: Apache-2.0
#include "app/window/watch.h"

namespace vestige::app {

FileWatch::State FileWatch::stateOf(const std::string& file) {
  std::error_code failed;
  State s;
  s.exists = std::filesystem::is_regular_file(file, failed);
  if (!s.exists) return s;
  s.size = std::filesystem::file_size(file, failed);
  s.written = std::filesystem::last_write_time(file, failed);
  return s;
}

void FileWatch::watch(const std::set<std::string>& files) {
  std::map<std::string, State> now;
  for (const std::string& file : files) {
    const auto before = known_.find(file);
    now[file] = before != known_.end() ? before->second : stateOf(file);
  }
  known_.swap(now);
}

bool FileWatch::hasChanged() {
  std::map<std::string, State> changed;
  for (const auto& [file, before] : known_)
    if (const State now = stateOf(file); now != before) changed[file] = now;
  const bool isSettled = !changed.empty() && changed == unsettled_;
  unsettled_ = changed;
  if (!isSettled) return false;
  for (const auto& [file, now] : changed) known_[file] = now;
  unsettled_.clear();
  return true;
}

}  // namespace vestige::app
