// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/aov_slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace vestige {
namespace {

bool isName(std::string_view word) {
  const auto isFine = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !word.empty() && std::all_of(word.begin(), word.end(), isFine);
}

bool isTaken(std::string_view word) {
  return word == "all" ||
         std::find(std::begin(kCommonAovs), std::end(kCommonAovs), word) != std::end(kCommonAovs);
}

}  // namespace

std::string whatIsWrong(std::span<const AovSlot> slots) {
  if (slots.size() > std::size_t(kMostOwnAovs))
    return fmt::format("declares {} AOVs; {} are allowed", slots.size(), kMostOwnAovs);
  std::set<std::string_view> names;
  for (const AovSlot& slot : slots) {
    const std::string_view name = slot.name ? slot.name : "";
    if (!isName(name))
      return fmt::format("declares an AOV '{}': names have letters, digits, '.', '_' and '-' only",
                         name);
    if (isTaken(name))
      return fmt::format("declares an AOV '{}', a name that every integrator has already", name);
    if (!names.insert(name).second) return fmt::format("declares the AOV '{}' twice", name);
    if (!(slot.step > 0) || !std::isfinite(slot.step))
      return fmt::format("declares the AOV '{}' with a step of {}; it must be above 0 and finite",
                         name, slot.step);
  }
  return "";
}

}  // namespace vestige
