// SPDX-License-Identifier: Apache-2.0
// Schemas that are all there, as the language asks for them.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "lang/lang.h"

namespace vestige::test {

class SchemaList final : public lang::SchemaSource {
 public:
  explicit SchemaList(std::vector<Schema> all) : all_(std::move(all)) {}

  const Schema* find(const std::string& kind, const std::string& name) const override {
    for (const Schema& s : all_)
      if (s.kind == kind && s.name == name) return &s;
    return nullptr;
  }
  bool has(const std::string& kind, const std::string& name) const override {
    return find(kind, name) || isRefused(kind, name);
  }
  std::vector<std::string> kinds() const override {
    std::vector<std::string> found;
    for (const Schema& s : all_) found.push_back(s.kind);
    return found;
  }
  std::vector<std::string> names(const std::string& kind) const override {
    std::vector<std::string> found;
    for (const Schema& s : all_)
      if (s.kind == kind) found.push_back(s.name);
    return found;
  }
  std::string whyMissing(const std::string& kind, const std::string& name) const override {
    return isRefused(kind, name) ? "its library has holes" : "";
  }

 private:
  /// As if there were libraries for these, which cannot be loaded.
  static bool isRefused(const std::string& kind, const std::string& name) {
    return (kind == "brdf" && name == "moth_eaten") || (kind == "shape" && name == "hollow_tree");
  }

  std::vector<Schema> all_;
};

}  // namespace vestige::test
