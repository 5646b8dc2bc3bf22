// SPDX-License-Identifier: Apache-2.0
// Words in a panel.
#pragma once
#include <imgui.h>

#include <string>

namespace vestige::app {

inline void text(const std::string& s) { ImGui::TextUnformatted(s.c_str()); }
inline void wrapped(const std::string& s) { ImGui::TextWrapped("%s", s.c_str()); }

}  // namespace vestige::app
