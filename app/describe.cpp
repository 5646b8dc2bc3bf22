// SPDX-License-Identifier: Apache-2.0
// vestige describe: what a scene may say, from the schemas that the plugins brought.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "app/command.h"
#include "app/scene_input.h"
#include "app/schema_pages.h"
#include "app/schema_text.h"
#include "app/terminal.h"

namespace vestige::app {
namespace {

struct DescribeRequest {
  std::string kind, name;
  std::string markdown;  ///< folder for pages; "": none are written
  std::vector<std::string> pluginPaths;
  bool json = false;
};

using Schemas = std::vector<const Schema*>;

[[noreturn]] void refuseName(const std::string& what, const std::string& word,
                             const std::vector<std::string>& known) {
  const std::string near = nearestWord(word, known);
  throw Failure(kCommandLineWrong,
                fmt::format("there is no {} '{}'; {}", what, word,
                            near.empty() ? fmt::format("there are {}", fmt::join(known, ", "))
                                         : fmt::format("did you mean '{}'?", near)));
}

Schemas ofKind(const Registry& registry, const std::string& kind) {
  Schemas found;
  for (const Schema* s : registry.schemas())
    if (s->kind == kind) found.push_back(s);
  return found;
}

/// What the words of the command line mean. The kind may be left out: `describe phong`.
Schemas lookUp(const DescribeRequest& r, const Registry& registry) {
  if (r.kind.empty()) return registry.schemas();
  const Schemas kind = ofKind(registry, r.kind);
  std::vector<std::string> known = registry.kinds();
  if (kind.empty() && r.name.empty()) {
    Schemas found;
    for (const Schema* s : registry.schemas()) {
      if (s->name == r.kind) found.push_back(s);
      if (!s->name.empty()) known.push_back(s->name);
    }
    if (!found.empty()) return found;
  }
  if (kind.empty()) refuseName("kind", r.kind, known);
  if (r.name.empty()) return kind;
  known.clear();
  for (const Schema* s : kind) {
    if (s->name == r.name) return {s};
    if (!s->name.empty()) known.push_back(s->name);
  }
  if (known.empty())
    throw Failure(kCommandLineWrong,
                  fmt::format("'{}' is a block of its own: it has no plugins", r.kind));
  refuseName(r.kind, r.name, known);
}

void printKinds(const Schemas& schemas) {
  std::vector<Row> rows;
  for (const Schema* s : schemas) {
    if (rows.empty() || rows.back()[0] != s->kind) rows.push_back({s->kind, ""});
    std::string& words = rows.back()[1];
    words += (words.empty() ? "" : " ") + (s->name.empty() ? s->summary : s->name);
  }
  std::cout << "What a scene is written with:\n\n"
            << table(rows, terminalWidth(STDOUT_FILENO))
            << "\n'vestige describe KIND' says what each is for, 'vestige describe KIND NAME' lists"
               "\nits parameters, --json gives all of it to programs.\n";
}

void printPlugins(const Schemas& schemas) {
  std::vector<Row> rows;
  for (const Schema* s : schemas) rows.push_back({s->kind + " " + s->name, s->summary});
  std::cout << table(rows, terminalWidth(STDOUT_FILENO));
}

void writePages(const Schemas& schemas, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Failure(kMachineFailed, fmt::format("cannot make '{}': {}", folder, error.message()));
  for (const Page& page : schemaPages(schemas)) {
    const std::string file = (std::filesystem::path(folder) / page.name).string();
    std::ofstream out(file, std::ios::binary);
    out << page.text;
    if (!out.flush()) throw Failure(kMachineFailed, fmt::format("cannot write '{}'", file));
  }
}

int runDescribe(const DescribeRequest& r) {
  const Registry registry = loadRegistry(r.pluginPaths);
  registry.schemas();  // opens every library, also those that the words below do not ask for
  warnOfRefused(registry, {});
  const Schemas found = lookUp(r, registry);
  if (!r.markdown.empty())
    writePages(found, r.markdown);
  else if (r.json)
    std::cout << schemasJson(found) << '\n';
  else if (r.kind.empty())
    printKinds(found);
  else if (found.size() == 1)
    std::cout << schemaText(*found[0], terminalWidth(STDOUT_FILENO));
  else
    printPlugins(found);
  std::cout << std::flush;
  return kFine;
}

}  // namespace

void addDescribe(CLI::App& program, Action& chosen) {
  CLI::App* command =
      program.add_subcommand("describe", "List what scenes may say: plugins and their parameters");
  const auto request = std::make_shared<DescribeRequest>();
  command->add_option("kind", request->kind, "brdf, light, camera, shape, film, ...");
  command->add_option("name", request->name, "phong, area, pinhole, sphere, ...");
  CLI::Option* json = command->add_flag("--json", request->json, "for programs");
  command->add_option("--markdown", request->markdown, "write a page a kind and an index into DIR")
      ->type_name("DIR")
      ->excludes(json);
  addPluginPath(*command, request->pluginPaths);
  command->callback([request, &chosen] { chosen = [request] { return runDescribe(*request); }; });
}

}  // namespace vestige::app
