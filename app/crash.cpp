// SPDX-License-Identifier: Apache-2.0
#include "app/crash.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <string_view>

namespace vestige::app {
namespace {

constexpr int kFrames = 64;

struct Kind {
  int signal;
  std::string_view words;
};
constexpr std::array<Kind, 5> kKinds = {{{SIGSEGV, "segmentation fault"},
                                         {SIGBUS, "bus error"},
                                         {SIGFPE, "arithmetic error"},
                                         {SIGILL, "illegal instruction"},
                                         {SIGABRT, "aborted"}}};

void say(std::string_view text) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

/// Whether a file is called as plugins are: KIND_NAME.so. Others that are loaded at run time, as
/// drivers, are not to be blamed.
bool isPlugin(std::string_view file) {
  if (file.size() < 3 || file.substr(file.size() - 3) != ".so") return false;
  const std::string_view name = file.substr(file.rfind('/') + 1);
  for (const std::string_view kind :
       {"brdf_", "camera_", "integrator_", "light_", "pigment_", "shape_"})
    if (name.substr(0, kind.size()) == kind) return true;
  return false;
}

/// The innermost plugin library among the callers, or "".
std::string_view culprit() {
  void* frames[kFrames];
  const int n = backtrace(frames, kFrames);
  for (int i = 0; i < n; ++i) {
    Dl_info info;
    if (dladdr(frames[i], &info) && info.dli_fname && isPlugin(info.dli_fname))
      return info.dli_fname;
  }
  return "";
}

/// Allocates nothing, so that it works with a broken heap. Says first what is known: looking for
/// the culprit walks over a stack that may be broken as well.
void onCrash(int signal) {
  std::string_view words = "crash";
  for (const Kind& k : kKinds)
    if (k.signal == signal) words = k.words;
  say("\nvestige: error: crashed (");
  say(words);
  say(")");
  const std::string_view library = culprit();
  if (library.empty()) {
    say(": this should not happen; please report it with the scene\n");
  } else {
    say(" in the plugin library '");
    say(library);
    say("'\n");
  }
  ::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

void useCrashStack() {
  stack_t before = {};
  sigaltstack(nullptr, &before);
  if (!(before.ss_flags & SS_DISABLE)) return;  // a sanitizer's, which it takes away itself
  static thread_local std::array<char, 1 << 16> stack;
  stack_t other = {};
  other.ss_sp = stack.data();
  other.ss_size = stack.size();
  sigaltstack(&other, nullptr);
}

void tellOfCrashes() {
  void* first[1];
  backtrace(first, 1);  // loads what it needs now: later the heap may be broken
  useCrashStack();
  for (const Kind& k : kKinds) {
    struct sigaction before {};
    sigaction(k.signal, nullptr, &before);
    if (before.sa_handler != SIG_DFL) continue;  // a sanitizer tells more than we could
    struct sigaction action {};
    action.sa_handler = onCrash;
    action.sa_flags = SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    sigaction(k.signal, &action, nullptr);
  }
}

}  // namespace vestige::app
