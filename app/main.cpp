// SPDX-License-Identifier: Apache-2.0
// The program: understands the command line, runs one command, turns failures into sentences and
// exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <new>

#include <vestige/diagnostic.h>

#include "app/command.h"
#include "app/crash.h"
#include "app/terminal.h"

namespace vestige::app {
namespace {

using Words = std::vector<std::string>;

const Words kCommands = {"render",  "inspect", "check",  "describe",
                         "compare", "view",    "plugin", "help"};

bool isCommand(const std::string& word) {
  return std::find(kCommands.begin(), kCommands.end(), word) != kCommands.end();
}

/// `vestige hello.scene` means `vestige render hello.scene`, `vestige help render` means
/// `vestige render --help`.
Words withCommand(Words words) {
  if (words.empty() || words[0] == "--help" || words[0] == "-h" || words[0] == "--version")
    return words;
  if (words[0] == "help") {
    words.erase(words.begin());
    words.push_back("--help");
    return words;
  }
  if (isCommand(words[0])) return words;
  std::error_code ignored;
  const bool isFile = words[0].find_first_of("./") != std::string::npos ||
                      std::filesystem::exists(words[0], ignored);
  if (!isFile && words[0][0] != '-') {
    const std::string near = nearestWord(words[0], kCommands);
    throw Failure(
        kCommandLineWrong,
        fmt::format("there is no command and no scene file '{}'; {}", words[0],
                    near.empty()
                        ? "the commands are render, view, inspect, check, describe, compare, plugin"
                        : fmt::format("did you mean '{}'?", near)));
  }
  words.insert(words.begin(), "render");
  return words;
}

/// Names of all options of a command, with their dashes.
Words optionNames(const CLI::App& command) {
  Words names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// The command's name as it is typed: "plugin new".
std::string fullName(const CLI::App& command) {
  const CLI::App* above = command.get_parent();
  const bool isNested = above && above->get_parent();
  return (isNested ? fullName(*above) + ' ' : "") + command.get_name();
}

/// A sentence about the first word that is no option of its command, or "".
std::string unknownOption(const CLI::App& command, const Words& words) {
  const Words known = optionNames(command);
  for (const std::string& word : words) {
    if (word == "--") break;
    if (word.size() < 3 || word.compare(0, 2, "--") != 0) continue;
    const std::string name = word.substr(0, word.find('='));
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearestWord(name, known);
    return fmt::format("'vestige {}' has no option '{}'; {}", fullName(command), name,
                       near.empty() ? fmt::format("see vestige {} --help", fullName(command))
                                    : fmt::format("did you mean '{}'?", near));
  }
  return "";
}

const CLI::App* subcommand(const CLI::App& above, const std::string& name) {
  for (const CLI::App* c : above.get_subcommands(nullptr))
    if (c->get_name() == name) return c;
  return nullptr;
}

/// A sentence about the word that should be one of a command's own commands, or "".
std::string unknownCommand(const CLI::App& command, const std::string& word) {
  Words known;
  for (const CLI::App* c : command.get_subcommands(nullptr)) known.push_back(c->get_name());
  if (known.empty() || word.empty() || word[0] == '-') return "";
  const std::string near = nearestWord(word, known);
  return fmt::format("'vestige {}' has no command '{}'; {}", fullName(command), word,
                     near.empty() ? fmt::format("there are {}", fmt::join(known, ", "))
                                  : fmt::format("did you mean '{}'?", near));
}

/// What CLI11 refused, in the user's words.
std::string explain(const CLI::ParseError& error, const CLI::App& program, const Words& words) {
  const CLI::App* command = &program;
  std::size_t depth = 0;
  for (; depth < words.size(); ++depth) {
    const CLI::App* next = subcommand(*command, words[depth]);
    if (!next) break;
    command = next;
  }
  if (depth == 0) return fmt::format("{}; see vestige --help", error.what());
  const std::string next = depth < words.size() ? words[depth] : "";
  if (std::string sentence = unknownCommand(*command, next); !sentence.empty()) return sentence;
  if (std::string sentence = unknownOption(*command, words); !sentence.empty()) return sentence;
  return fmt::format("vestige {}: {}; see vestige {} --help", fullName(*command), error.what(),
                     fullName(*command));
}

int run(Words words) {
  CLI::App program("", "vestige");
  bool version = false;
  program.add_flag("--version", version);
  Action chosen;
  addRender(program, chosen);
  addInspect(program, chosen);
  addCheck(program, chosen);
  addDescribe(program, chosen);
  addCompare(program, chosen);
  addPlugin(program, chosen);
  program.require_subcommand(0, 1);
  program.formatter_fn([](const CLI::App*, std::string, CLI::AppFormatMode) { return helpText(); });

  words = withCommand(std::move(words));
  if (!words.empty() && words[0] == "view") return runView({words.begin() + 1, words.end()});
  try {
    program.parse(Words(words.rbegin(), words.rend()));  // the library wants them last first
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    throw Failure(kCommandLineWrong, explain(error, program, words));
  }
  if (version) {
    std::cout << versionText() << std::flush;
    return kFine;
  }
  if (chosen) return chosen();
  std::cerr << helpText();
  return kCommandLineWrong;
}

}  // namespace
}  // namespace vestige::app

int main(int argc, char** argv) {
  using namespace vestige::app;
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file too large for its limit is an error of write(), as ENOSPC
  std::signal(SIGPIPE, SIG_DFL);
  tellOfCrashes();
  try {
    return run({argv + 1, argv + argc});
  } catch (const Failure& failure) {
    complain(failure.what());
    return failure.code();
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& failure) {
    complain(failure.what());
  } catch (...) {
    complain("stopped for an unknown reason");
  }
  return kMachineFailed;
}
