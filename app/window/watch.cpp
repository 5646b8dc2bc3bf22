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

void FileWatch::watch(const std::set<std::string>& files, std::filesystem::file_time_type readAt) {
  std::map<std::string, State> now;
  for (const std::string& file : files) {
    const auto before = known_.find(file);
    if (before != known_.end()) {
      now[file] = before->second;
      continue;
    }
    const State state = stateOf(file);
    now[file] = state.exists && state.written > readAt ? State{} : state;
  }
  known_.swap(now);
}

bool FileWatch::hasChanged() {
  std::map<std::string, State> changed;
  bool isSettled = false;
  for (auto& [file, before] : known_) {
    const State now = stateOf(file);
    if (now == before) continue;
    const auto seen = unsettled_.find(file);
    if (seen != unsettled_.end() && seen->second == now)
      before = now, isSettled = true;
    else
      changed[file] = now;
  }
  unsettled_ = changed;
  return isSettled;
}

}  // namespace vestige::app
