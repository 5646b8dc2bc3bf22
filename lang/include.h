// SPDX-License-Identifier: Apache-2.0
// Finds and tokenises included files.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lang/context.h"

namespace vestige::lang {

/// Whether a path leads to a place below a folder, symbolic links resolved.
bool isBelowFolder(const std::string& path, const std::string& folder);

class Includes {
 public:
  Includes(Context& context, const std::string& sceneFile);

  struct File {
    int file = -1;  ///< in Sources
    const TokenList* tokens = nullptr;
  };
  /// A text under a name, tokenised.
  File add(const std::string& name, std::string text);
  /// The file's text and tokens, cached; nothing, with the reason in `why`, if it cannot be read.
  std::optional<File> load(const std::string& path, std::string& why);
  /// The path of an included file: beside the including text, in the working directory, then in the
  /// include paths. "" if not found; `tried` receives every path.
  std::string find(const std::string& name, int askingFile, std::vector<std::string>& tried) const;
  /// The file in an include path that declares a name, or "": for a hint.
  std::string declaredIn(const std::string& name) const;
  /// Whether the file is allowed: with --sandbox it must lie below the scene's folder or an include
  /// path.
  bool isAllowed(const std::string& path) const;
  /// The message for a path that is not allowed.
  static std::string outside(const std::string& path);
  /// Reports that no file was found.
  void missing(const std::string& message, const Span& span, const std::vector<std::string>& tried);

 private:
  Context& context_;
  std::string sceneFolder_;
  std::map<std::string, File> loaded_;  ///< by path
  std::deque<TokenList> lists_;
};

}  // namespace vestige::lang
