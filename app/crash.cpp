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

/// The innermost plugin library among the callers, or "". System libraries are libx.so.1.
std::string_view culprit() {
  void* frames[kFrames];
  const int n = backtrace(frames, kFrames);
  for (int i = 0; i < n; ++i) {
    Dl_info info;
    if (!dladdr(frames[i], &info) || !info.dli_fname) continue;
    const std::string_view file = info.dli_fname;
    if (file.size() > 3 && file.substr(file.size() - 3) == ".so") return file;
  }
  return "";
}

/// Allocates nothing, so that it works with a broken heap.
void onCrash(int signal) {
  std::string_view words = "crash";
  for (const Kind& k : kKinds)
    if (k.signal == signal) words = k.words;
  const std::string_view library = culprit();
  say("\nvestige: error: crashed (");
  say(words);
  if (library.empty()) {
    say("): this should not happen; please report it with the scene\n");
  } else {
    say(") in the plugin library '");
    say(library);
    say("'\n");
  }
  ::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

void tellOfCrashes() {
  void* first[1];
  backtrace(first, 1);  // loads what it needs now: later the heap may be broken
  // A stack of its own, for endless recursion on the main thread, where plugins are created.
  static std::array<char, 1 << 16> stack;
  stack_t other = {};
  other.ss_sp = stack.data();
  other.ss_size = stack.size();
  sigaltstack(&other, nullptr);
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
