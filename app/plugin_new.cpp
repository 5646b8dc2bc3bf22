// SPDX-License-Identifier: Apache-2.0
// vestige plugin new: a folder with a small plugin that builds, from the templates that are
// installed beside the program.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include <vestige/diagnostic.h>

#include "app/plugin.h"
#include "app/scene_input.h"
#include "app/template_text.h"
#include "app/terminal.h"
#include "engine/scene/registry.h"
#include "lang/vocabulary.h"

namespace vestige::app {
namespace {

namespace fs = std::filesystem;

struct NewRequest {
  std::string kind, name, into = ".";
  bool dual = false;
};

const std::vector<std::string> kKinds = {"brdf",  "camera",  "integrator",
                                         "light", "pigment", "shape"};

/// With a class or a namespace of such a name nothing would compile.
bool isWordOfCpp(const std::string& word) {
  static constexpr std::array words = {
      "alignas", "alignof",   "and",    "asm",      "auto",     "bool",     "break",    "case",
      "catch",   "char",      "class",  "concept",  "const",    "continue", "default",  "delete",
      "do",      "double",    "else",   "enum",     "explicit", "export",   "extern",   "false",
      "float",   "for",       "friend", "goto",     "if",       "inline",   "int",      "long",
      "mutable", "namespace", "new",    "noexcept", "not",      "nullptr",  "operator", "or",
      "private", "protected", "public", "register", "requires", "return",   "short",    "signed",
      "sizeof",  "static",    "struct", "switch",   "template", "this",     "throw",    "true",
      "try",     "typedef",   "typeid", "typename", "union",    "unsigned", "using",    "virtual",
      "void",    "volatile",  "while",  "xor"};
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A word with a meaning of its own in the scene language.
bool isWordOfLanguage(const std::string& word) {
  const Registry registry = [] {
    std::vector<std::string> ignored;
    return Registry::load({}, ignored);
  }();
  const std::vector<std::string> kinds = registry.kinds();  // those of the engine: film, union, ...
  return lang::isExpressionWord(word) || lang::isTransformWord(word) || lang::insteadOf(word) ||
         word == "object" || std::find(kinds.begin(), kinds.end(), word) != kinds.end() ||
         std::find(kKinds.begin(), kKinds.end(), word) != kKinds.end();
}

void checkKind(const NewRequest& r) {
  if (std::find(kKinds.begin(), kKinds.end(), r.kind) == kKinds.end()) {
    const std::string near = nearestWord(r.kind, kKinds);
    throw Failure(kCommandLineWrong,
                  fmt::format("there is no kind of plugin '{}'; {}", r.kind,
                              near.empty() ? fmt::format("there are {}", fmt::join(kKinds, ", "))
                                           : fmt::format("did you mean '{}'?", near)));
  }
  const std::vector<std::string> dualKinds = {"brdf", "light", "camera"};
  if (r.dual && std::find(dualKinds.begin(), dualKinds.end(), r.kind) == dualKinds.end())
    throw Failure(
        kCommandLineWrong,
        fmt::format("--dual is for a brdf, a light or a camera: a {} has no such form", r.kind));
}

void checkName(const std::string& name) {
  const auto isPart = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (name.empty() || !(name[0] >= 'a' && name[0] <= 'z') || name.back() == '_' ||
      name.find("__") != name.npos || !std::all_of(name.begin(), name.end(), isPart))
    throw Failure(kCommandLineWrong,
                  fmt::format("'{}' cannot be the name of a plugin: expected a word of small "
                              "letters, digits and single '_' that begins with a letter, as "
                              "soft_box",
                              name));
  if (isWordOfCpp(name))
    throw Failure(kCommandLineWrong,
                  fmt::format("'{}' cannot be the name of a plugin: it is a word of C++", name));
  if (isWordOfLanguage(name))
    throw Failure(
        kCommandLineWrong,
        fmt::format("'{}' cannot be the name of a plugin: it is a word of the scene language",
                    name));
}

std::string templateText(const std::string& name) {
  const std::string file = installedTemplateFolder() + '/' + name;
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in || text.empty())
    throw Failure(kMachineFailed,
                  fmt::format("cannot read the template '{}': is the installation whole?", file));
  return text;
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw Failure(kMachineFailed, fmt::format("'{}' could not be written", file.string()));
}

void makeFolder(const NewRequest& r, const fs::path& folder) {
  std::error_code fault;
  if (fs::exists(fs::symlink_status(folder, fault)))
    throw Failure(kCommandLineWrong,
                  fmt::format("'{}' is there already: nothing was written", folder.string()));
  if (!fs::is_directory(r.into, fault))
    throw Failure(kCommandLineWrong, fmt::format("--into: there is no folder '{}'", r.into));
  if (!fs::create_directory(folder, fault))
    throw Failure(kMachineFailed,
                  fmt::format("cannot make the folder '{}': {}", folder.string(), fault.message()));
}

/// Two of one kind and name: scenes would get the one that is found first.
void warnOfNamesake(const NewRequest& r) {
  if (loadRegistry({}).has(r.kind, r.name))
    warn(
        fmt::format("there is a {} '{}' already: scenes take the one that is found first, which "
                    "`vestige plugin list` shows",
                    r.kind, r.name));
}

int runNew(const NewRequest& r) {
  checkKind(r);
  checkName(r.name);
  warnOfNamesake(r);
  const std::string className = classNameOf(r.name);
  const std::map<std::string, std::string> words = {
      {"kind", r.kind}, {"name", r.name}, {"Class", className}};
  const std::string source = templateText(r.kind + (r.dual ? "_dual.cpp.in" : ".cpp.in"));
  if (hasWord(source, className))
    throw Failure(kCommandLineWrong,
                  fmt::format("'{}' cannot be the name of a plugin: its class would be called {}, "
                              "as one that it needs",
                              r.name, className));
  const std::vector<std::pair<std::string, std::string>> files = {
      {"CMakeLists.txt", templateText("CMakeLists.txt.in")},
      {r.name + ".cpp", source},
      {r.name + ".scene", templateText(r.kind + ".scene.in")},
      {"README.md", templateText("README.md.in")}};
  const fs::path folder = fs::path(r.into) / r.name;
  makeFolder(r, folder);
  for (const auto& [name, text] : files) write(folder / name, filledIn(text, words));
  std::cout << fmt::format(
      "{0} {1} is in {2}. From there:\n\n"
      "  cmake -B build -DCMAKE_PREFIX_PATH={3}\n"
      "  cmake --build build\n"
      "  vestige plugin test build/{0}_{1}.so\n"
      "  vestige render {1}.scene --plugin-path build -o {1}.png\n",
      r.kind, r.name, folder.lexically_normal().string(), installationFolder());
  return kFine;
}

}  // namespace

void addPluginNew(CLI::App& plugin, Action& chosen) {
  CLI::App* command = plugin.add_subcommand("new", "Make a folder NAME with a plugin to change");
  const auto request = std::make_shared<NewRequest>();
  command->add_option("kind", request->kind, fmt::format("{}", fmt::join(kKinds, ", ")))
      ->required();
  command->add_option("name", request->name, "the word in scenes, as velvet or soft_box")
      ->required();
  command->add_flag("--dual", request->dual,
                    "a brdf, light or camera that has its derivatives from dual numbers");
  command->add_option("--into", request->into, "make the folder in this one")->type_name("DIR");
  command->callback([request, &chosen] { chosen = [request] { return runNew(*request); }; });
}

}  // namespace vestige::app
