// SPDX-License-Identifier: Apache-2.0
// What the commands share: how they are registered, how they fail, what the program's exit code
// says.
#pragma once
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vestige::app {

enum ExitCode : int {
  kFine = 0,
  kSceneWrong = 1,        ///< the text or what it names
  kCommandLineWrong = 2,  ///< options and arguments
  kMachineFailed = 3,     ///< disk full, out of memory, missing library
  kInterrupted = 130,     ///< as a shell reports SIGINT
};

/// Ends the program with a sentence for the user.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// What the command line asked for; returns the exit code. Run after the whole line was understood.
using Action = std::function<int()>;

/// Each adds its command to the program; when the line names it, `chosen` is set.
void addRender(CLI::App& program, Action& chosen);
void addInspect(CLI::App& program, Action& chosen);
void addCheck(CLI::App& program, Action& chosen);
void addDescribe(CLI::App& program, Action& chosen);
void addCompare(CLI::App& program, Action& chosen);
void addPlugin(CLI::App& program, Action& chosen);

/// The program with the window in place of this one; `words` is what follows `view`.
int runView(const std::vector<std::string>& words);

/// Versions of the program and of everything it is made of, for people who report an error.
std::string versionText();
/// The text of `vestige --help`.
std::string helpText();

}  // namespace vestige::app
